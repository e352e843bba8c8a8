#include "ros/light_field_assembler.h"

#include <cstdint>
#include <utility>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/image_conversion.h"

namespace light_field_depth
{
namespace
{
/// Whether two messages describe the same camera, whenever they were sent.
bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b)
{
  return a.width == b.width && a.height == b.height && a.P == b.P;
}

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
  std::vector<View> views;
  for (std::size_t i = 0; i < array_.views.size(); ++i)
  {
    View view;
    view.grid = array_.views[i].grid;
    view.image = imageFromMessage(*images[i], describe(array_.views[i]));
    views.push_back(std::move(view));
  }
  updateCalibration(infos, views[array_.reference].image.size());
  checkSizes(images);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].steps = calibration_->views[i].steps;
    views[i].offset_px = calibration_->views[i].offset_px;
  }
  return makeLightField(std::move(views), array_.views[array_.reference].grid, calibration_->calibration);
}

void LightFieldAssembler::updateCalibration(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos,
                                            const cv::Size& image_size)
{
  if (use_camera_info_)
  {
    checkPresent(infos);
  }
  if (calibration_ && (!use_camera_info_ || isCurrent(infos)))
  {
    return;
  }
  calibration_.reset();
  warnings_.clear();
  infos_.clear();
  if (use_camera_info_)
  {
    for (const sensor_msgs::CameraInfoConstPtr& info : infos)
    {
      infos_.push_back(*info);
    }
    calibration_ = calibrationFromCameraInfo(gridOf(array_), infos_, array_.reference, parameters_);
  }
  else
  {
    calibration_ = calibrationFromParameters(gridOf(array_), array_.reference, parameters_, image_size);
  }
  warnings_ = calibration_->warnings;
}

void LightFieldAssembler::checkPresent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const
{
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    if (infos[i] == nullptr)
    {
      throw InputError(describe(array_.views[i]) + ": no CameraInfo is known; publish it on '" +
                       array_.views[i].camera_info + "'.");
    }
  }
}

bool LightFieldAssembler::isCurrent(const std::vector<sensor_msgs::CameraInfoConstPtr>& infos) const
{
  for (std::size_t i = 0; i < infos.size(); ++i)
  {
    if (!sameCamera(*infos[i], infos_[i]))
    {
      return false;
    }
  }
  return true;
}

void LightFieldAssembler::checkSizes(const std::vector<sensor_msgs::ImageConstPtr>& images) const
{
  for (std::size_t i = 0; i < infos_.size(); ++i)
  {
    if (images[i]->width != infos_[i].width || images[i]->height != infos_[i].height)
    {
      throw InputError(describe(array_.views[i]) + ": the image is " +
                       sizeText(images[i]->width, images[i]->height) + " pixels, but its CameraInfo says " +
                       sizeText(infos_[i].width, infos_[i].height) +
                       "; publish the CameraInfo that belongs to the rectified image.");
    }
  }
}

}  // namespace light_field_depth
