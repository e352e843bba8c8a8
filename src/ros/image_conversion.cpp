#include "light_field_depth/ros/image_conversion.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include <sensor_msgs/image_encodings.h>
#include <boost/endian/conversion.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/mask_sources.h"

namespace light_field_depth
{
namespace
{
namespace encodings = sensor_msgs::image_encodings;

constexpr int NO_CONVERSION = -1;
/// A message that says more is damaged.
constexpr int MAX_SIDE_PX = 1 << 16;

/// How an encoding is read: the type in memory and the conversion to grey or BGR.
struct Encoding
{
  const std::string& name;
  int type;
  int conversion;
};

/// What older versions of sensor_msgs have no name for.
const std::string YUV422_YUY2 = "yuv422_yuy2";

// OpenCV names a Bayer pattern by its second row's second and third pixel, ROS by its first row.
const Encoding* findEncoding(const std::string& name)
{
  static const std::array<Encoding, 24> known = {{
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
      {encodings::BAYER_RGGB8, CV_8UC1, cv::COLOR_BayerBG2BGR},
      {encodings::BAYER_BGGR8, CV_8UC1, cv::COLOR_BayerRG2BGR},
      {encodings::BAYER_GBRG8, CV_8UC1, cv::COLOR_BayerGR2BGR},
      {encodings::BAYER_GRBG8, CV_8UC1, cv::COLOR_BayerGB2BGR},
      {encodings::BAYER_RGGB16, CV_16UC1, cv::COLOR_BayerBG2BGR},
      {encodings::BAYER_BGGR16, CV_16UC1, cv::COLOR_BayerRG2BGR},
      {encodings::BAYER_GBRG16, CV_16UC1, cv::COLOR_BayerGR2BGR},
      {encodings::BAYER_GRBG16, CV_16UC1, cv::COLOR_BayerGB2BGR},
      {encodings::YUV422, CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
      {YUV422_YUY2, CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
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
  if (encoding.type == CV_8UC2 && message.width % 2 != 0)
  {
    throw InputError(view_name + ": the image is " + std::to_string(message.width) + " pixels wide, but " +
                     encoding.name + " has pixels in pairs; correct the driver.");
  }
}

void checkPixels(const cv::Size& size, double max_megapixels, const std::string& view_name)
{
  requirePixels(size, max_megapixels, view_name + ": the image", "Reduce it, or raise max_megapixels.");
}

void keepMask(const cv::Mat& image, cv::Mat* mask)
{
  if (mask != nullptr)
  {
    *mask = alphaMask(image);
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

/// @return an empty image for what cannot be decoded
cv::Mat decoded(const std::vector<std::uint8_t>& bytes)
{
  try
  {
    return bytes.empty() ? cv::Mat() : cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  }
  catch (const cv::Exception& error)
  {
    if (error.code == cv::Error::StsNoMem)
    {
      throw std::bad_alloc();
    }
    return {};  // such as one that says to have billions of pixels
  }
}

/// A copy with the two bytes of every value swapped.
cv::Mat byteSwapped(const cv::Mat& image)
{
  cv::Mat swapped = image.clone();
  const int values = swapped.cols * swapped.channels();
  for (int y = 0; y < swapped.rows; ++y)
  {
    auto* const row = swapped.ptr<std::uint16_t>(y);
    std::transform(row, row + values, row,
                   [](std::uint16_t value) { return boost::endian::endian_reverse(value); });
  }
  return swapped;
}

/// @return the image itself, sharing its pixels, where its bytes are in the order of this machine
cv::Mat inHostOrder(const cv::Mat& image, const sensor_msgs::Image& message)
{
  const bool swapped = image.elemSize1() > 1 && (message.is_bigendian != 0) != hostIsBigEndian();
  return swapped ? byteSwapped(image) : image;
}

}  // namespace

cv::Mat imageFromMessage(const sensor_msgs::Image& message, const std::string& view_name, cv::Mat* mask,
                         double max_megapixels)
{
  const Encoding* const encoding = findEncoding(message.encoding);
  if (encoding == nullptr)
  {
    throw InputError(view_name + ": the image's encoding is '" + message.encoding +
                     "'; publish images in mono, bgr(a), rgb(a) or Bayer of 8 or 16 bits, or in yuv422.");
  }
  checkLayout(message, *encoding, view_name);
  checkPixels(cv::Size(static_cast<int>(message.width), static_cast<int>(message.height)), max_megapixels,
              view_name);
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
    keepMask(aligned, mask);
    return converted(inHostOrder(aligned, message), *encoding);
  }
  cv::Mat shared(static_cast<int>(message.height), static_cast<int>(message.width), encoding->type, data,
                 message.step);
  keepMask(shared, mask);
  return converted(inHostOrder(shared, message), *encoding);
}

cv::Mat imageFromMessage(const sensor_msgs::CompressedImage& message, const std::string& view_name,
                         cv::Mat* mask, double max_megapixels)
{
  const std::string_view bytes(reinterpret_cast<const char*>(message.data.data()), message.data.size());
  if (const std::optional<cv::Size> size = encodedSize(bytes))
  {
    checkPixels(*size, max_megapixels, view_name);
  }
  // Where an image should be turned is for those who look at it; the calibration knows the pixels as they
  // are, and so does 'unchanged', which also leaves the alpha channel.
  cv::Mat image = decoded(message.data);
  if (image.empty() || (image.depth() != CV_8U && image.depth() != CV_16U))
  {
    throw InputError(view_name + ": the compressed image of " + std::to_string(message.data.size()) +
                     " bytes and the format '" + message.format +
                     "' cannot be decoded; publish JPEG or PNG of 8 or 16 bits.");
  }
  checkPixels(image.size(), max_megapixels, view_name);
  keepMask(image, mask);
  if (image.channels() == 4)
  {
    cv::cvtColor(image, image, cv::COLOR_BGRA2BGR);
  }
  const Encoding* const original = findEncoding(message.format.substr(0, message.format.find(';')));
  if (original != nullptr && encodings::isBayer(original->name) && image.channels() == 1)
  {
    return converted(image, *original);
  }
  return image;
}

cv::Mat maskFromMessage(const sensor_msgs::Image& message, const std::string& view_name)
{
  return toGrey(imageFromMessage(message, view_name)) > 0;
}

}  // namespace light_field_depth
