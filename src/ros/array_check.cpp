#include "light_field_depth/ros/array_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "light_field_depth/core/error.h"
#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/registration.h"
#include "light_field_depth/evaluation/verdict.h"
#include "ros/light_field_assembler.h"
#include "ros/view_image.h"
#include "ros/view_synchronizer.h"

namespace light_field_depth
{
namespace
{
using Severity = ArrayFinding::Severity;

constexpr double NANOSECONDS_PER_SECOND = 1e9;
constexpr double NANOSECONDS_PER_MILLISECOND = 1e6;
/// A view with less than this part of the frames that the median view has loses images.
constexpr double MIN_SHARE_OF_FRAMES = 0.9;
/// Gains beyond these are made up for, but cost contrast.
constexpr double DARKEST_GAIN = 0.67;
constexpr double BRIGHTEST_GAIN = 1.5;
/// Beyond this the search finds less; the node's own check warns at the same.
constexpr double MAX_MISPLACED_PX = VerdictOptions().max_misregistration_px;
/// Stamps further apart than this part of the time between frames are not of one moment.
constexpr double MAX_SPREAD_OF_PERIOD = 0.4;
/// Room above the largest spread that was seen.
constexpr double TOLERANCE_MARGIN = 1.5;

ViewSynchronizerOptions synchronizerOptions(std::size_t views, double tolerance_s)
{
  ViewSynchronizerOptions options;
  options.view_count = views;
  options.queue_size = 10;
  options.tolerance_ns = static_cast<std::int64_t>(tolerance_s * NANOSECONDS_PER_SECOND);
  return options;
}

std::string number(double value, int digits)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

template <class Value>
Value median(std::vector<Value> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.empty() ? Value() : *middle;
}

/// Distance of a stamp from the nearest one of a view; none if it has no images.
std::optional<std::int64_t> distanceToNearest(const std::vector<std::int64_t>& stamps, std::int64_t stamp)
{
  std::optional<std::int64_t> nearest;
  for (const std::int64_t other : stamps)
  {
    const std::int64_t distance = std::abs(other - stamp);
    nearest = nearest ? std::min(*nearest, distance) : distance;
  }
  return nearest;
}

}  // namespace

class ArrayCheck::Implementation
{
public:
  Implementation(ViewArray array, const ArrayCheckOptions& options);

  void add(std::size_t view, const ViewImage& image);
  void add(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info) { infos_[view] = info; }
  const ViewArray& array() const { return array_; }
  double neededToleranceS() const;
  std::vector<ArrayFinding> judge(Pipeline& pipeline);

private:
  bool isCalibrated() const;
  void judgeMissing(std::vector<ArrayFinding>& findings) const;
  void judgeRates(std::vector<ArrayFinding>& findings) const;
  void judgeStamps(std::vector<ArrayFinding>& findings) const;
  void judgeImages(Pipeline& pipeline, std::vector<ArrayFinding>& findings);
  void judgeResults(const LightField& light_field, Pipeline& pipeline,
                    std::vector<ArrayFinding>& findings) const;
  void judgeBrightness(const LightField& light_field, ThreadPool& pool,
                       std::vector<ArrayFinding>& findings) const;
  void judgePlaces(const LightField& light_field, const DisparityRange& range, ThreadPool& pool,
                   std::vector<ArrayFinding>& findings) const;
  std::string nameOf(const LightField& light_field, std::size_t view) const;
  double periodS(std::size_t view) const;

