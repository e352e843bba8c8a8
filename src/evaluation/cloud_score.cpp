#include "light_field_depth/evaluation/cloud_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluation/figure_text.h"
#include "evaluation/surface_index.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/geometry.h"

namespace light_field_depth
{
namespace
{
/// Distances in parts of the depth at which accuracy and completeness are counted: at two metres 5, 20 and
/// 40 mm.
constexpr float FINE = 0.0025F;
constexpr float MEDIUM = 0.01F;
constexpr float COARSE = 0.02F;
/// Half the side of the window in which a flying point has a foreground and a background.
constexpr int FLYING_REACH_PX = 3;
/// Of the surface elements that are counted, along the ray.
constexpr double ELEMENT_DEPTH = 0.01;
/// Of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int POINTS_PER_CHUNK = 4096;

/// d + d_inf, which is f B / Z.
float absoluteDisparity(float disparity, const Calibration& calibration)
{
  return disparity + static_cast<float>(calibration.disparity_offset_px);
}

/// What a view truly sees at a pixel, in the optical frame of the reference view.
cv::Point3f truePoint(const ViewTruth& view, const Calibration& calibration, int x, int y)
{
  const double z = calibration.focal_length_px * calibration.baseline_m /
                   (view.disparity.at<float>(y, x) + calibration.disparity_offset_px);
  const cv::Point2d principal_point =
      calibration.principal_point_px + view.steps * calibration.disparity_offset_px + view.offset_px;
  const cv::Point2d centre = view.steps * calibration.baseline_m;
  return {static_cast<float>(centre.x + (x - principal_point.x) / calibration.focal_length_px * z),
          static_cast<float>(centre.y + (y - principal_point.y) / calibration.focal_length_px * z),
          static_cast<float>(z)};
}

/// Whether the pixel of a view is behind something nearer in the reference view, or outside of it.
bool isHidden(const ViewTruth& view, const ViewTruth& reference, const Calibration& calibration, int x, int y)
{
  const float disparity = view.disparity.at<float>(y, x);
  const cv::Point2d there = cv::Point2d(x, y) + disparity * view.steps - view.offset_px;
  const int column = cvRound(there.x);
  const int row = cvRound(there.y);
  const cv::Mat& map = reference.disparity;
  if (column < 0 || row < 0 || column >= map.cols || row >= map.rows)
  {
    return true;
  }
  return absoluteDisparity(map.at<float>(row, column), calibration) >
         (1.0F + COARSE) * absoluteDisparity(disparity, calibration);
}

bool isKnown(const ViewTruth& view, const Calibration& calibration, int x, int y)
{
  return std::isfinite(depthFromDisparity(view.disparity.at<float>(y, x), calibration));
}

/// Depths of the nearest and farthest surface within FLYING_REACH_PX of each pixel of the reference view.
struct DepthExtent
{
  cv::Mat nearest;
  cv::Mat farthest;
};

DepthExtent depthExtent(const CloudTruth& truth)
{
  const cv::Mat depth = depthMap(truth.views.front().disparity, truth.calibration);
  const cv::Mat window = cv::Mat::ones(2 * FLYING_REACH_PX + 1, 2 * FLYING_REACH_PX + 1, CV_8UC1);
  DepthExtent extent;
  cv::erode(depth, extent.nearest, window);
  cv::dilate(depth, extent.farthest, window);
  return extent;
}

bool isBetween(const cv::Point3f& point, const DepthExtent& extent, const Calibration& calibration)
{
  const double x = calibration.principal_point_px.x + calibration.focal_length_px * point.x / point.z;
  const double y = calibration.principal_point_px.y + calibration.focal_length_px * point.y / point.z;
  const bool inside = x > -0.5 && y > -0.5 && x < extent.nearest.cols - 0.5 && y < extent.nearest.rows - 0.5;
  return inside && point.z > extent.nearest.at<float>(cvRound(y), cvRound(x)) &&
         point.z < extent.farthest.at<float>(cvRound(y), cvRound(x));
}

std::vector<float> distances(const std::vector<cv::Point3f>& points, const SurfaceIndex& index,
                             ThreadPool& pool)
{
  std::vector<float> found(points.size());
  pool.parallelFor(0, static_cast<int>(points.size()), POINTS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       found[i] = index.distance(points[i], COARSE);
                     }
                   });
  return found;
}

double percentageWithin(const std::vector<float>& distances, float threshold)
{
  const auto near =
      std::count_if(distances.begin(), distances.end(), [&](float distance) { return distance < threshold; });
  return distances.empty() ? std::numeric_limits<double>::quiet_NaN()
                           : 100.0 * static_cast<double>(near) / static_cast<double>(distances.size());
}

std::size_t countElements(const std::vector<cv::Point3f>& points, double focal_length_px)
{
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  constexpr int bits = 21;
  constexpr std::int64_t middle = std::int64_t{1} << (bits - 1);
  const auto cell = [](double position)
  { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(position)) + middle); };
  for (const cv::Point3f& point : points)
  {
    keys.push_back(cell(point.x * focal_length_px) << (2 * bits) | cell(point.y * focal_length_px) << bits |
                   cell(point.z / ELEMENT_DEPTH));
  }
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

