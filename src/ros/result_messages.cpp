#include "light_field_depth/ros/result_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <sensor_msgs/image_encodings.h>
#include <boost/endian/conversion.hpp>
#include <boost/make_shared.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/calibration_from_camera_info.h"

namespace light_field_depth
{
namespace
{
/// Sub-pixel fits resolve about this much; stereo_msgs asks for the smallest step between two disparities.
constexpr float DISPARITY_RESOLUTION_PX = 1.0F / 32.0F;
/// roscpp drops connections over larger messages.
constexpr std::size_t MAX_MESSAGE_BYTES = 1000000000;

bool hostIsBigEndian()
{
  return boost::endian::order::native == boost::endian::order::big;
}

/// An image message of the size and type, its bytes not set.
void shape(sensor_msgs::Image& image, const std_msgs::Header& header, const cv::Size& size,
           const std::string& encoding, int type)
{
  image.header = header;
  image.width = static_cast<std::uint32_t>(size.width);
  image.height = static_cast<std::uint32_t>(size.height);
  image.encoding = encoding;
  image.is_bigendian = hostIsBigEndian() ? 1 : 0;
  image.step = static_cast<std::uint32_t>(size.width * CV_ELEM_SIZE(type));
  image.data.resize(static_cast<std::size_t>(image.step) * image.height);
}

cv::Mat pixelsOf(sensor_msgs::Image& image, int type)
{
  return {static_cast<int>(image.height), static_cast<int>(image.width), type, image.data.data(), image.step};
}

struct Bounds
{
  float min = std::numeric_limits<float>::max();
  float max = std::numeric_limits<float>::lowest();
};

/// Bounds what is not NaN: what the mask of the view leaves. The whole map where that is nothing.
cv::Rect knownWindow(const cv::Mat& disparity)
{
  cv::Mat known;  // no NaN
  cv::compare(disparity, disparity, known, cv::CMP_EQ);
  const cv::Rect window = cv::boundingRect(known);
  return window.empty() ? cv::Rect({}, disparity.size()) : window;
}

/// Writes d + d_inf where it is valid, NaN elsewhere; returns the bounds of what is valid.
/// @param lowest exclusive
Bounds writeAbsoluteDisparity(const DisparityEstimate& estimate, float offset_px, float lowest,
                              float min_confidence, bool keep_filled, cv::Mat& absolute)
{
  Bounds bounds;
  for (int y = 0; y < absolute.rows; ++y)
  {
    const float* const disparity = estimate.disparity.ptr<float>(y);
    const float* const confidence = estimate.confidence.ptr<float>(y);
    const auto* const filled =
        keep_filled || estimate.filled.empty() ? nullptr : estimate.filled.ptr<std::uint8_t>(y);
    float* const out = absolute.ptr<float>(y);
    for (int x = 0; x < absolute.cols; ++x)
    {
      const float value = disparity[x] + offset_px;
      const bool seen = filled == nullptr || filled[x] == 0;
      const bool valid = seen && confidence[x] >= min_confidence && std::isfinite(value) && value > lowest;
      out[x] = valid ? value : std::numeric_limits<float>::quiet_NaN();
      if (valid)
      {
        bounds.min = std::min(bounds.min, value);
        bounds.max = std::max(bounds.max, value);
      }
    }
  }
  return bounds;
}

ColoredPoint* shapeCloud(const std_msgs::Header& header, std::uint32_t width, std::uint32_t height,
                         bool is_dense, const char* remedy, sensor_msgs::PointCloud2& cloud)
{
  using sensor_msgs::PointField;
  const std::size_t points = static_cast<std::size_t>(width) * height;
  const std::size_t bytes = sizeof(ColoredPoint) * points;
  if (bytes > MAX_MESSAGE_BYTES)
  {
    throw InputError("The cloud has " + std::to_string(points) +
                     " points, which are more bytes than ROS transports in a message (" +
                     std::to_string(MAX_MESSAGE_BYTES) + "), so it is left out; " + remedy);
  }
  cloud.header = header;
  cloud.width = width;
  cloud.height = height;
  // "rgb" is a float by name only; its bytes are b, g, r, and one that means nothing, which holds the
  // confidence.
  cloud.fields.resize(5);
  const std::array<const char*, 5> names = {"x", "y", "z", "rgb", "confidence"};
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    cloud.fields[i].name = names[i];
    cloud.fields[i].offset = static_cast<std::uint32_t>(i * sizeof(float));
    cloud.fields[i].datatype = PointField::FLOAT32;
    cloud.fields[i].count = 1;
  }
  cloud.is_bigendian = hostIsBigEndian();
  cloud.is_dense = is_dense;
  cloud.point_step = sizeof(ColoredPoint);
  cloud.row_step = cloud.point_step * width;
  cloud.data.resize(bytes);
  return reinterpret_cast<ColoredPoint*>(cloud.data.data());
}

}  // namespace

