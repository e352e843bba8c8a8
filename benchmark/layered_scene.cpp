#include "layered_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace light_field_depth::benchmark
{
namespace
{
constexpr int DISCS = 6;

/// Random blobs of several sizes.
cv::Mat randomTexture(const cv::Size& size, cv::RNG& random)
{
  constexpr int coarsest_px = 64;
  constexpr float contrast = 40.0F;
  cv::Mat texture(size, CV_32FC3, cv::Scalar::all(128.0));
  for (int blob_px = coarsest_px; blob_px > 1; blob_px /= 2)
  {
    cv::Mat coarse(size.height / blob_px + 4, size.width / blob_px + 4, CV_32FC3);
    random.fill(coarse, cv::RNG::UNIFORM, -contrast, contrast);
    cv::Mat octave;
    cv::resize(coarse, octave, {}, blob_px, blob_px, cv::INTER_CUBIC);
    texture += octave(cv::Rect({}, size));
  }
  cv::Mat bytes;
  texture.convertTo(bytes, CV_8U);
  return bytes;
}

struct Layer
{
  double disparity = 0.0;
  cv::Mat texture;  ///< as the reference view sees it
  cv::Mat mask;     ///< empty: everywhere
};

Layer disc(const cv::Size& size, double disparity, cv::RNG& random)
{
  Layer layer;
  layer.disparity = disparity;
  layer.texture = randomTexture(size, random);
  layer.mask = cv::Mat::zeros(size, CV_8UC1);
  const cv::Point centre(random.uniform(0, size.width), random.uniform(0, size.height));
  cv::circle(layer.mask, centre, std::min(size.width, size.height) / 7, cv::Scalar::all(255), cv::FILLED);
  return layer;
}

/// From the farthest to the nearest.
std::vector<Layer> layersOf(const cv::Size& size)
{
  constexpr std::uint64_t seed = 20170830;
  cv::RNG random(seed);
  std::vector<Layer> layers = {{LAYERED_SCENE_RANGE.min, randomTexture(size, random), {}}};
  const double span = LAYERED_SCENE_RANGE.max - LAYERED_SCENE_RANGE.min;
  for (int i = 1; i <= DISCS; ++i)
  {
    layers.push_back(disc(size, LAYERED_SCENE_RANGE.min + span * i / DISCS, random));
  }
  return layers;
}

/// What a view at these steps from the reference sees: pixel p of a layer moves to p - disparity * steps.
cv::Mat render(const std::vector<Layer>& layers, const cv::Point2d& steps)
{
  cv::Mat image;
  for (const Layer& layer : layers)
  {
    const cv::Matx23d from(1, 0, layer.disparity * steps.x, 0, 1, layer.disparity * steps.y);
    const auto moved = [&](const cv::Mat& source, int interpolation, int border)
    {
      cv::Mat target;
      cv::warpAffine(source, target, from, source.size(), interpolation | cv::WARP_INVERSE_MAP, border);
      return target;
    };
    const cv::Mat texture = moved(layer.texture, cv::INTER_CUBIC, cv::BORDER_REFLECT);
    if (layer.mask.empty())
    {
      image = texture;
      continue;
    }
    texture.copyTo(image, moved(layer.mask, cv::INTER_NEAREST, cv::BORDER_CONSTANT));
  }
  return image;
}

}  // namespace

std::vector<GridPosition> gridOf(int size)
{
  std::vector<GridPosition> positions;
  for (int row = 0; row < size; ++row)
  {
    for (int column = 0; column < size; ++column)
    {
      positions.push_back({row, column});
    }
  }
  return positions;
}

std::vector<GridPosition> crossOf(int size)
{
  std::vector<GridPosition> positions;
  for (const GridPosition& position : gridOf(size))
  {
    if (position.row == size / 2 || position.column == size / 2)
    {
      positions.push_back(position);
    }
  }
  return positions;
}

LightField layeredScene(const cv::Size& size, const std::vector<GridPosition>& positions)
{
  const std::vector<Layer> layers = layersOf(size);
  const GridPosition centre = positions[positions.size() / 2];  // of a whole grid or cross of odd size
  std::vector<View> views;
  for (const GridPosition& position : positions)
  {
    View view = gridView(position.row, position.column, {});
    view.steps = cv::Point2d(position.column - centre.column, position.row - centre.row) *
                 (LAYERED_SCENE_BASELINE / centre.column);
    view.image = render(layers, view.steps);
    views.push_back(std::move(view));
  }
  return makeLightField(std::move(views), centre);
}

}  // namespace light_field_depth::benchmark
