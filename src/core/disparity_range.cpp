#include "light_field_depth/core/disparity_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "label_support.h"
#include "plane_sweep.h"

namespace light_field_depth
{
namespace
{
/// The reduced images have at least this many pixels on their longer side (if the views have them).
constexpr int COARSE_SIDE_PX = 128;
constexpr int FINE_SIDE_PX = 256;
/// Spacing of the labels, in pixels of the reduced images, in the farthest view.
constexpr float LABEL_DISPLACEMENT = 0.5F;
/// A sweep also looks this many labels of the sweep before beyond what that found.
constexpr float MARGIN_LABELS = 1.5F;

/// Views in one of the four directions from the reference, nearest first.
using Arm = std::vector<const View*>;

double distanceOf(const View& view)
{
  return std::hypot(view.steps.x, view.steps.y);
}

/// The nearest, the farthest and one half-way between them.
Arm thinOut(Arm arm)
{
  std::stable_sort(arm.begin(), arm.end(),
                   [](const View* a, const View* b) { return distanceOf(*a) < distanceOf(*b); });
  return arm.size() <= 3 ? arm : Arm{arm.front(), arm[arm.size() / 2], arm.back()};
}

/// Right, left, below, above. Views on the row and the column of the reference come first; where there is
/// none of these, all others are sorted into the direction that they are nearest to.
std::vector<Arm> armsOf(const LightField& light_field)
{
  constexpr double ON_AXIS = 0.05;
  for (const bool on_axis_only : {true, false})
  {
    std::array<Arm, 4> arms;
    for (const View& view : light_field.views)
    {
      const double along = std::max(std::abs(view.steps.x), std::abs(view.steps.y));
      const double across = std::min(std::abs(view.steps.x), std::abs(view.steps.y));
      if (along < 1e-9 || (on_axis_only && across > ON_AXIS * along))
      {
        continue;
      }
      const bool horizontal = std::abs(view.steps.x) >= std::abs(view.steps.y);
      const bool positive = (horizontal ? view.steps.x : view.steps.y) > 0;
      arms[(horizontal ? 0U : 2U) + (positive ? 0U : 1U)].push_back(&view);
    }
    std::vector<Arm> filled;
    for (Arm& arm : arms)
    {
      if (!arm.empty())
      {
        filled.push_back(thinOut(std::move(arm)));
      }
    }
    if (!filled.empty())
    {
      return filled;
    }
  }
  return {};
}

/// How often a view is halved before its longer side would be less than side_px.
int halvingsFor(const cv::Size& size, int side_px)
{
  constexpr int LEAST_SIDE_PX = 16;
  int halvings = 0;
  while (std::max(size.width, size.height) >> (halvings + 1) >= side_px &&
         std::min(size.width, size.height) >> (halvings + 1) >= LEAST_SIDE_PX)
  {
    ++halvings;
  }
  return halvings;
}

cv::Mat halve(const cv::Mat& image)
{
  const cv::Size half(image.cols / 2, image.rows / 2);
  cv::Mat result;
  cv::resize(image(cv::Rect(0, 0, 2 * half.width, 2 * half.height)), result, half, 0, 0, cv::INTER_AREA);
  return result;
}

/// The grey view at two scales.
struct SmallView
{
  cv::Mat coarse;
  cv::Mat fine;
};

SmallView shrink(const cv::Mat& image, int fine_halvings, int coarse_halvings)
{
  cv::Mat small = fine_halvings > 0 ? halve(image) : image;
  if (small.channels() == 3)
  {
    cv::Mat grey;
    cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
    small = grey;
  }
  SmallView result;
  for (int i = 1; i < fine_halvings; ++i)
  {
    small = halve(small);
  }
  result.fine = small;
  for (int i = fine_halvings; i < coarse_halvings; ++i)
  {
    small = halve(small);
  }
  result.coarse = small;
  return result;
}

/// The small images of the views that take part, and what the sweeps have found so far.
class RangeFinder
{
public:
  RangeFinder(const LightField& light_field, ThreadPool& pool) : pool_(pool), arms_(armsOf(light_field))
  {
    coarse_halvings_ = halvingsFor(light_field.size(), COARSE_SIDE_PX);
    fine_halvings_ = halvingsFor(light_field.size(), FINE_SIDE_PX);
    nearest_ = std::numeric_limits<double>::max();
    for (const Arm& arm : arms_)
    {
      nearest_ = std::min(nearest_, distanceOf(*arm.front()));
      farthest_ = std::max(farthest_, distanceOf(*arm.back()));
    }
    shrinkViews(light_field.reference());
  }

  DisparityRange find(const DisparityRangeOptions& options)
  {
    const float most = largestDisparity(options);
    range_ = {-most, most};
    step_ = 0.0F;
    sweep(Views::Nearest, coarse_halvings_);
    if (farthest_ > 1.5 * nearest_)
    {
      sweep(Views::Farther, coarse_halvings_);
    }
    if (found_ && fine_halvings_ < coarse_halvings_)
    {
      sweep(Views::Farther, fine_halvings_);
    }
    if (!found_)
    {
      range_ = {0.0F, 0.0F};
    }
    const float pad = std::max(options.pad_fraction * (range_.max - range_.min), options.pad_labels * step_);
    return {range_.min - pad, range_.max + pad};
  }

private:
  enum class Views
  {
    Nearest,
    Farther
  };