stereo_msgs::DisparityImagePtr disparityMessage(const std_msgs::Header& header,
                                                const DisparityEstimate& estimate,
                                                const std::optional<Calibration>& calibration,
                                                float min_confidence, bool keep_filled)
{
  auto message = boost::make_shared<stereo_msgs::DisparityImage>();
  const cv::Size size = estimate.disparity.size();
  message->header = header;
  shape(message->image, header, size, sensor_msgs::image_encodings::TYPE_32FC1, CV_32FC1);
  message->f = calibration ? static_cast<float>(calibration->focal_length_px) : 0.0F;
  message->T = calibration ? static_cast<float>(calibration->baseline_m) : 0.0F;
  message->delta_d = DISPARITY_RESOLUTION_PX;
  const cv::Rect window = knownWindow(estimate.disparity);
  message->valid_window.x_offset = static_cast<std::uint32_t>(window.x);
  message->valid_window.y_offset = static_cast<std::uint32_t>(window.y);
  message->valid_window.width = static_cast<std::uint32_t>(window.width);
  message->valid_window.height = static_cast<std::uint32_t>(window.height);

  const float offset_px = calibration ? static_cast<float>(calibration->disparity_offset_px) : 0.0F;
  // Infinity is where the disparity of parallel cameras is 0; nobody knows where without a calibration.
  constexpr float NO_BOUND = std::numeric_limits<float>::lowest();
  cv::Mat absolute = pixelsOf(message->image, CV_32FC1);
  const Bounds bounds = writeAbsoluteDisparity(estimate, offset_px, calibration ? 0.0F : NO_BOUND,
                                               min_confidence, keep_filled, absolute);
  // The searched range counts where it is wider than what was found, but never down to infinite depth.
  const float range_min =
      std::max(estimate.range.min + offset_px, calibration ? DISPARITY_RESOLUTION_PX : NO_BOUND);
  message->min_disparity = std::min(bounds.min, range_min);
  message->max_disparity = std::max({bounds.max, estimate.range.max + offset_px, message->min_disparity});
  cv::patchNaNs(absolute, message->min_disparity - 1.0F);
  return message;
}

StereoPair stereoPair(const std_msgs::Header& header, const Calibration& calibration, const cv::Size& size)
{
  Calibration parallel = calibration;
  parallel.disparity_offset_px = 0.0;
  View view;
  StereoPair pair;
  pair.left = boost::make_shared<sensor_msgs::CameraInfo>(cameraInfoFor(view, parallel, size));
  view.steps = {1.0, 0.0};
  pair.right = boost::make_shared<sensor_msgs::CameraInfo>(cameraInfoFor(view, parallel, size));
  pair.left->header = header;
  pair.right->header = header;
  return pair;
}

sensor_msgs::ImagePtr floatImageMessage(const std_msgs::Header& header, const cv::Mat& values)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  shape(*message, header, values.size(), sensor_msgs::image_encodings::TYPE_32FC1, CV_32FC1);
  cv::Mat pixels = pixelsOf(*message, CV_32FC1);
  values.copyTo(pixels);
  return message;
}

