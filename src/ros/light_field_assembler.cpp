#include "ros/light_field_assembler.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/mask_sources.h"
#include "light_field_depth/ros/image_conversion.h"
#include "ros/camera_info.h"

namespace light_field_depth
{
namespace
{
constexpr double KNOWN = 255.0;

std::string sizeText(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// The middle of the first pixel is 0 before and after.
double decimated(double coordinate_px, int decimation)
{
  return (coordinate_px + 0.5) / decimation - 0.5;
}

sensor_msgs::CameraInfo decimated(sensor_msgs::CameraInfo info, int decimation)
{
  info.width /= static_cast<std::uint32_t>(decimation);
  info.height /= static_cast<std::uint32_t>(decimation);
  if (isUncalibrated(info))
  {
    return info;
  }
  for (std::size_t i = 0; i < 8; ++i)
  {
    const bool principal_point = i % 4 == 2;
    info.P[i] = principal_point ? decimated(info.P[i], decimation) : info.P[i] / decimation;
  }
  info.K = {info.P[0], 0.0, info.P[2], 0.0, info.P[5], info.P[6], 0.0, 0.0, 1.0};
  return info;
}

CalibrationParameters decimated(CalibrationParameters parameters, int decimation)
{
  parameters.focal_length_px /= decimation;
  parameters.disparity_offset_px /= decimation;
  if (parameters.principal_point_px)
  {
    parameters.principal_point_px->x = decimated(parameters.principal_point_px->x, decimation);
    parameters.principal_point_px->y = decimated(parameters.principal_point_px->y, decimation);
  }
  return parameters;
}

cv::Mat decimated(const cv::Mat& image, int decimation)
{
  const cv::Size size(image.cols / decimation, image.rows / decimation);
  cv::Mat reduced;
  // Whole blocks only: a border that fills no block is left out.
  cv::resize(image({0, 0, size.width * decimation, size.height * decimation}), reduced, size, 0.0, 0.0,
             cv::INTER_AREA);
  return reduced;
}

/// Known is a block of known pixels.
cv::Mat decimatedMask(const cv::Mat& mask, int decimation)
{
  return mask.empty() ? mask : decimated(mask, decimation) == KNOWN;
}

std::vector<cv::Mat> readMaskFiles(const ViewArray& array)
{
  std::vector<cv::Mat> masks;
  for (const ViewTopics& view : array.views)
  {
    cv::Mat mask;
    if (!view.mask_file.empty())
    {
      const cv::Mat image = cv::imread(view.mask_file, cv::IMREAD_GRAYSCALE);
      if (image.empty())
      {
        throw InputError(describe(view) + ": its mask_file '" + view.mask_file +
                         "' cannot be read as an image; correct the path in the array's description.");
      }
      mask = image > 0;
    }
    masks.push_back(mask);
  }
  return masks;
}

}  // namespace

LightFieldAssembler::LightFieldAssembler(ViewArray array, CalibrationParameters parameters,
                                         const AssemblerOptions& options, ThreadPool& pool)
    : array_(std::move(array)), parameters_(decimated(parameters, options.decimation)), options_(options),
      pool_(pool), file_masks_(readMaskFiles(array_))
{
}

LightField LightFieldAssembler::assemble(const std::vector<ViewImage>& images,
                                         const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                                         const std::vector<sensor_msgs::ImageConstPtr>& masks)
{
  checkPresent(images, infos);
  std::vector<Pixels> pixels = decode(images, masks);
  updateCalibration(infos, pixels[array_.reference].image.size() / options_.decimation);
  checkSizes(pixels);
  rectify(pixels);
  std::vector<View> views;
  for (std::size_t i = 0; i < array_.views.size(); ++i)
  {
    if (images[i])
    {
      View view;
      view.grid = array_.views[i].grid;
      view.image = pixels[i].image;
      view.mask = pixels[i].mask;
      view.steps = views_[i].steps;
      view.offset_px = views_[i].offset_px;
      views.push_back(std::move(view));
    }
  }
  return makeLightField(std::move(views), array_.views[array_.reference].grid, calibration_);
}

std::vector<LightFieldAssembler::Pixels> LightFieldAssembler::decode(
    const std::vector<ViewImage>& images, const std::vector<sensor_msgs::ImageConstPtr>& masks) const
{
  std::vector<Pixels> pixels(images.size());
  pool_.parallelFor(
      0, static_cast<int>(images.size()), 1,
      [&](int first, int /*last*/)
      {
        const auto i = static_cast<std::size_t>(first);
        if (images[i])
        {
          const std::string name = describe(array_.views[i]);
          Pixels& view = pixels[i];
          view.image =
              images[i].raw() != nullptr
                  ? imageFromMessage(*images[i].raw(), name, &view.mask, options_.max_megapixels)
                  : imageFromMessage(*images[i].compressed(), name, &view.mask, options_.max_megapixels);
          addGivenMasks(i, i < masks.size() ? masks[i] : nullptr, view);
        }
      });
  return pixels;
}

void LightFieldAssembler::addGivenMasks(std::size_t view, const sensor_msgs::ImageConstPtr& message,
                                        Pixels& pixels) const
{
  const std::string name = describe(array_.views[view]);
  std::vector<cv::Mat> masks = {file_masks_[view]};
  if (message != nullptr)
  {
    masks.push_back(maskFromMessage(*message, name + ", mask"));
  }
  if (options_.mask_black)
  {
    masks.push_back(blackMask(pixels.image));
  }
  for (const cv::Mat& mask : masks)
  {
    if (!mask.empty() && mask.size() != pixels.image.size())
    {
      throw InputError(name + ": its mask is " + sizeText(mask.size()) + " pixels, but its image is " +
                       sizeText(pixels.image.size()) + "; give the mask of the image as it comes.");
    }
    pixels.mask = bothKnown(pixels.mask, mask);
  }
}

void LightFieldAssembler::rectify(std::vector<Pixels>& views) const
{
  pool_.parallelFor(0, static_cast<int>(views.size()), 1,
                    [&](int first, int /*last*/)
                    {
                      auto& [image, mask] = views[static_cast<std::size_t>(first)];
                      const auto camera = std::find_if(cameras_.begin(), cameras_.end(),
                                                       [first](const KnownCamera& known) {
                                                         return known.view == static_cast<std::size_t>(first);
                                                       });
                      if (!image.empty() && camera != cameras_.end())
                      {
                        image = camera->rectifier.apply(image);
                        mask = camera->rectifier.applyToMask(mask);
                      }
                      if (!image.empty() && options_.decimation > 1)
                      {
                        image = decimated(image, options_.decimation);
                        mask = decimatedMask(mask, options_.decimation);
                      }
                    });
}

sensor_msgs::CameraInfo LightFieldAssembler::referenceInfo() const
{
  const auto reference =
      std::find_if(cameras_.begin(), cameras_.end(),
                   [this](const KnownCamera& camera) { return camera.view == array_.reference; });
  sensor_msgs::CameraInfo info;
  if (reference != cameras_.end())
  {
    info = decimated(reference->rectifier.rectified(), options_.decimation);
    info.P[3] = 0.0;
    info.P[7] = 0.0;
  }
  else if (calibration_)
  {
    info = cameraInfoFor(View(), *calibration_, image_size_);
  }
  else
  {
    info.width = static_cast<std::uint32_t>(image_size_.width);
    info.height = static_cast<std::uint32_t>(image_size_.height);
  }
  return info;
}

void LightFieldAssembler::updateCalibration(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                                            const cv::Size& image_size)
{
  const bool current = options_.use_camera_info ? isCurrent(infos) : image_size == image_size_;
  if (!views_.empty() && current)
  {
    return;
  }
  views_.clear();
  cameras_.clear();
  warnings_.clear();
  image_size_ = image_size;
  if (options_.use_camera_info)
  {
    calibrate(infos);
  }
  else
  {
    ArrayCalibration found =
        calibrationFromParameters(gridOf(array_), array_.reference, parameters_, image_size);
    calibration_ = found.calibration;
    views_ = std::move(found.views);
    warnings_ = std::move(found.warnings);
  }
}

void LightFieldAssembler::calibrate(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos)
{
  const double focal_length_px = ofDeliveredImage(*infos[array_.reference]).P[0];
  std::vector<GridPosition> grid;
  std::vector<sensor_msgs::CameraInfo> plane;
  std::size_t reference = 0;
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    if (infos[i] != nullptr)
    {
      reference = i == array_.reference ? grid.size() : reference;
      grid.push_back(array_.views[i].grid);
      cameras_.push_back({i, *infos[i],
                          ViewRectifier(ofDeliveredImage(*infos[i]), options_.rectify, focal_length_px,
                                        describe(array_.views[i]))});
      plane.push_back(decimated(cameras_.back().rectifier.rectified(), options_.decimation));
    }
  }
  const ArrayCalibration found = calibrationFromCameraInfo(grid, plane, reference, parameters_);
  calibration_ = found.calibration;
  views_.resize(array_.views.size());
  for (std::size_t i = 0; i < cameras_.size(); ++i)
  {
    views_[cameras_[i].view] = found.views[i];
  }
  warnings_ = found.warnings;
  warnOfRawImages();
}

/// A CameraInfo has D and R whether its image is raw or rectified; only the topic's name tells which.
void LightFieldAssembler::warnOfRawImages()
{
  std::vector<std::size_t> raw;
  for (const KnownCamera& camera : cameras_)
  {
    if (!options_.rectify && isDistortedOrTurned(camera.received) &&
        array_.views[camera.view].image.find("rect") == std::string::npos)
    {
      raw.push_back(camera.view);
    }
  }
  if (!raw.empty())
  {
    warnings_.push_back(
        describe(array_.views[raw.front()]) +
        (raw.size() > 1 ? " and " + std::to_string(raw.size() - 1) + " more" : "") +
        ": the CameraInfo has distortion or a rotation, but the topic's name does not say that "
        "the image is rectified, as it is taken to be; name the rectified images "
        "(image_rect_color of image_proc).");
  }
}

void LightFieldAssembler::checkPresent(const std::vector<ViewImage>& images,
                                       const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const
{
  if (!images[array_.reference])
  {
    throw InputError(
        describe(array_.views[array_.reference]) +
        ": no image of the reference view, to which every result belongs; bring this camera back, "
        "or name another one as 'reference' of the array.");
  }
  for (std::size_t i = 0; options_.use_camera_info && i < images.size(); ++i)
  {
    if (images[i] && infos[i] == nullptr)
    {
      throw InputError(describe(array_.views[i]) + ": no CameraInfo is known; publish it on '" +
                       array_.views[i].camera_info + "'.");
    }
  }
}

bool LightFieldAssembler::isCurrent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const
{
  std::size_t known = 0;
  for (const sensor_msgs::CameraInfoConstPtr& info : infos)
  {
    known += info != nullptr ? 1 : 0;
  }
  return known == cameras_.size() && std::all_of(cameras_.begin(), cameras_.end(),
                                                 [&](const KnownCamera& camera) {
                                                   return infos[camera.view] != nullptr &&
                                                          sameCamera(*infos[camera.view], camera.received);
                                                 });
}

void LightFieldAssembler::checkSizes(const std::vector<Pixels>& views) const
{
  for (const KnownCamera& camera : cameras_)
  {
    const cv::Mat& image = views[camera.view].image;
    const sensor_msgs::CameraInfo& info = camera.rectifier.rectified();
    const cv::Size expected(static_cast<int>(info.width), static_cast<int>(info.height));
    if (!image.empty() && image.size() != expected)
    {
      throw InputError(
          describe(array_.views[camera.view]) + ": the image is " + sizeText(image.size()) +
          " pixels, but its CameraInfo says " + sizeText(expected) +
          ", binning and region of interest included; publish the CameraInfo that belongs to the "
          "image.");
    }
  }
}

}  // namespace light_field_depth
