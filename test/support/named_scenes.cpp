#include "support/named_scenes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace light_field_depth::testing
{
namespace
{
constexpr int WIDTH = 192;
constexpr int HEIGHT = 144;

SceneSettings seenBy(std::vector<GridPosition> positions)
{
  SceneSettings settings;
  settings.size = cv::Size(WIDTH, HEIGHT);
  settings.positions = std::move(positions);
  settings.samples = 2;
  return settings;
}

SceneSettings seenByCross()
{
  return seenBy(crossPositions(9, 9));
}

/// 0..1, with the same value for a number wherever it is asked.
double scatter(int number)
{
  const double value = std::sin(12.9898 * number) * 43758.5453;
  return value - std::floor(value);
}

Texture horizontalShading(cv::Vec3f left, cv::Vec3f right)
{
  return [=](double x, double)
  {
    const auto t = static_cast<float>(std::clamp(x / WIDTH, 0.0, 1.0));
    return left * (1 - t) + right * t;
  };
}

/// A disc whose colour turns into the colour of `behind` over the outer part of its radius.
Surface softDisc(double disparity, cv::Point2d centre, double radius, double rim_px, const Texture& front,
                 const Texture& behind)
{
  const auto distance = [=](double x, double y) { return std::hypot(x - centre.x, y - centre.y); };
  const auto mixed = [=](double x, double y)
  {
    const auto t = static_cast<float>(std::clamp((radius - distance(x, y)) / rim_px, 0.0, 1.0));
    return front(x, y) * t + behind(x, y) * (1 - t);
  };
  return {[=](double, double) { return disparity; },
          [=](double x, double y) { return distance(x, y) <= radius; }, mixed};
}

}  // namespace

NamedScene thinStructures()
{
  std::vector<Surface> surfaces = {plane(-1.0, 0, 0, noiseTexture(21, 20.0, {120, 130, 110}))};
  for (int bar = 0; bar < 8; ++bar)
  {
    const double thickness = 1.0 + bar % 4;
    const cv::Rect2d upright(12.0 + 22.0 * bar, 8.0, thickness, 80.0);
    const cv::Rect2d lying(10.0, 96.0 + 5.5 * bar, 170.0, 0.5 * thickness + 0.5);
    const float shade = bar % 2 == 0 ? 40.0F : 215.0F;
    surfaces.push_back(rectangle(0.4 + 0.2 * bar, upright, constantTexture({shade, shade, shade * 0.8F})));
    surfaces.push_back(rectangle(0.3 + 0.1 * bar, lying, constantTexture({shade * 0.8F, shade, shade})));
  }
  return {"thin_structures", surfaces, seenByCross()};
}

NamedScene fineStripes()
{
  std::vector<Surface> surfaces = {plane(-0.8, 0, 0, stripeTexture(9.0, true))};
  constexpr int PANELS = 6;
  for (int panel = 0; panel < PANELS; ++panel)
  {
    const cv::Rect2d area(8.0 + 62.0 * (panel % 3), 10.0 + 66.0 * static_cast<int>(panel / 3), 46.0, 52.0);
    surfaces.push_back(rectangle(-0.3 + 0.3 * panel, area, stripeTexture(3.0 + 1.6 * panel, panel % 2 == 0)));
  }
  return {"fine_stripes", surfaces, seenByCross()};
}

NamedScene repeatedTexture()
{
  const double w = WIDTH;
  return {"repeated_texture",
          {plane(0.0, 0, 0, noiseTexture(22, 18.0)),
           rectangle(2.0, {0.08 * w, 12.0, 0.36 * w, 110.0}, checkerTexture(3.0)),
           rectangle(4.0, {0.55 * w, 20.0, 0.36 * w, 100.0}, checkerTexture(5.0, {40, 90, 140}))},
          seenBy(gridPositions(3, 3))};
}

NamedScene slantedPlanes()
{
  const double h = HEIGHT;
  const auto floor_disparity = [=](double, double y) { return -1.5 + 3.5 * (y - 0.5 * h) / (0.5 * h); };
  const auto roof_disparity = [=](double, double y) { return -1.5 + 3.0 * (0.25 * h - y) / (0.25 * h); };
  const Surface floor = {floor_disparity, [=](double, double y) { return y > 0.5 * h; },
                         noiseTexture(24, 14.0, {90, 110, 140})};
  const Surface roof = {roof_disparity, [=](double, double y) { return y < 0.25 * h; },
                        noiseTexture(25, 14.0, {150, 120, 100})};
  return {"slanted_planes", {plane(-1.6, 0.003, 0, noiseTexture(23, 16.0)), floor, roof}, seenByCross()};
}

NamedScene gradients()
{
  const double w = WIDTH;
  return {"gradients",
          {plane(-1.2, 0, 0.002, horizontalShading({210, 200, 180}, {20, 30, 50})),
           rectangle(0.0, {0.1 * w, 20.0, 0.3 * w, 60.0}, horizontalShading({60, 70, 200}, {90, 220, 120})),
           rectangle(0.9, {0.55 * w, 40.0, 0.3 * w, 80.0}, noiseTexture(26, 12.0)),
           bump(0.2, 1.2, {0.28 * w, 110.0}, 26.0, horizontalShading({200, 160, 60}, {40, 60, 220}))},
          seenByCross()};
}

NamedScene softEdges()
{
  const Texture wall = noiseTexture(27, 30.0, {110, 120, 130}, 60.0F);
  const Texture front = noiseTexture(28, 12.0, {190, 120, 70});
  return {"soft_edges",
          {plane(-0.9, 0, 0, wall), softDisc(1.0, {60, 70}, 40.0, 4.0, front, wall),
           softDisc(0.4, {140, 70}, 34.0, 8.0, front, wall)},
          seenByCross()};
}

NamedScene sparseArray()
{
  const double w = WIDTH;
  return {"sparse_array",
          {plane(1.0, 0.01, 0, noiseTexture(29, 20.0)),
           rectangle(6.0, {0.15 * w, 30.0, 0.3 * w, 80.0}, noiseTexture(30, 14.0, {90, 120, 160})),
           rectangle(10.0, {0.6 * w, 45.0, 0.2 * w, 50.0}, noiseTexture(31, 10.0, {160, 110, 90}))},
          seenBy(gridPositions(3, 3))};
}

NamedScene noise()
{
  SceneSettings settings = seenByCross();
  settings.noise_sigma = 5.0;
  return {"noise", standardScene(settings.size), settings};
}

NamedScene darkAndNoisy()
{
  SceneSettings settings = seenByCross();
  settings.noise_sigma = 3.0;
  settings.degrade = [](const GridPosition&, cv::Mat& values)
  { values = values * 0.2 + cv::Scalar::all(8.0); };
  return {"dark_and_noisy", standardScene(settings.size), settings};
}

NamedScene vignetting()
{
  SceneSettings settings = seenByCross();
  settings.degrade = [](const GridPosition& grid, cv::Mat& values)
  {
    constexpr double HALF_DIAGONAL = 0.5 * 240.0;
    const double strength = 0.10 + 0.03 * std::hypot(grid.row - 4, grid.column - 4);
    for (int y = 0; y < values.rows; ++y)
    {
      for (int x = 0; x < values.cols; ++x)
      {
        const double r = std::hypot(x - 0.5 * values.cols, y - 0.5 * values.rows) / HALF_DIAGONAL;
        values.at<cv::Vec3f>(y, x) *= static_cast<float>(1.0 - strength * r * r);
      }
    }
  };
  return {"vignetting", standardScene(settings.size), settings};
}

NamedScene exposureDifferences()
{
  SceneSettings settings = seenByCross();
  settings.degrade = [](const GridPosition& grid, cv::Mat& values)
  {
    const bool reference = grid.row == 4 && grid.column == 4;
    const double gain = reference ? 1.0 : 0.8 + 0.4 * scatter(9 * grid.row + grid.column);
    const double offset = reference ? 0.0 : -8.0 + 16.0 * scatter(100 + 9 * grid.row + grid.column);
    values = values * gain + cv::Scalar::all(offset);
  };
  return {"exposure_differences", standardScene(settings.size), settings};
}

NamedScene viewDependentBrightness()
{
  SceneSettings settings = seenByCross();
  settings.degrade = [](const GridPosition& grid, cv::Mat& values)
  {
    // A band that becomes brighter by 0.8 grey levels from view to view, as gloss does.
    constexpr double LEVELS_PER_VIEW = 0.8;
    values.rowRange(HEIGHT / 2, HEIGHT) += cv::Scalar::all(LEVELS_PER_VIEW * (grid.row + grid.column - 8));
  };
  return {"view_dependent_brightness", standardScene(settings.size), settings};
}

NamedScene strongOcclusion()
{
  std::vector<Surface> surfaces = {
      plane(-1.5, 0, 0, noiseTexture(32, 16.0)),
      rectangle(-0.3, {30.0, 30.0, 130.0, 80.0}, noiseTexture(33, 12.0, {80, 120, 160}))};
  constexpr int PICKETS = 9;
  for (int picket = 0; picket < PICKETS; ++picket)
  {
    surfaces.push_back(rectangle(2.2, {4.0 + 21.0 * picket, -50.0, 10.0, 300.0},
                                 noiseTexture(40U + static_cast<unsigned>(picket), 9.0, {140, 130, 70})));
  }
  return {"strong_occlusion", surfaces, seenByCross()};
}

NamedScene clutter()
{
  std::vector<Surface> surfaces = {plane(-1.4, 0, 0, noiseTexture(34, 16.0))};
  constexpr int SQUARES = 40;
  for (int square = 0; square < SQUARES; ++square)
  {
    const double side = 6.0 + 16.0 * scatter(3 * square);
    const cv::Rect2d area((WIDTH - side) * scatter(3 * square + 1), (HEIGHT - side) * scatter(3 * square + 2),
                          side, side);
    const auto hue = static_cast<float>(square * 4);
    surfaces.push_back(
        rectangle(-1.2 + 3.0 * square / SQUARES, area,
                  noiseTexture(60U + static_cast<unsigned>(square), 8.0, {60 + hue, 130, 210 - hue})));
  }
  return {"clutter", surfaces, seenBy(gridPositions(5, 5))};
}

NamedScene singleRow()
{
  SceneSettings settings = seenBy(gridPositions(1, 5));
  return {"single_row", standardScene(settings.size), settings};
}

std::vector<NamedScene> namedScenes()
{
  return {thinStructures(),
          fineStripes(),
          repeatedTexture(),
          slantedPlanes(),
          gradients(),
          softEdges(),
          sparseArray(),
          noise(),
          darkAndNoisy(),
          vignetting(),
          exposureDifferences(),
          viewDependentBrightness(),
          strongOcclusion(),
          clutter(),
          singleRow()};
}

}  // namespace light_field_depth::testing
