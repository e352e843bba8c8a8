#include "support/synthetic_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::testing
{
namespace
{
/// A number in 0..1 that depends on a lattice point alone.
float latticeValue(std::uint32_t seed, std::int32_t x, std::int32_t y)
{
  std::uint32_t h = seed * 0x9E3779B9U ^ static_cast<std::uint32_t>(x) * 0x85EBCA6BU ^
                    static_cast<std::uint32_t>(y) * 0xC2B2AE35U;
  h ^= h >> 15;
  h *= 0x2C1B3C6DU;
  h ^= h >> 12;
  h *= 0x297A2D39U;
  h ^= h >> 15;
  return static_cast<float>(h & 0xFFFFFFU) / 16777215.0F;
}

/// A place between the points of a lattice, with weights for C2-continuous interpolation.
struct LatticePlace
{
  LatticePlace(double x, double y)
  {
    const double floor_x = std::floor(x);
    const double floor_y = std::floor(y);
    const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
    u = static_cast<float>(fade(x - floor_x));
    v = static_cast<float>(fade(y - floor_y));
    ix = static_cast<std::int32_t>(floor_x);
    iy = static_cast<std::int32_t>(floor_y);
  }

  /// Value noise, 0..1.
  float noise(std::uint32_t seed) const
  {
    const float top = latticeValue(seed, ix, iy) * (1 - u) + latticeValue(seed, ix + 1, iy) * u;
    const float bottom = latticeValue(seed, ix, iy + 1) * (1 - u) + latticeValue(seed, ix + 1, iy + 1) * u;
    return top * (1 - v) + bottom * v;
  }

  std::int32_t ix;
  std::int32_t iy;
  float u;
  float v;
};

/// Where the reference view sees the point of `surface` that a view at `steps` sees at `pixel`.
cv::Point2d toReference(const Surface& surface, const cv::Point2d& pixel, const cv::Point2d& steps)
{
  cv::Point2d p = pixel + surface.disparity(pixel.x, pixel.y) * steps;
  for (int i = 0; i < 12; ++i)
  {
    const cv::Point2d next = pixel + surface.disparity(p.x, p.y) * steps;
    const bool settled = std::abs(next.x - p.x) + std::abs(next.y - p.y) < 1e-9;
    p = next;
    if (settled)
    {
      break;
    }
  }
  return p;
}

struct Hit
{
  double disparity = -std::numeric_limits<double>::infinity();
  const Surface* surface = nullptr;
  cv::Point2d point;
};

Hit trace(const std::vector<Surface>& surfaces, const cv::Point2d& pixel, const cv::Point2d& steps)
{
  Hit nearest;
  for (const Surface& surface : surfaces)
  {
    const cv::Point2d p = toReference(surface, pixel, steps);
    if (surface.inside && !surface.inside(p.x, p.y))
    {
      continue;
    }
    const double disparity = surface.disparity(p.x, p.y);
    if (disparity > nearest.disparity)
    {
      nearest = {disparity, &surface, p};
    }
  }
  return nearest;
}

void renderRows(const std::vector<Surface>& surfaces, int n, const cv::Point2d& steps, int first, int last,
                cv::Mat& values)
{
  for (int y = first; y < last; ++y)
  {
    for (int x = 0; x < values.cols; ++x)
    {
      cv::Vec3f sum(0, 0, 0);
      for (int i = 0; i < n * n; ++i)
      {
        const cv::Point2d pixel(x + (i % n + 0.5) / n - 0.5, y + (i / n + 0.5) / n - 0.5);
        const Hit hit = trace(surfaces, pixel, steps);
        if (hit.surface != nullptr)
        {
          sum += hit.surface->texture(hit.point.x, hit.point.y);
        }
      }
      values.at<cv::Vec3f>(y, x) = sum * (1.0F / static_cast<float>(n * n));
    }
  }
}

cv::Mat renderView(const std::vector<Surface>& surfaces, const SceneSettings& settings,
                   const cv::Point2d& steps, ThreadPool& pool)
{
  constexpr int ROWS_PER_CHUNK = 8;
  cv::Mat values(settings.size, CV_32FC3);
  pool.parallelFor(0, values.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   { renderRows(surfaces, settings.samples, steps, first, last, values); });
  return values;
}

cv::Mat toBytes(const cv::Mat& values, bool grey)
{
  cv::Mat bytes;
  values.convertTo(bytes, CV_8U);
  if (grey)
  {
    cv::transform(bytes, bytes, cv::Matx13f(0.114F, 0.587F, 0.299F));
  }
  return bytes;
}

}  // namespace

Texture noiseTexture(std::uint32_t seed, double scale_px, cv::Vec3f mean, float contrast)
{
  return [=](double x, double y)
  {
    cv::Vec3f color = mean;
    double scale = scale_px;
    float amplitude = contrast;
    for (int octave = 0; octave < 4; ++octave)
    {
      const LatticePlace place(x / scale, y / scale);
      for (int channel = 0; channel < 3; ++channel)
      {
        const std::uint32_t octave_seed = seed * 64U + static_cast<std::uint32_t>(octave * 4 + channel);
        color[channel] += amplitude * (place.noise(octave_seed) - 0.5F);
      }
      scale *= 0.5;
      amplitude *= 0.7F;
    }
    return color;
  };
}

Texture constantTexture(cv::Vec3f color)
{
  return [=](double, double) { return color; };
}

Texture stripeTexture(double period_px, bool vertical, cv::Vec3f dark, cv::Vec3f bright)
{
  return [=](double x, double y)
  {
    const auto t = static_cast<float>(0.5 + 0.5 * std::sin(2.0 * CV_PI * (vertical ? x : y) / period_px));
    return dark * (1 - t) + bright * t;
  };
}

Texture checkerTexture(double square_px, cv::Vec3f dark, cv::Vec3f bright)
{
  return [=](double x, double y)
  {
    const auto parity = static_cast<std::int64_t>(std::floor(x / square_px)) +
                        static_cast<std::int64_t>(std::floor(y / square_px));
    return parity % 2 == 0 ? dark : bright;
  };
}

Surface plane(double disparity, double slope_x, double slope_y, Texture texture)
{
  return {[=](double x, double y) { return disparity + slope_x * x + slope_y * y; }, {}, std::move(texture)};
}

Surface rectangle(double disparity, const cv::Rect2d& area, Texture texture)
{
  return {[=](double, double) { return disparity; },
          [=](double x, double y) { return area.contains(cv::Point2d(x, y)); }, std::move(texture)};
}

Surface bump(double base, double height_px, cv::Point2d centre, double radius, Texture texture)
{
  const auto height = [=](double x, double y)
  {
    const double r2 = ((x - centre.x) * (x - centre.x) + (y - centre.y) * (y - centre.y)) / (radius * radius);
    return base + height_px * std::sqrt(std::max(0.0, 1.0 - r2));
  };
  const auto inside = [=](double x, double y) { return std::hypot(x - centre.x, y - centre.y) <= radius; };
  return {height, inside, std::move(texture)};
}

std::vector<GridPosition> gridPositions(int rows, int columns)
{
  std::vector<GridPosition> positions;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      positions.push_back({row, column});
    }
  }
  return positions;
}

