// What comes over topics and the parameter server: descriptions of arrays, CameraInfos, images.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <yaml-cpp/yaml.h>
#include <boost/make_shared.hpp>
#include <opencv2/core.hpp>

#include "fuzz/byte_source.h"
#include "fuzz/harnesses.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/image_conversion.h"
#include "light_field_depth/ros/view_array.h"
#include "light_field_depth/ros/yaml_parameter.h"
#include "ros/light_field_assembler.h"

namespace light_field_depth::fuzz
{
namespace
{
namespace encodings = sensor_msgs::image_encodings;

void require(bool condition, const char* what)
{
  if (!condition)
  {
    std::fprintf(stderr, "The result is wrong: %s.\n", what);
    std::abort();
  }
}

bool isFinite(const cv::Point2d& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y);
}

template <class Action>
void runOrSentence(const Action& action)
{
  try
  {
    action();
  }
  catch (const InputError& error)
  {
    require(std::string(error.what()).size() > 20, "no sentence");
  }
}

sensor_msgs::ImagePtr smallImage(int width, int height)
{
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->width = image->step = static_cast<std::uint32_t>(width);
  image->height = static_cast<std::uint32_t>(height);
  image->encoding = encodings::MONO8;
  image->data.resize(static_cast<std::size_t>(width) * height);
  for (std::size_t i = 0; i < image->data.size(); ++i)
  {
    image->data[i] = static_cast<std::uint8_t>(i * 37 % 251);
  }
  return image;
}

/// A camera at its place of a grid, and odd numbers in some of the fields.
sensor_msgs::CameraInfoPtr cameraInfo(ByteSource& source, const GridPosition& grid, int width, int height)
{
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>();
  info->width = static_cast<std::uint32_t>(width);
  info->height = static_cast<std::uint32_t>(height);
  const double focal_px = 50.0;
  const cv::Point2d centre(0.5 * width, 0.5 * height);
  info->K = {focal_px, 0, centre.x, 0, focal_px, centre.y, 0, 0, 1};
  info->R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info->P = {focal_px, 0,        centre.x, -focal_px * 0.1 * grid.column,
             0,        focal_px, centre.y, -focal_px * 0.1 * grid.row,
             0,        0,        1,        0};
  for (int changes = source.below(4); changes > 0; --changes)
  {
    switch (source.below(8))
    {
      case 0:
        info->K[static_cast<std::size_t>(source.below(9))] = source.number();
        break;
      case 1:
        info->R[static_cast<std::size_t>(source.below(9))] = source.number();
        break;
      case 2:
      case 3:
        info->P[static_cast<std::size_t>(source.below(12))] = source.number();
        break;
      case 4:
        info->D.push_back(source.number());
        info->distortion_model = source.flag() ? "plumb_bob" : source.flag() ? "rational_polynomial" : "?";
        break;
      case 5:
        info->binning_x = static_cast<std::uint32_t>(source.below(4));
        info->binning_y = static_cast<std::uint32_t>(source.below(4));
        break;
      case 6:
        info->roi.x_offset = source.byte();
        info->roi.y_offset = source.byte();
        info->roi.width = source.byte();
        info->roi.height = source.byte();
        break;
      default:
        info->width = source.byte();
        break;
    }
  }
  return info;
}

}  // namespace

void fuzzArrayYaml(const std::uint8_t* data, std::size_t size)
{
  XmlRpc::XmlRpcValue parameter;
  try
  {
    parameter = parameterFromYaml({reinterpret_cast<const char*>(data), size});
  }
  catch (const YAML::Exception&)
  {
    return;  // no YAML: it never becomes a parameter
  }
  runOrSentence(
      [&]
      {
        const ViewArray array = viewArrayFromParameter(parameter);
        require(array.views.size() >= 2 && array.reference < array.views.size(), "views of an array");
      });
}