  ViewArray array_;
  ArrayCheckOptions options_;
  ViewSynchronizer<ViewImage> synchronizer_;
  std::vector<std::vector<std::int64_t>> stamps_ns_;  ///< of every image of each view
  std::vector<ViewImage> newest_;                     ///< of each view
  std::vector<sensor_msgs::CameraInfoConstPtr> infos_;
  std::vector<ViewImage> whole_set_;
  std::size_t sets_ = 0;
  std::int64_t largest_spread_ns_ = 0;
};

ArrayCheck::Implementation::Implementation(ViewArray array, const ArrayCheckOptions& options)
    : array_(std::move(array)), options_(options),
      synchronizer_(synchronizerOptions(array_.views.size(), options.sync_tolerance_s)),
      stamps_ns_(array_.views.size()), newest_(array_.views.size()), infos_(array_.views.size())
{
}

void ArrayCheck::Implementation::add(std::size_t view, const ViewImage& image)
{
  const auto stamp_ns = static_cast<std::int64_t>(image.header().stamp.toNSec());
  stamps_ns_[view].push_back(stamp_ns);
  newest_[view] = image;
  for (auto set = synchronizer_.add(view, stamp_ns, image); set; set = synchronizer_.next())
  {
    ++sets_;
    largest_spread_ns_ = std::max(largest_spread_ns_, set->spread_ns);
    whole_set_ = std::move(set->payloads);
  }
}

bool ArrayCheck::Implementation::isCalibrated() const
{
  return !options_.use_camera_info ||
         std::all_of(infos_.begin(), infos_.end(), [](const auto& info) { return info != nullptr; });
}

double ArrayCheck::Implementation::periodS(std::size_t view) const
{
  const std::vector<std::int64_t>& stamps = stamps_ns_[view];
  return stamps.size() < 2 ? 0.0
                           : static_cast<double>(stamps.back() - stamps.front()) /
                                 static_cast<double>(stamps.size() - 1) / NANOSECONDS_PER_SECOND;
}

double ArrayCheck::Implementation::neededToleranceS() const
{
  if (sets_ > 0)
  {
    return largest_spread_ns_ == 0 ? 0.0 : options_.sync_tolerance_s;
  }
  std::vector<std::int64_t> spreads;
  for (const std::int64_t stamp : stamps_ns_[array_.reference])
  {
    std::int64_t spread = 0;
    for (const std::vector<std::int64_t>& stamps : stamps_ns_)
    {
      spread = std::max(spread, distanceToNearest(stamps, stamp).value_or(0));
    }
    spreads.push_back(spread);
  }
  return TOLERANCE_MARGIN * static_cast<double>(median(std::move(spreads))) / NANOSECONDS_PER_SECOND;
}

std::vector<ArrayFinding> ArrayCheck::Implementation::judge(Pipeline& pipeline)
{
  std::vector<ArrayFinding> findings;
  judgeMissing(findings);
  judgeRates(findings);
  judgeStamps(findings);
  judgeImages(pipeline, findings);
  std::stable_sort(findings.begin(), findings.end(),
                   [](const ArrayFinding& a, const ArrayFinding& b) { return a.severity > b.severity; });
  return findings;
}

void ArrayCheck::Implementation::judgeMissing(std::vector<ArrayFinding>& findings) const
{
  for (std::size_t i = 0; i < array_.views.size(); ++i)
  {
    const ViewTopics& view = array_.views[i];
    if (stamps_ns_[i].empty())
    {
      findings.push_back({Severity::Error, describe(view) +
                                               ": no image has come; start its driver, or correct the "
                                               "topic in the array's description."});
    }
    if (options_.use_camera_info && infos_[i] == nullptr)
    {
      findings.push_back(
          {Severity::Error,
           describe(view) + ": no CameraInfo has come on '" + view.camera_info +
               "'; calibrate the camera, name a file by camera_info_url, or set use_camera_info to "
               "false."});
    }
  }
}

void ArrayCheck::Implementation::judgeRates(std::vector<ArrayFinding>& findings) const
{
  std::vector<std::size_t> counts;
  std::vector<double> rates_hz;
  for (std::size_t i = 0; i < stamps_ns_.size(); ++i)
  {
    counts.push_back(stamps_ns_[i].size());
    if (periodS(i) > 0.0)
    {
      rates_hz.push_back(1.0 / periodS(i));
    }
  }
  const auto usual = static_cast<double>(median(counts));
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const auto count = static_cast<double>(counts[i]);
    if (count > 0.0 && count < MIN_SHARE_OF_FRAMES * usual - 1.0)
    {
      findings.push_back(
          {Severity::Warning, describe(array_.views[i]) + ": " + std::to_string(counts[i]) +
                                  " images came where the median view had " + std::to_string(median(counts)) +
                                  "; look for a lower frame rate, a slow network or USB bus, or set "
                                  "allow_incomplete."});
    }
  }
  if (!rates_hz.empty())
  {
    const auto [slowest, fastest] = std::minmax_element(rates_hz.begin(), rates_hz.end());
    findings.push_back({Severity::Fine, std::to_string(rates_hz.size()) + " of " +
                                            std::to_string(array_.views.size()) + " views publish, at " +
                                            number(*slowest, 2) + " to " + number(*fastest, 2) + " Hz."});
  }
}

