#include "io/planar_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "io/folder_listing.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace fs = std::filesystem;

/// Farther from their plane than this part of the rig's width, cameras see the scene at another scale than
/// the others by more than half a pixel of a hundred, for a scene as far away as the rig is wide.
constexpr double MAX_OFF_PLANE = 0.03;
/// A rig is a row if it is narrower than this part of its length.
constexpr double MAX_ROW_WIDTH = 0.05;
/// Cameras that look farther away from the common direction share too little of the image.
constexpr double MAX_ANGLE_DEG = 30.0;
/// Positions nearer to each other than this part of the usual distance of neighbours are one row or column.
constexpr double SAME_LINE = 0.4;
/// Warps that move no pixel farther than this are left out.
constexpr double MIN_WARP_PX = 0.01;
constexpr double DEG_PER_RAD = 57.29577951308232;  // 180 / pi

struct Plane
{
  cv::Matx33d rotation;  ///< of the common camera
  cv::Vec3d middle;
};

cv::Vec3d column(const cv::Matx33d& matrix, int index)
{
  return {matrix(0, index), matrix(1, index), matrix(2, index)};
}

cv::Vec3d mean(const std::vector<PosedImage>& images, int axis)
{
  cv::Vec3d sum;
  for (const PosedImage& image : images)
  {
    sum += axis < 0 ? image.centre : column(image.rotation, axis);
  }
  return sum * (1.0 / static_cast<double>(images.size()));
}

/// The normal of the plane of the cameras, or of the row nearest to their common direction.
cv::Vec3d normalOf(const std::vector<PosedImage>& images, const cv::Vec3d& middle, const cv::Vec3d& direction)
{
  cv::Matx33d scatter = cv::Matx33d::zeros();
  for (const PosedImage& image : images)
  {
    const cv::Vec3d d = image.centre - middle;
    scatter += d * d.t();
  }
  cv::Matx31d values;
  cv::Matx33d vectors;
  cv::eigen(scatter, values, vectors);
  const bool is_row = std::sqrt(std::max(values(1), 0.0)) <= MAX_ROW_WIDTH * std::sqrt(values(0));
  const cv::Vec3d along(vectors(0, 0), vectors(0, 1), vectors(0, 2));
  cv::Vec3d normal = is_row ? direction - along * direction.dot(along)
                            : cv::Vec3d(vectors(2, 0), vectors(2, 1), vectors(2, 2));
  normal = cv::normalize(normal);
  return normal.dot(direction) < 0.0 ? -normal : normal;
}

double angleDeg(const cv::Vec3d& a, const cv::Vec3d& b)
{
  return std::acos(std::clamp(cv::normalize(a).dot(cv::normalize(b)), -1.0, 1.0)) * DEG_PER_RAD;
}

std::string percent(double part)
{
  std::ostringstream text;
  text.precision(2);
  text << 100.0 * part << " %";
  return text.str();
}

/// @throw InputError if a camera looks elsewhere or stands too far from the plane
void checkPlane(const fs::path& source, const std::vector<PosedImage>& images, const CommonPlane& plane)
{
  const cv::Vec3d normal = column(plane.rotation, 2);
  double off_plane = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    off_plane = std::max(off_plane, std::abs(plane.off_plane[i]));
    const double angle = angleDeg(column(images[i].rotation, 2), normal);
    if (angle > MAX_ANGLE_DEG)
    {
      throw InputError("The camera of '" + images[i].path.filename().string() + "' looks " +
                       std::to_string(std::lround(angle)) +
                       " degrees away from the normal of the cameras' plane in '" + source.string() +
                       "'; a light field needs cameras that look alike.");
    }
  }
  if (!(plane.width > 0.0))
  {
    throw InputError("All cameras in '" + source.string() +
                     "' stand at one place; disparity needs a baseline.");
  }
  if (off_plane > MAX_OFF_PLANE * plane.width)
  {
    throw InputError("The cameras in '" + source.string() + "' stand up to " +
                     percent(off_plane / plane.width) + " of the rig's width away from a common plane (" +
                     percent(MAX_OFF_PLANE) + " are allowed); only planar rigs are light fields.");
  }
}

