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
/// Pixels at which the image changes along one direction at least a tenth as much (sum of squares) as along
/// the other; of the half that changes most so many have to. Captures have 0.41 to 0.90, stripes 0.04, thin
/// bars on an even ground 0.13.
constexpr int STRUCTURE_WINDOW_PX = 5;
constexpr float MIN_STRUCTURE = 0.1F;
constexpr double MIN_STRUCTURED = 0.2;
/// To find out whether anything is off, and to measure it.
constexpr std::size_t FEW_POINTS = 1000;
constexpr std::size_t MANY_POINTS = 6000;
/// Clean scenes stay below this part of the limits at the reduced size.
constexpr double SUSPICION = 0.9;
/// To find out whether what was measured is true of other points, too.
constexpr std::size_t TESTED_POINTS = 375;
/// What the views differ by there has to fall below this part for a richer explanation to be taken: models of
/// cheap cameras 0.50 and 0.60, a gantry 0.14, an array 0.94, steps of columns that are 5 % off 0.89, clean
/// and noisy renders 1.00, a plenoptic camera for which the adjustment fails 1.2.
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

/// Whether the image changes in all directions. Stripes do not tell disparities of the rows from shifts of
/// the views, nor those of the columns, and match a period too far.
bool isStructured(const cv::Mat& grey)
{
  constexpr int slope_aperture_px = 3;
  cv::Mat eigenvalues;
  cv::cornerEigenValsAndVecs(grey, eigenvalues, STRUCTURE_WINDOW_PX, slope_aperture_px, cv::BORDER_REPLICATE);
  std::vector<cv::Point2f> changes;  // along and across
  changes.reserve(grey.total());
  std::for_each(eigenvalues.begin<cv::Vec6f>(), eigenvalues.end<cv::Vec6f>(),
                [&](const cv::Vec6f& of_pixel) { changes.emplace_back(of_pixel[0], of_pixel[1]); });
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end(),
                   [](const cv::Point2f& left, const cv::Point2f& right) { return left.x > right.x; });
  const auto structured = std::count_if(changes.begin(), middle,
                                        [](const cv::Point2f& change)
                                        { return change.y > 0.0F && change.y >= MIN_STRUCTURE * change.x; });
  return static_cast<double>(structured) >= MIN_STRUCTURED * static_cast<double>(middle - changes.begin());
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

/// Which of the adjustments holds for points that it was not measured at; a later one has to be clearly
/// better than those before it.
/// @param points others than those of the adjustments
std::size_t clearlyBest(const SlopedViews& grey, const std::vector<AdjustedPoint>& points,
                        std::vector<Adjustment> adjustments, ThreadPool& pool)
{
  for (Adjustment& adjustment : adjustments)
  {
    adjustment.points = points;
  }
  const std::vector<double> fits = compareFits(grey, std::move(adjustments), pool);
  std::size_t best = 0;
  for (std::size_t i = 1; i < fits.size(); ++i)
  {
    best = fits[i] < MAX_FIT_RATIO * fits[best] ? i : best;
  }
  return best;
}

/// The misfits as a line between rows and columns and what that leaves, in the light field's pixels. All
/// disparities can be shifted if the views are shifted with them; of all such misfits those are taken that
/// move the views least, what the ratio of the steps moves them by at the middle of the range included.
/// @param range as `light_field` has it
Registration separated(const LightField& light_field, const DisparityRange& range,
                       const Adjustment& adjustment, double pixel_size)
{
  Registration result;
  result.step_ratio = adjustment.step_ratio;
  result.views = adjustment.views;
  const double middle = 0.5 * (range.min + range.max);
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
  Sum all;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    const cv::Point2d by_ratio(0.0, (1.0 - result.step_ratio) * middle * steps.y);
    all.add(result.views[i].shift_px + by_ratio, steps);
  }
  Sum row;
  Sum column;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    cv::Point2d& shift = result.views[i].shift_px;
    shift -= all.mean() * cv::Point2d(steps.x, result.step_ratio * steps.y);
    row.add({shift.x, 0.0}, {steps.x, 0.0});
    column.add({0.0, shift.y}, {0.0, steps.y});
  }
  // A view at column c is shifted by -r c and one at row c by -(a r + b) c, where d_row = d + r and
  // d_column = a d_row + b.
  result.row_offset_px = -row.mean();
  result.step_offset_px = -column.mean() - result.step_ratio * result.row_offset_px;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    result.views[i].shift_px -= cv::Point2d(row.mean() * steps.x, column.mean() * steps.y);
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
    registration.row_offset_px = 0.0;
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
  if (!isStructured(small.reference().image))
  {
    return {};
  }
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
  // The start of both at full size: views that stand off their places, and steps of another ratio besides.
  const SlopedViews small_slopes(small, pool);
  std::array<Adjustment, 2> starts = {adjustment, adjustment};
  starts[0].steps_are_known = true;
  adjustJointly(small_slopes, options.expected_px / scale, FIRST_STEPS, pool, starts[0]);
  starts[1] = starts[0];
  starts[1].steps_are_known = false;
  adjustJointly(small_slopes, options.expected_px / scale, FIRST_STEPS, pool, starts[1]);
  const cv::Size size(static_cast<int>(full.width * options.pixel_size),
                      static_cast<int>(full.height * options.pixel_size));
  const Size first = sizeOf(separated(small, range, starts[1], scale), size, range);
  if (first.shift_px <= SUSPICION * options.min_shift_px &&
      first.bend_px <= SUSPICION * options.min_bend_px && first.line_px <= SUSPICION * options.min_line_px)
  {
    return {};
  }
  // From the simplest explanation to the richest: nothing is off; views stand off their places; rows and
  // columns differ by an offset besides; and by a ratio of steps.
  const LightField grey_views = greyViews(light_field);
  const SlopedViews grey(grey_views, pool);
  std::vector<Adjustment> candidates(1, enlarged(others, halvings));
  const std::vector<AdjustedPoint> tested_points = candidates.front().points;
  for (Adjustment& start : starts)
  {
    if (!start.steps_are_known && first.line_px <= SUSPICION * options.min_line_px)
    {
      break;
    }
    start.points = thinned(points, MANY_POINTS / 4);
    Adjustment candidate = enlarged(start, halvings);
    adjustJointly(grey, options.expected_px / options.pixel_size, LAST_STEPS, pool, candidate);
    if (candidate.steps_are_known)
    {
      candidates.push_back(candidate);
      candidates.back().views = separated(light_field, range, candidate, 1.0).views;
    }
    candidates.push_back(std::move(candidate));
  }
  const std::size_t best = clearlyBest(grey, tested_points, candidates, pool);
  if (best == 0)
  {
    return {};
  }
  const Registration found = separated(light_field, range, candidates[best], options.pixel_size);
  return significant(found, sizeOf(found, size, range), options);
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