void fuzzCameraInfo(const std::uint8_t* data, std::size_t size)
{
  static ThreadPool pool(1);
  ByteSource source(data, size);
  const int width = 17 + source.below(30);
  const int height = 17 + source.below(20);
  ViewArray array;
  AssemblerOptions options;
  options.rectify = source.flag();
  options.decimation = 1 + source.below(2);
  options.use_camera_info = source.below(8) > 0;
  CalibrationParameters parameters;
  if (source.flag())
  {
    parameters.baseline_x_m = source.number();
    parameters.baseline_y_m = source.number();
    parameters.focal_length_px = source.number();
    parameters.disparity_offset_px = source.number();
    if (!validate(parameters).empty())
    {
      return;  // refused when the node starts
    }
  }
  std::vector<ViewImage> images;
  std::vector<sensor_msgs::CameraInfoConstPtr> infos;
  for (int view = 0; view < 4; ++view)
  {
    const GridPosition grid{view / 2, view % 2};
    array.views.push_back({grid, "image", "camera_info"});
    images.emplace_back(smallImage(width, height));
    infos.push_back(cameraInfo(source, grid, width, height));
  }
  array.reference = static_cast<std::size_t>(source.below(4));
  runOrSentence(
      [&]
      {
        LightFieldAssembler assembler(array, parameters, options, pool);
        const LightField light_field = assembler.assemble(images, infos);
        for (const View& view : light_field.views)
        {
          require(isFinite(view.steps) && isFinite(view.offset_px), "a place is no number");
          require(view.image.size() == light_field.size(), "sizes differ");
        }
        if (light_field.calibration)
        {
          const Calibration& calibration = *light_field.calibration;
          require(calibration.focal_length_px > 0.0 && std::isfinite(calibration.focal_length_px),
                  "focal length");
          require(calibration.baseline_m > 0.0 && std::isfinite(calibration.baseline_m), "baseline");
          require(isFinite(calibration.principal_point_px) && std::isfinite(calibration.disparity_offset_px),
                  "principal point");
        }
        assembler.referenceInfo();
      });
}

void fuzzImageMessage(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<std::string> known = {encodings::MONO8,
                                                 encodings::BGR8,
                                                 encodings::RGB8,
                                                 encodings::BGRA8,
                                                 encodings::RGBA8,
                                                 encodings::MONO16,
                                                 encodings::BGR16,
                                                 encodings::RGB16,
                                                 encodings::BGRA16,
                                                 encodings::RGBA16,
                                                 encodings::BAYER_RGGB8,
                                                 encodings::BAYER_GBRG8,
                                                 encodings::BAYER_BGGR8,
                                                 encodings::BAYER_GRBG16,
                                                 encodings::BAYER_RGGB16,
                                                 encodings::YUV422,
                                                 "yuv422_yuy2",
                                                 encodings::TYPE_8UC1,
                                                 encodings::TYPE_16UC3,
                                                 encodings::TYPE_32FC1,
                                                 "",
                                                 "8UC5",
                                                 "bgr8; jpeg"};
  ByteSource source(data, size);
  const bool compressed = source.below(3) == 0;
  const std::string& encoding = known[static_cast<std::size_t>(source.below(static_cast<int>(known.size())))];
  cv::Mat mask;
  cv::Mat image;
  if (compressed)
  {
    sensor_msgs::CompressedImage message;
    message.format = encoding;
    const std::string rest = source.rest();
    message.data.assign(rest.begin(), rest.end());
    runOrSentence([&] { image = imageFromMessage(message, "View (0, 0)", &mask); });
  }
  else
  {
    sensor_msgs::Image message;
    message.encoding = encoding;
    message.width = static_cast<std::uint32_t>(source.below(40));
    message.height = static_cast<std::uint32_t>(source.below(40));
    message.step = message.width * static_cast<std::uint32_t>(1 + source.below(8)) +
                   static_cast<std::uint32_t>(source.below(3));
    message.is_bigendian = source.flag() ? 1 : 0;
    const int lacking = source.below(4) == 0 ? source.below(64) : 0;
    const std::string rest = source.rest();
    const std::size_t bytes = std::size_t{message.step} * message.height;
    message.data.resize(bytes > static_cast<std::size_t>(lacking) ? bytes - lacking : 0);
    for (std::size_t i = 0; i < message.data.size() && !rest.empty(); ++i)
    {
      message.data[i] = static_cast<std::uint8_t>(rest[i % rest.size()]);
    }
    runOrSentence([&] { maskFromMessage(message, "View (0, 0)"); });
    runOrSentence(
        [&]
        {
          image = imageFromMessage(message, "View (0, 0)", &mask);
          require(
              image.cols == static_cast<int>(message.width) && image.rows == static_cast<int>(message.height),
              "size of the image");
          image = image.clone();  // reads all of it
        });
  }
  require(image.empty() || image.channels() == 1 || image.channels() == 3, "channels of the image");
  require(mask.empty() || (mask.type() == CV_8UC1 && mask.size() == image.size()), "mask of the image");
}

}  // namespace light_field_depth::fuzz
