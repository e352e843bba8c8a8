#include "light_field_depth/ros/image_conversion.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <sensor_msgs/image_encodings.h>
#include <boost/endian/conversion.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace encodings = sensor_msgs::image_encodings;

constexpr int NO_CONVERSION = -1;
constexpr int MAX_SIDE_PX = 1 << 16;

/// How an encoding is read: the type in memory and the conversion to grey or BGR.
struct Encoding
{
  const std::string& name;
  int type;
  int conversion;
};

const Encoding* findEncoding(const std::string& name)
{
  static const std::array<Encoding, 14> known = {{
      {encodings::MONO8, CV_8UC1, NO_CONVERSION},
      {encodings::TYPE_8UC1, CV_8UC1, NO_CONVERSION},
      {encodings::BGR8, CV_8UC3, NO_CONVERSION},
      {encodings::TYPE_8UC3, CV_8UC3, NO_CONVERSION},
      {encodings::RGB8, CV_8UC3, cv::COLOR_RGB2BGR},
      {encodings::BGRA8, CV_8UC4, cv::COLOR_BGRA2BGR},
      {encodings::RGBA8, CV_8UC4, cv::COLOR_RGBA2BGR},
      {encodings::MONO16, CV_16UC1, NO_CONVERSION},
      {encodings::TYPE_16UC1, CV_16UC1, NO_CONVERSION},
      {encodings::BGR16, CV_16UC3, NO_CONVERSION},
      {encodings::TYPE_16UC3, CV_16UC3, NO_CONVERSION},
      {encodings::RGB16, CV_16UC3, cv::COLOR_RGB2BGR},
      {encodings::BGRA16, CV_16UC4, cv::COLOR_BGRA2BGR},
      {encodings::RGBA16, CV_16UC4, cv::COLOR_RGBA2BGR},
  }};
  const auto* const found = std::find_if(known.begin(), known.end(),
                                         [&](const Encoding& encoding) { return encoding.name == name; });
  return found == known.end() ? nullptr : found;
}

bool hostIsBigEndian()
{
  return boost::endian::order::native == boost::endian::order::big;
}

void checkLayout(const sensor_msgs::Image& message, const Encoding& encoding, const std::string& view_name)
{
  if (message.width == 0 || message.height == 0 || message.width > MAX_SIDE_PX ||
      message.height > MAX_SIDE_PX)
  {
    throw InputError(view_name + ": the image is " + std::to_string(message.width) + " x " +
                     std::to_string(message.height) + " pixels; publish images of at least 16 x 16 pixels.");
  }
  const std::size_t row_bytes = message.width * static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  if (message.step < row_bytes)
  {
    throw InputError(view_name + ": the image's step is " + std::to_string(message.step) + " bytes, but " +
                     std::to_string(message.width) + " pixels of " + encoding.name + " need " +
                     std::to_string(row_bytes) + "; correct the driver.");
  }
  const std::size_t needed = static_cast<std::size_t>(message.step) * (message.height - 1) + row_bytes;
  if (message.data.size() < needed)
  {
    throw InputError(view_name + ": the image holds " + std::to_string(message.data.size()) + " bytes, but " +
                     std::to_string(message.width) + " x " + std::to_string(message.height) + " pixels of " +
                     encoding.name + " need " + std::to_string(needed) +
                     "; the message is truncated, correct the driver or the bag.");
  }
  if (CV_ELEM_SIZE1(encoding.type) > 1 && (message.is_bigendian != 0) != hostIsBigEndian())
  {
    throw InputError(
        view_name + ": is_bigendian is " + std::to_string(message.is_bigendian) +
        ", but this machine has the other byte order; publish 16-bit images in the machine's own.");
  }
}

/// @return the image itself, sharing its pixels, where there is nothing to convert
cv::Mat converted(const cv::Mat& image, const Encoding& encoding)
{
  if (encoding.conversion == NO_CONVERSION)
  {
    return image;
  }
  cv::Mat result;
  cv::cvtColor(image, result, encoding.conversion);
  return result;
}

}  // namespace

cv::Mat imageFromMessage(const sensor_msgs::Image& message, const std::string& view_name)
{
  const Encoding* const encoding = findEncoding(message.encoding);
  if (encoding == nullptr)
  {
    throw InputError(view_name + ": the image's encoding is '" + message.encoding +
                     "'; publish rectified images in mono8, mono16, bgr8, rgb8, bgr16 or rgb16 (debayer raw "
                     "images first).");
  }
  checkLayout(message, *encoding, view_name);
  // cv::Mat knows no constant memory; what is returned is only read.
  auto* const data = const_cast<std::uint8_t*>(message.data.data());
  if (message.step % static_cast<std::size_t>(CV_ELEM_SIZE1(encoding->type)) != 0)
  {
    // Rows that begin between two values are copied to where values may begin.
    cv::Mat aligned(static_cast<int>(message.height), static_cast<int>(message.width), encoding->type);
    for (int y = 0; y < aligned.rows; ++y)
    {
      std::memcpy(aligned.ptr(y), data + static_cast<std::size_t>(y) * message.step,
                  static_cast<std::size_t>(aligned.cols) * aligned.elemSize());
    }
    return converted(aligned, *encoding);
  }
  cv::Mat shared(static_cast<int>(message.height), static_cast<int>(message.width), encoding->type, data,
                 message.step);
  return converted(shared, *encoding);
}

}  // namespace light_field_depth