std::vector<GridPosition> crossPositions(int rows, int columns)
{
  std::vector<GridPosition> positions = gridPositions(rows, columns);
  positions.erase(std::remove_if(positions.begin(), positions.end(),
                                 [&](const GridPosition& p)
                                 { return p.row != (rows - 1) / 2 && p.column != (columns - 1) / 2; }),
                  positions.end());
  return positions;
}

SyntheticLightField renderScene(const std::vector<Surface>& surfaces, const SceneSettings& settings)
{
  std::vector<View> views;
  for (const GridPosition& position : settings.positions)
  {
    views.push_back(gridView(position.row, position.column, cv::Mat(settings.size, CV_8UC1)));
  }
  SyntheticLightField result;
  result.light_field = makeLightField(std::move(views), settings.reference, settings.calibration);
  cv::RNG random(settings.noise_seed);
  ThreadPool pool;
  for (View& view : result.light_field.views)
  {
    cv::Mat values = renderView(surfaces, settings, view.steps, pool);
    if (settings.degrade)
    {
      settings.degrade(view.grid, values);
    }
    if (settings.noise_sigma > 0.0)
    {
      cv::Mat noise(values.size(), CV_32FC3);
      random.fill(noise, cv::RNG::NORMAL, 0.0, settings.noise_sigma);
      values += noise;
    }
    view.image = toBytes(values, settings.grey);
  }
  result.truth = renderTruth(surfaces, settings.size, {0.0, 0.0});
  return result;
}

cv::Mat renderTruth(const std::vector<Surface>& surfaces, const cv::Size& size, const cv::Point2d& steps)
{
  cv::Mat truth(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      truth.at<float>(y, x) = static_cast<float>(trace(surfaces, cv::Point2d(x, y), steps).disparity);
    }
  }
  return truth;
}

std::vector<Surface> standardScene(const cv::Size& size)
{
  const double w = size.width;
  const double h = size.height;
  return {
      plane(-1.2, 0.5 / w, 0.4 / h, noiseTexture(1, 24.0, {110, 130, 140})),
      rectangle(1.3, {0.15 * w, 0.2 * h, 0.25 * w, 0.55 * h}, noiseTexture(2, 16.0, {150, 110, 90})),
      bump(0.4, 1.6, {0.7 * w, 0.55 * h}, 0.2 * w, noiseTexture(3, 20.0, {100, 120, 160})),
  };
}

double meanAbsoluteError(const cv::Mat& disparity, const cv::Mat& truth, int border)
{
  const cv::Rect inner(border, border, truth.cols - 2 * border, truth.rows - 2 * border);
  return cv::norm(disparity(inner), truth(inner), cv::NORM_L1) / inner.area();
}

double badPercentage(const cv::Mat& disparity, const cv::Mat& truth, double threshold_px, int border)
{
  const cv::Rect inner(border, border, truth.cols - 2 * border, truth.rows - 2 * border);
  int bad = 0;
  for (int y = inner.y; y < inner.br().y; ++y)
  {
    for (int x = inner.x; x < inner.br().x; ++x)
    {
      const float error = std::abs(disparity.at<float>(y, x) - truth.at<float>(y, x));
      bad += error <= threshold_px ? 0 : 1;  // NaN counts as bad
    }
  }
  return 100.0 * bad / inner.area();
}

}  // namespace light_field_depth::testing
