#include "ros/light_field_assembler.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/image_conversion.h"
#include "ros/camera_info.h"

namespace light_field_depth
{
namespace
{
std::string sizeText(std::uint32_t width, std::uint32_t height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

LightFieldAssembler::LightFieldAssembler(ViewArray array, CalibrationParameters parameters,
                                         bool use_camera_info)
    : array_(std::move(array)), parameters_(parameters), use_camera_info_(use_camera_info)
{
}

LightField LightFieldAssembler::assemble(const std::vector<sensor_msgs::ImageConstPtr>& images,
                                         const std::vector<sensor_msgs::CameraInfoConstPtr>& infos)
{
  checkPresent(images, infos);
  std::vector<View> views;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < array_.views.size(); ++i)
  {
    if (images[i] != nullptr)
    {
      View view;
      view.grid = array_.views[i].grid;
      view.image = imageFromMessage(*images[i], describe(array_.views[i]));
      views.push_back(std::move(view));
      indices.push_back(i);
    }
  }
  const sensor_msgs::Image& reference = *images[array_.reference];
  updateCalibration(infos, {static_cast<int>(reference.width), static_cast<int>(reference.height)});
  checkSizes(images);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].steps = views_[indices[i]].steps;
    views[i].offset_px = views_[indices[i]].offset_px;
  }
  return makeLightField(std::move(views), array_.views[array_.reference].grid, calibration_);
}

sensor_msgs::CameraInfo LightFieldAssembler::referenceInfo() const
{
  const auto reference =
      std::find_if(cameras_.begin(), cameras_.end(),
                   [this](const KnownCamera& camera) { return camera.view == array_.reference; });
  sensor_msgs::CameraInfo info;
  if (reference != cameras_.end())
  {
    info = reference->delivered;
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
  const bool current = use_camera_info_ ? isCurrent(infos) : image_size == image_size_;
  if (!views_.empty() && current)
  {
    return;
  }
  views_.clear();
  cameras_.clear();
  warnings_.clear();
  image_size_ = image_size;
  if (use_camera_info_)
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
  std::vector<GridPosition> grid;
  std::vector<sensor_msgs::CameraInfo> delivered;
  std::size_t reference = 0;
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    if (infos[i] != nullptr)
    {
      reference = i == array_.reference ? grid.size() : reference;
      grid.push_back(array_.views[i].grid);
      cameras_.push_back({i, *infos[i], ofDeliveredImage(*infos[i])});
      delivered.push_back(cameras_.back().delivered);
    }
  }
  const ArrayCalibration found = calibrationFromCameraInfo(grid, delivered, reference, parameters_);
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
    if (isDistortedOrTurned(camera.received) &&
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

void LightFieldAssembler::checkPresent(const std::vector<sensor_msgs::ImageConstPtr>& images,
                                       const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const
{
  if (images[array_.reference] == nullptr)
  {
    throw InputError(
        describe(array_.views[array_.reference]) +
        ": no image of the reference view, to which every result belongs; bring this camera back, "
        "or name another one as 'reference' of the array.");
  }
  for (std::size_t i = 0; use_camera_info_ && i < images.size(); ++i)
  {
    if (images[i] != nullptr && infos[i] == nullptr)
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

void LightFieldAssembler::checkSizes(const std::vector<sensor_msgs::ImageConstPtr>& images) const
{
  for (const KnownCamera& camera : cameras_)
  {
    const sensor_msgs::ImageConstPtr& image = images[camera.view];
    const sensor_msgs::CameraInfo& info = camera.delivered;
    if (image != nullptr && (image->width != info.width || image->height != info.height))
    {
      throw InputError(
          describe(array_.views[camera.view]) + ": the image is " + sizeText(image->width, image->height) +
          " pixels, but its CameraInfo says " + sizeText(info.width, info.height) +
          ", binning and region of interest included; publish the CameraInfo that belongs to the "
          "image.");
    }
  }
}

}  // namespace light_field_depth