void ArrayCheck::Implementation::judgeStamps(std::vector<ArrayFinding>& findings) const
{
  if (sets_ > 0)
  {
    findings.push_back({Severity::Fine,
                        std::to_string(sets_) + " whole sets; their stamps are up to " +
                            number(static_cast<double>(largest_spread_ns_) / NANOSECONDS_PER_MILLISECOND, 3) +
                            " ms apart."});
    return;
  }
  if (std::any_of(stamps_ns_.begin(), stamps_ns_.end(), [](const auto& stamps) { return stamps.empty(); }))
  {
    return;  // said already
  }
  const double needed_s = neededToleranceS();
  const double period_s = periodS(array_.reference);
  const std::string apart = number(1e3 * needed_s / TOLERANCE_MARGIN, 3);
  if (period_s > 0.0 && needed_s / TOLERANCE_MARGIN > MAX_SPREAD_OF_PERIOD * period_s)
  {
    findings.push_back(
        {Severity::Error, "No whole set came: the nearest stamps of the views are " + apart +
                              " ms apart, at " + number(1e3 * period_s, 1) +
                              " ms between frames; trigger the cameras together, or stamp their images "
                              "at the trigger."});
  }
  else
  {
    findings.push_back({Severity::Error, "No whole set came: the nearest stamps of the views are " + apart +
                                             " ms apart; set sync_tolerance to " + number(needed_s, 4) +
                                             "."});
  }
}

void ArrayCheck::Implementation::judgeImages(Pipeline& pipeline, std::vector<ArrayFinding>& findings)
{
  const std::vector<ViewImage>& images = whole_set_.empty() ? newest_ : whole_set_;
  if (!isCalibrated() || !std::all_of(images.begin(), images.end(),
                                      [](const ViewImage& image) { return static_cast<bool>(image); }))
  {
    return;  // said already
  }
  try
  {
    AssemblerOptions assembler_options;
    assembler_options.use_camera_info = options_.use_camera_info;
    assembler_options.rectify = options_.rectify;
    assembler_options.mask_black = options_.mask_black;
    assembler_options.decimation = options_.decimation;
    LightFieldAssembler assembler(array_, options_.calibration, assembler_options, pipeline.pool());
    const LightField light_field = assembler.assemble(images, infos_);
    for (const std::string& warning : assembler.warnings())
    {
      findings.push_back({Severity::Warning, warning});
    }
    judgeResults(light_field, pipeline, findings);
  }
  catch (const InputError& error)
  {
    findings.push_back({Severity::Error, error.what()});
  }
}

void ArrayCheck::Implementation::judgeResults(const LightField& light_field, Pipeline& pipeline,
                                              std::vector<ArrayFinding>& findings) const
{
  for (const std::string& warning : judgeOrder(light_field, pipeline.pool()).warnings())
  {
    findings.push_back({Severity::Error, warning});
  }
  PipelineOptions options;
  options.multiview.preset = MultiviewPreset::Realtime;
  const DisparityEstimate estimate = pipeline.run(light_field, options, {}).estimate;
  for (const std::string& warning : judgeResult(light_field, estimate, pipeline.pool()).warnings())
  {
    findings.push_back({Severity::Warning, warning});
  }
  findings.push_back({Severity::Fine, "Disparities go from " + number(estimate.range.min, 2) + " to " +
                                          number(estimate.range.max, 2) + " px between adjacent views."});
  const LightField eight_bit = toEightBit(light_field);
  judgeBrightness(eight_bit, pipeline.pool(), findings);
  judgePlaces(eight_bit, estimate.range, pipeline.pool(), findings);
}