  float largestDisparity(const DisparityRangeOptions& options) const
  {
    constexpr double LARGEST_FRACTION_OF_SIDE = 0.4;
    double most = options.max_displacement_px / nearest_;
    for (const Arm& arm : arms_)
    {
      const cv::Point2d steps = arm.front()->steps;
      const bool horizontal = std::abs(steps.x) >= std::abs(steps.y);
      const int side = horizontal ? arm.front()->image.cols : arm.front()->image.rows;
      most = std::min(most, LARGEST_FRACTION_OF_SIDE * side / distanceOf(*arm.front()));
    }
    return static_cast<float>(most);
  }

  void shrinkViews(const View& reference)
  {
    std::vector<const View*> views = {&reference};
    for (const Arm& arm : arms_)
    {
      views.insert(views.end(), arm.begin(), arm.end());
    }
    small_.resize(views.size());
    pool_.parallelFor(0, static_cast<int>(views.size()), 1,
                      [&](int first, int last)
                      {
                        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last);
                             ++i)
                        {
                          small_[i] = shrink(views[i]->image, fine_halvings_, coarse_halvings_);
                        }
                      });
  }

  PlaneSweep planSweep(Views which, int halvings) const
  {
    const auto scale = static_cast<float>(std::ldexp(1.0, -halvings));
    const bool coarse = halvings == coarse_halvings_;
    PlaneSweep plan;
    plan.reference = coarse ? small_.front().coarse : small_.front().fine;
    std::size_t next = 1;
    double reach = 0.0;
    for (const Arm& arm : arms_)
    {
      SweepArm sweep_arm;
      for (std::size_t i = 0; i < arm.size(); ++i, ++next)
      {
        const bool wanted = which == Views::Nearest ? i == 0 : i > 0 || arm.size() == 1;
        if (wanted)
        {
          sweep_arm.push_back({coarse ? small_[next].coarse : small_[next].fine,
                               cv::Point2f(arm[i]->steps) * scale, cv::Point2f(arm[i]->offset_px) * scale});
          reach = std::max(reach, distanceOf(*arm[i]));
        }
      }
      plan.arms.push_back(std::move(sweep_arm));
    }
    plan.disparity_step = LABEL_DISPLACEMENT / (scale * static_cast<float>(reach));
    const float centre = 0.5F * (range_.min + range_.max);
    const int half = static_cast<int>(std::ceil(0.5F * (range_.max - range_.min) / plan.disparity_step));
    plan.labels = 2 * half + 1;
    plan.first_disparity = centre - static_cast<float>(half) * plan.disparity_step;
    return plan;
  }

  /// Narrows range_ to what is supported inside range_, widened by what the sweep before could not resolve.
  void sweep(Views which, int halvings)
  {
    const DisparityRange before = range_;
    range_.min -= MARGIN_LABELS * step_;
    range_.max += MARGIN_LABELS * step_;
    const PlaneSweep plan = planSweep(which, halvings);
    const CostVolume volume = sweepPlanes(plan, pool_);
    const std::optional<LabelRange> supported = findSupportedLabels(volume, pool_);
    if (!supported)
    {
      range_ = before;
      return;
    }
    range_ = {plan.disparity(static_cast<float>(supported->first)),
              plan.disparity(static_cast<float>(supported->last))};
    step_ = plan.disparity_step;
    found_ = true;
  }

  ThreadPool& pool_;
  std::vector<Arm> arms_;
  int coarse_halvings_ = 0;
  int fine_halvings_ = 0;
  double nearest_ = 0.0;
  double farthest_ = 0.0;
  std::vector<SmallView> small_;  ///< the reference, then the views of the arms in order
  DisparityRange range_;
  float step_ = 0.0F;
  bool found_ = false;
};

}  // namespace

std::vector<std::string> validate(const DisparityRangeOptions& options)
{
  std::vector<std::string> problems;
  if (!(options.max_displacement_px >= 1.0F && options.max_displacement_px <= 1000.0F))
  {
    problems.push_back("disparity_range.max_displacement_px is " +
                       std::to_string(options.max_displacement_px) + "; it must be between 1 and 1000.");
  }
  if (!(options.pad_fraction >= 0.0F && options.pad_fraction <= 1.0F))
  {
    problems.push_back("disparity_range.pad_fraction is " + std::to_string(options.pad_fraction) +
                       "; it must be between 0 and 1.");
  }
  if (!(options.pad_labels >= 0.5F && options.pad_labels <= 100.0F))
  {
    problems.push_back("disparity_range.pad_labels is " + std::to_string(options.pad_labels) +
                       "; it must be between 0.5 and 100.");
  }
  return problems;
}

DisparityRange findDisparityRange(const LightField& light_field, ThreadPool& pool,
                                  const DisparityRangeOptions& options)
{
  const LightField bytes = toEightBit(light_field);
  return RangeFinder(bytes, pool).find(options);
}

}  // namespace light_field_depth