std::array<std::pair<const char*, double>, 11> namedFigures(const CloudScore& score)
{
  return {{{"points", static_cast<double>(score.points)},
           {"surface_elements", static_cast<double>(score.surface_elements)},
           {"accuracy_025", score.accuracy_025},
           {"accuracy_1", score.accuracy_1},
           {"off_2", score.off_2},
           {"flying", score.flying},
           {"completeness_025", score.completeness_025},
           {"completeness_1", score.completeness_1},
           {"completeness_2", score.completeness_2},
           {"hidden_1", score.hidden_1},
           {"hidden_2", score.hidden_2}}};
}

/// The true surfaces as points: what the reference sees, and what it does not.
struct TrueSurfaces
{
  std::vector<cv::Point3f> all;
  std::vector<cv::Point3f> seen;
  std::vector<cv::Point3f> hidden;
};

TrueSurfaces surfacesOf(const CloudTruth& truth)
{
  TrueSurfaces surfaces;
  for (std::size_t i = 0; i < truth.views.size(); ++i)
  {
    const ViewTruth& view = truth.views[i];
    const cv::Mat hidden = i == 0 ? cv::Mat() : hiddenFromReference(truth, i);
    for (int y = 0; y < view.disparity.rows; ++y)
    {
      for (int x = 0; x < view.disparity.cols; ++x)
      {
        if (!isKnown(view, truth.calibration, x, y))
        {
          continue;
        }
        const cv::Point3f point = projective(truePoint(view, truth.calibration, x, y));
        surfaces.all.push_back(point);
        if (i == 0)
        {
          surfaces.seen.push_back(point);
        }
        else if (hidden.at<std::uint8_t>(y, x) != 0)
        {
          surfaces.hidden.push_back(point);
        }
      }
    }
  }
  if (surfaces.seen.empty())
  {
    throw InputError("The truth of the reference view has no finite depth to score against.");
  }
  return surfaces;
}

}  // namespace

cv::Mat hiddenFromReference(const CloudTruth& truth, std::size_t view)
{
  const ViewTruth& seen = truth.views[view];
  cv::Mat hidden = cv::Mat::zeros(seen.disparity.size(), CV_8UC1);
  for (int y = 0; y < hidden.rows; ++y)
  {
    for (int x = 0; x < hidden.cols; ++x)
    {
      const bool is_hidden = isKnown(seen, truth.calibration, x, y) &&
                             isHidden(seen, truth.views.front(), truth.calibration, x, y);
      hidden.at<std::uint8_t>(y, x) = is_hidden ? 255 : 0;
    }
  }
  return hidden;
}

CloudScore scoreCloud(const std::vector<cv::Point3f>& points, const CloudTruth& truth, ThreadPool& pool)
{
  if (points.empty())
  {
    throw InputError("The cloud has no points to score.");
  }
  std::vector<cv::Point3f> cloud;
  cloud.reserve(points.size());
  for (const cv::Point3f& point : points)
  {
    if (!(point.z > 0.0F) || !std::isfinite(point.x + point.y + point.z))
    {
      throw InputError(
          "The cloud has a point that is not in front of the camera; score clouds in the optical frame "
          "(x right, y down, z forward), without --y-up.");
    }
    cloud.push_back(projective(point));
  }
  const auto focal_length_px = static_cast<float>(truth.calibration.focal_length_px);
  const TrueSurfaces surfaces = surfacesOf(truth);
  const SurfaceIndex true_index(surfaces.all, 1.0F / focal_length_px);
  const SurfaceIndex cloud_index(cloud, 1.0F / focal_length_px);

  CloudScore score;
  score.points = points.size();
  score.surface_elements = countElements(cloud, focal_length_px);
  const std::vector<float> errors = distances(cloud, true_index, pool);
  score.accuracy_025 = percentageWithin(errors, FINE);
  score.accuracy_1 = percentageWithin(errors, MEDIUM);
  score.off_2 = 100.0 - percentageWithin(errors, COARSE);
  const DepthExtent extent = depthExtent(truth);
  std::size_t flying = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    flying +=
        static_cast<std::size_t>(errors[i] >= COARSE && isBetween(points[i], extent, truth.calibration));
  }
  score.flying = 100.0 * static_cast<double>(flying) / static_cast<double>(points.size());
  const std::vector<float> seen = distances(surfaces.seen, cloud_index, pool);
  score.completeness_025 = percentageWithin(seen, FINE);
  score.completeness_1 = percentageWithin(seen, MEDIUM);
  score.completeness_2 = percentageWithin(seen, COARSE);
  const std::vector<float> hidden = distances(surfaces.hidden, cloud_index, pool);
  score.hidden_1 = percentageWithin(hidden, MEDIUM);
  score.hidden_2 = percentageWithin(hidden, COARSE);
  return score;
}

std::string toText(const CloudScore& score)
{
  return figureText(namedFigures(score));
}

std::string toJson(const CloudScore& score)
{
  nlohmann::json json;
  for (const auto& [name, value] : namedFigures(score))
  {
    json[name] = value;
  }
  return json.dump();
}

}  // namespace light_field_depth