std::string ArrayCheck::Implementation::nameOf(const LightField& light_field, std::size_t view) const
{
  const auto topics = std::find_if(array_.views.begin(), array_.views.end(),
                                   [&](const ViewTopics& candidate)
                                   { return candidate.grid == light_field.views[view].grid; });
  return topics == array_.views.end() ? "View " + toString(light_field.views[view].grid) : describe(*topics);
}

void ArrayCheck::Implementation::judgeBrightness(const LightField& light_field, ThreadPool& pool,
                                                 std::vector<ArrayFinding>& findings) const
{
  const std::vector<ViewExposure> exposures = estimateExposure(light_field, pool);
  double darkest = 1.0;
  double brightest = 1.0;
  for (std::size_t i = 0; i < exposures.size(); ++i)
  {
    const double gain = cv::sum(cv::Mat(exposures[i].gain))[0] / 3.0;
    darkest = std::min(darkest, gain);
    brightest = std::max(brightest, gain);
    if (gain < DARKEST_GAIN || gain > BRIGHTEST_GAIN)
    {
      findings.push_back(
          {Severity::Warning, nameOf(light_field, i) + ": its images have to be multiplied by " +
                                  number(gain, 2) +
                                  " to look like the reference's; give all cameras one exposure and "
                                  "gain."});
    }
  }
  findings.push_back({Severity::Fine, "Brightness of the views relative to the reference: gains of " +
                                          number(darkest, 2) + " to " + number(brightest, 2) + "."});
}

void ArrayCheck::Implementation::judgePlaces(const LightField& light_field, const DisparityRange& range,
                                             ThreadPool& pool, std::vector<ArrayFinding>& findings) const
{
  const Registration registration = estimateRegistration(light_field, range, pool);
  double largest_px = 0.0;
  for (std::size_t i = 0; i < registration.views.size(); ++i)
  {
    const double off_px = cv::norm(registration.views[i].shift_px);
    largest_px = std::max(largest_px, off_px);
    if (off_px > MAX_MISPLACED_PX)
    {
      findings.push_back(
          {Severity::Warning, nameOf(light_field, i) + ": shows the scene " + number(off_px, 2) +
                                  " px beside where its calibration says; calibrate again, or set "
                                  "multiview_registration."});
    }
  }
  findings.push_back({Severity::Fine, "Residual misalignment: up to " + number(largest_px, 2) + " px" +
                                          (registration.differs ? "." : " (none that can be measured).")});
}

ArrayCheck::ArrayCheck(ViewArray array, const ArrayCheckOptions& options)
    : implementation_(std::make_unique<Implementation>(std::move(array), options))
{
}

ArrayCheck::~ArrayCheck() = default;

void ArrayCheck::add(std::size_t view, const sensor_msgs::ImageConstPtr& image)
{
  implementation_->add(view, ViewImage(image));
}

void ArrayCheck::add(std::size_t view, const sensor_msgs::CompressedImageConstPtr& image)
{
  implementation_->add(view, ViewImage(image));
}

void ArrayCheck::add(std::size_t view, const sensor_msgs::CameraInfoConstPtr& info)
{
  implementation_->add(view, info);
}

const ViewArray& ArrayCheck::array() const
{
  return implementation_->array();
}

double ArrayCheck::neededToleranceS() const
{
  return implementation_->neededToleranceS();
}

std::vector<ArrayFinding> ArrayCheck::judge(Pipeline& pipeline)
{
  return implementation_->judge(pipeline);
}

}  // namespace light_field_depth
