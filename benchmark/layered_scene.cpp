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

/// Displaces an image: the result at p is the source at p + from.
cv::Mat displaced(const cv::Mat& source, const cv::Point2d& from, int interpolation, int border)
{
  const cv::Matx23d matrix(1, 0, from.x, 0, 1, from.y);
  cv::Mat target;
  cv::warpAffine(source, target, matrix, source.size(), interpolation | cv::WARP_INVERSE_MAP, border);
  return target;
}

}  // namespace

LayeredScene::LayeredScene(const cv::Size& size, std::uint64_t seed)
{
  constexpr double fastest_px = 2.0;
  cv::RNG random(seed);
  const double span = LAYERED_SCENE_RANGE.max - LAYERED_SCENE_RANGE.min;
  for (int i = 0; i <= DISCS; ++i)
  {
    Layer layer;
    layer.disparity = LAYERED_SCENE_RANGE.min + span * i / DISCS;
    layer.motion_px = {random.uniform(-fastest_px, fastest_px), random.uniform(-fastest_px, fastest_px)};
    layer.texture = randomTexture(size, random);
    if (i > 0)  // the first one is the wall
    {
      layer.mask = cv::Mat::zeros(size, CV_8UC1);
      const cv::Point centre(random.uniform(0, size.width), random.uniform(0, size.height));
      cv::circle(layer.mask, centre, std::min(size.width, size.height) / 7, cv::Scalar::all(255), cv::FILLED);
    }
    layers_.push_back(layer);
  }
}

double LayeredScene::Layer::disparityAt(double time) const
{
  constexpr double swing_px = 0.2;
  constexpr double frames_per_radian = 20.0;
  return disparity + swing_px * std::sin(time / frames_per_radian);
}

/// Pixel p of a layer moves to p + motion * time - disparity * steps.
cv::Mat LayeredScene::render(const cv::Point2d& steps, double time) const
{
  cv::Mat image;
  for (const Layer& layer : layers_)
  {
    const cv::Point2d from = layer.disparityAt(time) * steps - layer.motion_px * time;
    const cv::Mat texture = displaced(layer.texture, from, cv::INTER_CUBIC, cv::BORDER_REFLECT);
    if (layer.mask.empty())
    {
      image = texture;
      continue;
    }
    texture.copyTo(image, displaced(layer.mask, from, cv::INTER_NEAREST, cv::BORDER_CONSTANT));
  }
  return image;
}

cv::Mat LayeredScene::truth(double time) const
{
  cv::Mat disparity(layers_.front().texture.size(), CV_32FC1);
  for (const Layer& layer : layers_)
  {
    const cv::Scalar value(layer.disparityAt(time));
    if (layer.mask.empty())
    {
      disparity.setTo(value);
      continue;
    }
    disparity.setTo(value,
                    displaced(layer.mask, -layer.motion_px * time, cv::INTER_NEAREST, cv::BORDER_CONSTANT));
  }
  return disparity;
}

LightField LayeredScene::views(const std::vector<GridPosition>& positions, double time) const
{
  const GridPosition centre = positions[positions.size() / 2];  // of a whole grid or cross of odd size
  std::vector<View> views;
  for (const GridPosition& position : positions)
  {
    View view = gridView(position.row, position.column, {});
    view.steps = cv::Point2d(position.column - centre.column, position.row - centre.row) *
                 (LAYERED_SCENE_BASELINE / centre.column);
    view.image = render(view.steps, time);
    views.push_back(std::move(view));
  }
  return makeLightField(std::move(views), centre);
}

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

}  // namespace light_field_depth::benchmark