Plane fitPlane(const std::vector<PosedImage>& images)
{
  Plane plane;
  plane.middle = mean(images, -1);
  const cv::Vec3d z = normalOf(images, plane.middle, mean(images, 2));
  const cv::Vec3d right = mean(images, 0);
  const cv::Vec3d x = cv::normalize(right - z * right.dot(z));
  const cv::Vec3d y = z.cross(x);
  plane.rotation = cv::Matx33d(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
  return plane;
}

/// The common camera: the mean focal length, and the mean direction in the middle of the image.
Intrinsics commonCamera(const std::vector<PosedImage>& images, const Plane& plane)
{
  Intrinsics common;
  common.size = images.front().intrinsics.size;
  for (const PosedImage& image : images)
  {
    common.fx += 0.5 * (image.intrinsics.fx + image.intrinsics.fy) / static_cast<double>(images.size());
  }
  common.fy = common.fx;
  const cv::Vec3d direction = plane.rotation.t() * mean(images, 2);
  common.cx = 0.5 * (common.size.width - 1) - common.fx * direction[0] / direction[2];
  common.cy = 0.5 * (common.size.height - 1) - common.fy * direction[1] / direction[2];
  return common;
}

cv::Point2d sourcePixel(const ViewWarp& warp, double x, double y)
{
  const cv::Vec3d ray = warp.rotation * cv::Vec3d((x - warp.common.cx) / warp.common.fx,
                                                  (y - warp.common.cy) / warp.common.fy, 1.0);
  const double u = ray[0] / ray[2];
  const double v = ray[1] / ray[2];
  const Intrinsics& source = warp.source;
  const double r2 = u * u + v * v;
  const double radial = 1.0 + r2 * (source.k1 + r2 * source.k2);
  return {source.fx * (u * radial + 2.0 * source.p1 * u * v + source.p2 * (r2 + 2.0 * u * u)) + source.cx,
          source.fy * (v * radial + source.p1 * (r2 + 2.0 * v * v) + 2.0 * source.p2 * u * v) + source.cy};
}

bool movesPixels(const ViewWarp& warp)
{
  constexpr std::array<double, 3> PARTS = {0.0, 0.5, 1.0};
  double farthest = 0.0;
  for (const double part_y : PARTS)
  {
    for (const double part_x : PARTS)
    {
      const cv::Point2d pixel(part_x * warp.common.size.width, part_y * warp.common.size.height);
      farthest = std::max(farthest, cv::norm(sourcePixel(warp, pixel.x, pixel.y) - pixel));
    }
  }
  return farthest > MIN_WARP_PX || warp.source.size != warp.common.size;
}

double usualDistance(const std::vector<cv::Point2d>& positions)
{
  std::vector<double> nearest;
  for (const cv::Point2d& position : positions)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const cv::Point2d& other : positions)
    {
      if (&other != &position)
      {
        least = std::min(least, cv::norm(other - position));
      }
    }
    nearest.push_back(least);
  }
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2),
                   nearest.end());
  return nearest[nearest.size() / 2];
}

/// Numbers values in their order; values nearer than `same` to the one before share its number.
std::vector<int> lineNumbers(const std::vector<double>& values, double same)
{
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<int> numbers(values.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    numbers[order[i]] = numbers[order[i - 1]] + (values[order[i]] - values[order[i - 1]] > same ? 1 : 0);
  }
  return numbers;
}

/// Where each pixel of the common camera is in the image.
cv::Mat mapOf(const ViewWarp& warp)
{
  cv::Mat map(warp.common.size, CV_32FC2);
  for (int y = 0; y < map.rows; ++y)
  {
    for (int x = 0; x < map.cols; ++x)
    {
      const cv::Point2d pixel = sourcePixel(warp, x, y);
      map.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x), static_cast<float>(pixel.y)};
    }
  }
  return map;
}

}  // namespace

cv::Matx33d nearestRotation(const cv::Matx33d& matrix, const std::string& name)
{
  cv::Matx31d values;
  cv::Matx33d u;
  cv::Matx33d vt;
  cv::SVD::compute(matrix, values, u, vt);
  const cv::Matx33d rotation = u * vt;
  if (!(values(2) > 1e-6 * values(0)) || !(cv::determinant(rotation) > 0.0))
  {
    throw InputError("The pose of '" + name + "' is no rotation; check its matrix.");
  }
  return rotation;
}

fs::path findFrame(const fs::path& folder, const std::string& name)
{
  for (const char* const inside : {"", "images", "png", "exr", "jpg"})
  {
    for (const char* const ending : {"", ".png", ".exr", ".jpg", ".jpeg", ".PNG", ".JPG", ".tif", ".tiff"})
    {
      fs::path path = folder / inside / (name + ending);
      if (isFile(path))
      {
        return path;
      }
    }
  }
  return {};
}

