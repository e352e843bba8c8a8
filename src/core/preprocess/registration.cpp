#include "light_field_depth/core/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/view_mask.h"
#include "core/preprocess/joint_adjustment.h"
#include "core/preprocess/label_support.h"
#include "core/preprocess/plane_sweep.h"
#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// The reduced views have at least this many pixels on their longer side (if the views have them).
constexpr int SMALL_SIDE_PX = 96;
/// Smaller views show too little.
constexpr int MIN_SIDE_PX = 32;
/// The equations grow with the square of the views.
constexpr std::size_t MAX_VIEWS = 33;
/// Spacing of the labels, in pixels of the reduced views, in the farthest view.
constexpr float LABEL_DISPLACEMENT = 0.5F;
/// The sweep is left out where it would take more labels.
constexpr int MAX_LABELS = 256;
/// Set by hand: a few for each of 33 views.
constexpr std::size_t MIN_POINTS = 150;
/// To find out whether anything is off, and to measure it.
constexpr std::size_t FEW_POINTS = 1000;
constexpr std::size_t MANY_POINTS = 6000;
/// Clean scenes stay below this part of the limits at the reduced size.
constexpr double SUSPICION = 0.9;
/// To find out whether what was measured is true of other points, too.
constexpr std::size_t TESTED_POINTS = 375;
/// What the views differ by there has to fall below this part: models of cheap cameras 0.50 and 0.60, a
/// gantry 0.14, an array 0.94, steps of columns that are 5 % off 0.89, clean and noisy renders 1.00, a
/// plenoptic camera for which the adjustment fails 1.2.
constexpr double MAX_FIT_RATIO = 0.97;
/// Of Gauss and Newton, with few and with many points. Set by hand: the disparities are nearly right at the
/// start, and each step takes as long as the one before.
constexpr int FIRST_STEPS = 2;
constexpr int LAST_STEPS = 3;

LightField greyViews(const LightField& light_field)
{
  LightField grey = light_field;
  for (View& view : grey.views)
  {
    view.image = toGrey(view.image);
  }
  return grey;
}

LightField reducedViews(const LightField& light_field, int halvings, ThreadPool& pool)
{
  LightField small = light_field;
  const double scale = std::ldexp(1.0, -halvings);
  pool.parallelFor(0, static_cast<int>(small.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       View& view = small.views[i];
                       view.image = toGrey(halve(view.image, halvings));
                       view.steps *= scale;
                       view.offset_px *= scale;
                     }
                   });
  return small;
}

/// Likely matches of a plane sweep over the range.
std::vector<AdjustedPoint> matchedPoints(const LightField& small, const DisparityRange& range,
                                         ThreadPool& pool)
{
  const std::vector<AxisArm> arms = axisArmsOf(small);
  PlaneSweep plan;
  plan.reference = small.reference().image;
  plan.disparity_step = LABEL_DISPLACEMENT / static_cast<float>(farthestDistance(arms));
  plan.first_disparity = range.min - plan.disparity_step;
  plan.labels = 3 + static_cast<int>(std::ceil((range.max - range.min) / plan.disparity_step));
  if (plan.labels > MAX_LABELS)
  {
    return {};
  }
  for (const AxisArm& arm : arms)
  {
    SweepArm sweep_arm;
    for (const View* view : arm)
    {
      sweep_arm.push_back({view->image, cv::Point2f(view->steps), cv::Point2f(view->offset_px)});
    }
    plan.arms.push_back(std::move(sweep_arm));
  }
  const std::vector<float> labels = findLikelyLabels(sweepPlanes(plan, pool), pool);
  std::vector<AdjustedPoint> points;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (!std::isnan(labels[i]))
    {
      const auto width = static_cast<std::size_t>(plan.reference.cols);
      points.push_back(
          {cv::Point(static_cast<int>(i % width), static_cast<int>(i / width)), plan.disparity(labels[i])});
    }
  }
  return points;
}

/// At most so many, evenly.
std::vector<AdjustedPoint> thinned(const std::vector<AdjustedPoint>& points, std::size_t most)
{
  std::vector<AdjustedPoint> kept;
  const std::size_t stride = (points.size() + most - 1) / most;
  for (std::size_t i = 0; i < points.size(); i += stride)
  {
    kept.push_back(points[i]);
  }
  return kept;
}

/// Takes every fifth point out, for a test of what the others tell.
std::vector<AdjustedPoint> takeOutTested(std::vector<AdjustedPoint>& points)
{
  constexpr std::size_t every = 5;
  std::vector<AdjustedPoint> tested;
  std::vector<AdjustedPoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    (i % every == every / 2 ? tested : kept).push_back(points[i]);
  }
  points = kept;
  return tested;
}

/// The same at a resolution that is halved so many times: the four pixels in the middle of each point's cell.
Adjustment enlarged(const Adjustment& adjustment, int halvings)
{
  if (halvings == 0)
  {
    return adjustment;
  }
  Adjustment result = adjustment;
  const int scale = 1 << halvings;
  for (ViewMisfit& misfit : result.views)
  {
    misfit.shift_px *= scale;
  }
  result.points.clear();
  for (const AdjustedPoint& point : adjustment.points)
  {
    for (int child = 0; child < 4; ++child)
    {
      const cv::Point offset((scale - 1) / 2 + child % 2, (scale - 1) / 2 + child / 2);
      result.points.push_back({point.pixel * scale + offset, point.disparity});
    }
  }
  return result;
}