sensor_msgs::ImagePtr millimetreImageMessage(const std_msgs::Header& header, const cv::Mat& depth_m)
{
  constexpr float MILLIMETRES_PER_METRE = 1000.0F;
  constexpr float LARGEST = std::numeric_limits<std::uint16_t>::max();
  auto message = boost::make_shared<sensor_msgs::Image>();
  shape(*message, header, depth_m.size(), sensor_msgs::image_encodings::TYPE_16UC1, CV_16UC1);
  cv::Mat pixels = pixelsOf(*message, CV_16UC1);
  for (int y = 0; y < pixels.rows; ++y)
  {
    const float* const metres = depth_m.ptr<float>(y);
    auto* const out = pixels.ptr<std::uint16_t>(y);
    for (int x = 0; x < pixels.cols; ++x)
    {
      const float millimetres = std::round(metres[x] * MILLIMETRES_PER_METRE);
      out[x] = millimetres > 0.0F && millimetres <= LARGEST ? static_cast<std::uint16_t>(millimetres) : 0;
    }
  }
  return message;
}

sensor_msgs::ImagePtr confidenceMono8Message(const std_msgs::Header& header, const cv::Mat& confidence)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  shape(*message, header, confidence.size(), sensor_msgs::image_encodings::MONO8, CV_8UC1);
  cv::Mat pixels = pixelsOf(*message, CV_8UC1);
  confidence.convertTo(pixels, CV_8UC1, std::numeric_limits<std::uint8_t>::max());
  return message;
}

sensor_msgs::ImagePtr disparityColorMessage(const std_msgs::Header& header, const DisparityEstimate& estimate)
{
  auto message = boost::make_shared<sensor_msgs::Image>();
  shape(*message, header, estimate.disparity.size(), sensor_msgs::image_encodings::BGR8, CV_8UC3);
  const double scale = 255.0 / std::max(1e-6F, estimate.range.max - estimate.range.min);
  cv::Mat levels;
  estimate.disparity.convertTo(levels, CV_8UC1, scale, -scale * estimate.range.min);
  cv::Mat pixels = pixelsOf(*message, CV_8UC3);
  cv::applyColorMap(levels, pixels, cv::COLORMAP_TURBO);
  cv::Mat masked;  // NaN
  cv::compare(estimate.disparity, estimate.disparity, masked, cv::CMP_NE);
  pixels.setTo(cv::Scalar(), masked);
  return message;
}

ColoredPoint* shapeOrganizedCloud(const std_msgs::Header& header, const cv::Size& size,
                                  sensor_msgs::PointCloud2& cloud)
{
  return shapeCloud(header, static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
                    false, "give smaller images.", cloud);
}

void beginDenseCloud(const std_msgs::Header& header, sensor_msgs::PointCloud2& cloud)
{
  shapeCloud(header, 0, 1, true, "raise dense_cloud_voxel_size_m.", cloud);
}

std::size_t thinningOfDenseCloud(std::size_t most_points)
{
  return (most_points * sizeof(ColoredPoint) + MAX_MESSAGE_BYTES - 1) / MAX_MESSAGE_BYTES;
}

void appendDensePoints(const DensePoint* points, std::size_t count, std::size_t every_nth,
                       sensor_msgs::PointCloud2& cloud)
{
  const std::size_t before = cloud.data.size();
  const std::size_t room = (MAX_MESSAGE_BYTES - std::min(before, MAX_MESSAGE_BYTES)) / sizeof(ColoredPoint);
  const std::size_t kept = std::min((count + every_nth - 1) / every_nth, room);
  cloud.data.resize(before + kept * sizeof(ColoredPoint));
  auto* target = reinterpret_cast<ColoredPoint*>(cloud.data.data() + before);
  for (std::size_t i = 0; i < kept; ++i)
  {
    const DensePoint& point = points[i * every_nth];
    *target++ = {point.x, point.y, point.z, point.b, point.g, point.r, 0, point.confidence};
  }
  cloud.width += static_cast<std::uint32_t>(kept);
  cloud.row_step = cloud.point_step * cloud.width;
}

}  // namespace light_field_depth