CommonPlane fitCommonPlane(const fs::path& source, const std::vector<PosedImage>& images)
{
  const Plane fitted = fitPlane(images);
  CommonPlane plane;
  plane.rotation = fitted.rotation;
  plane.common = commonCamera(images, fitted);
  for (const PosedImage& image : images)
  {
    const cv::Vec3d d = image.centre - fitted.middle;
    const cv::Vec3d position = fitted.rotation.t() * d;
    plane.positions.emplace_back(position[0], position[1]);
    const cv::Vec3d normal = column(fitted.rotation, 2);
    plane.off_plane.push_back(d.dot(normal));
    plane.width = std::max(plane.width, 2.0 * cv::norm(d - normal * d.dot(normal)));
  }
  checkPlane(source, images, plane);
  return plane;
}

std::vector<GridPosition> numberCameras(const CommonPlane& plane)
{
  std::vector<double> x;
  std::vector<double> y;
  for (const cv::Point2d& position : plane.positions)
  {
    x.push_back(position.x);
    y.push_back(position.y);
  }
  const double same = SAME_LINE * usualDistance(plane.positions);
  const std::vector<int> rows = lineNumbers(y, same);
  std::vector<int> columns = lineNumbers(x, same);
  std::vector<std::pair<int, int>> places;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    places.emplace_back(rows[i], columns[i]);
  }
  std::sort(places.begin(), places.end());
  if (std::adjacent_find(places.begin(), places.end()) != places.end())
  {
    columns = lineNumbers(x, -1.0);
  }
  std::vector<GridPosition> numbers;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    numbers.push_back({rows[i], columns[i]});
  }
  return numbers;
}

FolderDescription describeRig(const fs::path& folder, const std::vector<PosedImage>& images, double unit_m)
{
  if (images.size() < 2)
  {
    throw InputError("Of the cameras that '" + folder.string() + "' describes, " +
                     std::to_string(images.size()) + " image(s) are there; disparity needs at least two.");
  }
  const CommonPlane plane = fitCommonPlane(folder, images);
  const std::vector<GridPosition> numbers = numberCameras(plane);
  FolderDescription description;
  std::size_t warped_views = 0;
  for (std::size_t i = 0; i < images.size(); ++i)
  {
    const PosedImage& image = images[i];
    ViewFile view{image.path, numbers[i], plane.positions[i]};
    const ViewWarp warp{plane.common, image.intrinsics, image.rotation.t() * plane.rotation};
    if (movesPixels(warp))
    {
      view.warp = std::make_shared<const ViewWarp>(warp);
      ++warped_views;
    }
    description.views.push_back(view);
  }
  CameraDescription camera;
  camera.focal_length_px = plane.common.fx;
  camera.principal_point_px = cv::Point2d(plane.common.cx, plane.common.cy);
  description.camera = camera;
  description.position_unit_m = unit_m;
  if (warped_views > 0)
  {
    description.notes.push_back(std::to_string(warped_views) + " of " + std::to_string(images.size()) +
                                " views are rectified to the common plane of the cameras.");
  }
  return description;
}

cv::Mat warped(const cv::Mat& image, const ViewWarp& warp)
{
  if (image.size() != warp.source.size)
  {
    throw InputError("An image has " + std::to_string(image.cols) + " x " + std::to_string(image.rows) +
                     " pixels, but its calibration is for " + std::to_string(warp.source.size.width) + " x " +
                     std::to_string(warp.source.size.height) + "; scale one of them.");
  }
  cv::Mat result;
  cv::remap(image, result, mapOf(warp), cv::noArray(), cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return result;
}

cv::Mat warpedMask(const cv::Mat& mask, const ViewWarp& warp)
{
  constexpr double KNOWN = 255.0;
  const cv::Mat source = mask.empty() ? cv::Mat(warp.source.size, CV_8UC1, cv::Scalar(KNOWN)) : mask;
  cv::Mat share;
  cv::remap(source, share, mapOf(warp), cv::noArray(), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  const cv::Mat result = share == KNOWN;
  return cv::countNonZero(result) < static_cast<int>(result.total()) ? result : cv::Mat();
}

}  // namespace light_field_depth