/// Whether the misfits hold for points that they were not measured at.
/// @param others the points, without misfits
bool explainsOthers(const LightField& grey, const Adjustment& others, const Adjustment& measured,
                    ThreadPool& pool)
{
  Adjustment explained = measured;
  explained.points = others.points;
  const std::array<double, 2> fits = compareFits(grey, {others, explained}, pool);
  return fits[1] < MAX_FIT_RATIO * fits[0];
}

/// The misfits as a line between rows and columns and what that leaves, in the light field's pixels.
Registration separated(const LightField& light_field, const Adjustment& adjustment, double pixel_size)
{
  constexpr double on_axis = 0.05;
  Registration result;
  result.step_ratio = adjustment.step_ratio;
  result.views = adjustment.views;
  struct Sum
  {
    double product = 0.0;
    double square = 0.0;
    double mean() const { return square > 0.0 ? product / square : 0.0; }
    void add(const cv::Point2d& shift, const cv::Point2d& steps)
    {
      product += shift.dot(steps);
      square += steps.dot(steps);
    }
  };
  // A shift of d moves every view along its steps: the row's views say how much of it is in the misfits.
  Sum row;
  Sum all;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    const cv::Point2d shift = result.views[i].shift_px;
    all.add(shift, steps);
    if (std::abs(steps.y) <= on_axis * std::abs(steps.x))
    {
      row.add(shift, steps);
    }
  }
  const double common = row.square > 0.0 ? row.mean() : all.mean();
  Sum column;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    result.views[i].shift_px -= common * steps;
    column.add({0.0, result.views[i].shift_px.y}, {0.0, steps.y});
  }
  // A view at row r is shifted by -b * r where d_column = a d + b.
  result.step_offset_px = -column.mean();
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    result.views[i].shift_px.y += result.step_offset_px * light_field.views[i].steps.y;
    result.views[i].shift_px *= pixel_size;
  }
  return result;
}

/// Root mean squares over the views but the reference, in pixels.
struct Size
{
  double shift_px = 0.0;
  double bend_px = 0.0;
  double line_px = 0.0;  ///< the most within the range
};

Size sizeOf(const Registration& registration, const cv::Size& image, const DisparityRange& range)
{
  Size size;
  // Mean square of the distance from the middle.
  const double spread = (image.width * image.width + image.height * image.height) / 12.0;
  for (const ViewMisfit& view : registration.views)
  {
    size.shift_px += 0.5 * view.shift_px.dot(view.shift_px);
    size.bend_px += 0.5 * spread * (view.roll * view.roll + view.zoom * view.zoom);
  }
  const auto others = static_cast<double>(registration.views.size() - 1);
  size.shift_px = std::sqrt(size.shift_px / others);
  size.bend_px = std::sqrt(size.bend_px / others);
  for (const double d : {range.min, range.max})
  {
    size.line_px =
        std::max(size.line_px, std::abs((registration.step_ratio - 1.0) * d + registration.step_offset_px));
  }
  return size;
}

/// Leaves what is not clearly off as it is.
Registration significant(Registration registration, const Size& size, const RegistrationOptions& options)
{
  const bool bent = size.bend_px > options.min_bend_px;
  if (size.line_px <= options.min_line_px)
  {
    registration.step_ratio = 1.0;
    registration.step_offset_px = 0.0;
  }
  if (!bent)
  {
    for (ViewMisfit& view : registration.views)
    {
      view.roll = 0.0;
      view.zoom = 0.0;
    }
  }
  registration.resample = bent;
  if (!bent && size.shift_px <= options.min_shift_px)
  {
    registration.views.clear();
  }
  registration.differs = size.line_px > options.min_line_px || !registration.views.empty();
  return registration;
}

/// Where the result at p is seen in the image.
cv::Matx23d placeSeen(const cv::Size& size, const ViewMisfit& misfit)
{
  const double middle_x = 0.5 * (size.width - 1);
  const double middle_y = 0.5 * (size.height - 1);
  const double a = 1.0 + misfit.zoom;
  const double r = misfit.roll;
  return {a, -r, misfit.shift_px.x + middle_x - a * middle_x + r * middle_y,  //
          r, a,  misfit.shift_px.y + middle_y - a * middle_y - r * middle_x};
}

cv::Mat resampled(const cv::Mat& image, const ViewMisfit& misfit)
{
  cv::Mat result;
  cv::warpAffine(image, result, placeSeen(image.size(), misfit), image.size(),
                 cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return result;
}

/// Known is what only known pixels were interpolated of.
cv::Mat resampledMask(const cv::Mat& mask, const ViewMisfit& misfit)
{
  constexpr int tap_radius_px = 2;
  cv::Mat masked;
  cv::warpAffine(maskedWithin(mask, tap_radius_px), masked, placeSeen(mask.size(), misfit), mask.size(),
                 cv::INTER_NEAREST | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return masked == 0;
}

}  // namespace

Registration estimateRegistration(const LightField& light_field, const DisparityRange& range,
                                  ThreadPool& pool, const RegistrationOptions& options)
{
  const cv::Size full = light_field.size();
  if (light_field.views.size() > MAX_VIEWS || std::min(full.width, full.height) < MIN_SIDE_PX)
  {
    return {};
  }
  const int halvings = halvingsFor(full, SMALL_SIDE_PX);
  const LightField small = reducedViews(light_field, halvings, pool);
  Adjustment adjustment;
  adjustment.views.resize(light_field.views.size());
  std::vector<AdjustedPoint> points = matchedPoints(small, range, pool);
  if (points.size() < MIN_POINTS)
  {
    return {};
  }
  const std::vector<AdjustedPoint> tested = takeOutTested(points);
  adjustment.points = thinned(points, FEW_POINTS);
  Adjustment others;
  others.views.resize(light_field.views.size());
  others.points = thinned(tested, TESTED_POINTS);
  const double scale = std::ldexp(1.0, halvings) * options.pixel_size;
  adjustJointly(small, options.expected_px / scale, FIRST_STEPS, pool, adjustment);
  const cv::Size size(static_cast<int>(full.width * options.pixel_size),
                      static_cast<int>(full.height * options.pixel_size));
  const Size first = sizeOf(separated(small, adjustment, scale), size, range);
  if (first.shift_px <= SUSPICION * options.min_shift_px &&
      first.bend_px <= SUSPICION * options.min_bend_px && first.line_px <= SUSPICION * options.min_line_px)
  {
    return {};
  }
  adjustment.points = thinned(points, MANY_POINTS / 4);
  adjustment = enlarged(adjustment, halvings);
  const LightField grey = greyViews(light_field);
  adjustJointly(grey, options.expected_px / options.pixel_size, LAST_STEPS, pool, adjustment);
  const Registration found = separated(light_field, adjustment, options.pixel_size);
  const Size last = sizeOf(found, size, range);
  return explainsOthers(grey, enlarged(others, halvings), adjustment, pool)
             ? significant(found, last, options)
             : Registration();
}

LightField correctRegistration(const LightField& light_field, const Registration& registration,
                               ThreadPool& pool)
{
  LightField result = light_field;
  for (View& view : result.views)
  {
    view.offset_px.y -= registration.step_offset_px * view.steps.y;
    view.steps.y *= registration.step_ratio;
  }
  if (registration.views.empty())
  {
    return result;
  }
  pool.parallelFor(0, static_cast<int>(result.views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       View& view = result.views[i];
                       const ViewMisfit& misfit = registration.views[i];
                       if (!registration.resample)
                       {
                         view.offset_px += misfit.shift_px;
                       }
                       else if (i != result.reference_index)
                       {
                         view.image = resampled(view.image, misfit);
                         view.mask = view.mask.empty() ? view.mask : resampledMask(view.mask, misfit);
                       }
                     }
                   });
  return result;
}

LightField registeredViews(const LightField& light_field, const Registration& registration, ThreadPool& pool)
{
  LightField corrected = correctRegistration(light_field, registration, pool);
  if (registration.views.empty())
  {
    return corrected;
  }
  LightField known = corrected;
  known.views.clear();
  for (std::size_t i = 0; i < corrected.views.size(); ++i)
  {
    const ViewMisfit& misfit = registration.views[i];
    const bool is_reference = i == corrected.reference_index;
    if (is_reference || misfit.shift_px != cv::Point2d() || misfit.roll != 0.0 || misfit.zoom != 0.0)
    {
      known.reference_index = is_reference ? known.views.size() : known.reference_index;
      known.views.push_back(corrected.views[i]);
    }
  }
  return known;
}

std::vector<std::string> describe(const Registration& registration, const LightField& light_field)
{
  std::vector<std::string> sentences;
  std::ostringstream text;
  text << std::fixed << std::setprecision(3);
  if (registration.step_ratio != 1.0 || registration.step_offset_px != 0.0)
  {
    text << "Disparities in the columns are " << registration.step_ratio << " times those in the rows "
         << (registration.step_offset_px < 0.0 ? "minus " : "plus ") << std::abs(registration.step_offset_px)
         << " px; check the baselines and the principal points.";
    sentences.push_back(text.str());
  }
  if (!registration.views.empty())
  {
    const cv::Size size = light_field.size();
    const Size off = sizeOf(registration, size, {});
    std::size_t worst = 0;
    const auto departure = [&](std::size_t i) { return cv::norm(registration.views[i].shift_px); };
    for (std::size_t i = 1; i < registration.views.size(); ++i)
    {
      worst = departure(i) > departure(worst) ? i : worst;
    }
    text.str("");
    text << "The views are off their places by " << off.shift_px << " px, the view at "
         << toString(light_field.views[worst].grid) << " by " << departure(worst) << " px, and by "
         << off.bend_px << " px through roll and zoom (root mean squares); rectify the cameras again.";
    sentences.push_back(text.str());
  }
  return sentences;
}

}  // namespace light_field_depth
