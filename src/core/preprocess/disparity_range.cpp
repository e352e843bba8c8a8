#include "light_field_depth/core/disparity_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/preprocess/label_support.h"
#include "core/preprocess/plane_sweep.h"
#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// The reduced images have at least this many pixels on their longer side (if the views have them).
constexpr int COARSE_SIDE_PX = 96;
constexpr int FINE_SIDE_PX = 192;
/// Spacing of the labels, in pixels of the reduced images, in the farthest view.
constexpr float LABEL_DISPLACEMENT = 0.5F;
/// The second sweep looks for objects that were too small for the first one, the larger of this many labels
/// and this fraction of the range on both sides of what that found.
constexpr float SMALL_OBJECT_LABELS = 2.0F;
constexpr float SMALL_OBJECT_FRACTION = 0.25F;
/// The third sweep looks this many labels beyond what the second found, which could not resolve more.
constexpr float MARGIN_LABELS = 1.5F;

/// Noise makes the ends of the range uncertain by this much.
constexpr float PAD_LABELS_OF_NOISE = 0.5F;

/// The grey view at two scales.
struct SmallView
{
  cv::Mat coarse;
  cv::Mat fine;
};

SmallView shrink(const cv::Mat& image, int fine_halvings, int coarse_halvings)
{
  // Halved once in colour, where that is quick, and in grey from there.
  const int first = std::min(fine_halvings, 1);
  SmallView result;
  result.fine = halve(toGrey(halve(image, first)), fine_halvings - first);
  result.coarse = halve(result.fine, coarse_halvings - fine_halvings);
  return result;
}

/// The small images of the views that take part, and what the sweeps have found so far.
class RangeFinder
{
public:
  RangeFinder(const LightField& light_field, ThreadPool& pool) : pool_(pool), arms_(axisArmsOf(light_field))
  {
    coarse_halvings_ = halvingsFor(light_field.size(), COARSE_SIDE_PX);
    fine_halvings_ = halvingsFor(light_field.size(), FINE_SIDE_PX);
    nearest_ = nearestDistance(arms_);
    farthest_ = farthestDistance(arms_);
    shrinkViews(light_field.reference());
  }

  DisparityRange find(const DisparityRangeOptions& options)
  {
    const float most = largestDisparity(arms_, options.max_displacement_px);
    range_ = {-most, most};
    sweep(Views::Nearest, coarse_halvings_);
    if (found_ && fine_halvings_ < coarse_halvings_)
    {
      widen(std::max(SMALL_OBJECT_LABELS * step_, SMALL_OBJECT_FRACTION * (range_.max - range_.min)), most);
      sweep(Views::Nearest, fine_halvings_);
    }
    if (farthest_ > 1.5 * nearest_)
    {
      widen(MARGIN_LABELS * step_, most);
      const DisparityRange wide = range_;
      sweep(Views::Farther, coarse_halvings_);
      range_ = wide;
      sweep(Views::Farther, fine_halvings_);
    }
    if (!found_)
    {
      range_ = {0.0F, 0.0F};
    }
    const float pad_labels = options.pad_labels + (noisy_ ? PAD_LABELS_OF_NOISE : 0.0F);
    const float pad = std::max(options.pad_fraction * (range_.max - range_.min), pad_labels * step_);
    return {range_.min - pad, range_.max + pad};
  }

private:
  enum class Views
  {
    Nearest,
    Farther
  };

  void shrinkViews(const View& reference)
  {
    std::vector<const View*> views = {&reference};
    for (const AxisArm& arm : arms_)
    {
      views.insert(views.end(), arm.begin(), arm.end());
    }
    small_.resize(views.size());
    forEachSmallView([&](std::size_t i)
                     { small_[i] = shrink(views[i]->image, fine_halvings_, coarse_halvings_); });
    const int fine_blur = blurFor(small_.front().fine);
    noisy_ = fine_blur > 1;
    const int coarse_blur = blurFor(small_.front().coarse);
    forEachSmallView(
        [&](std::size_t i)
        {
          small_[i].fine = blurred(small_[i].fine, fine_blur);
          small_[i].coarse = blurred(small_[i].coarse, coarse_blur);
        });
  }

  void forEachSmallView(const std::function<void(std::size_t)>& body)
  {
    pool_.parallelFor(0, static_cast<int>(small_.size()), 1,
                      [&](int first, int last)
                      {
                        for (int i = first; i < last; ++i)
                        {
                          body(static_cast<std::size_t>(i));
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
    for (const AxisArm& arm : arms_)
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

  void widen(float margin, float most)
  {
    range_.min = std::max(range_.min - margin, -most);
    range_.max = std::min(range_.max + margin, most);
  }

  /// Narrows range_ to what is supported inside it.
  void sweep(Views which, int halvings)
  {
    const PlaneSweep plan = planSweep(which, halvings);
    const SweepCosts volume = sweepPlanes(plan, pool_);
    const std::optional<LabelSupport> support = findSupportedLabels(volume, pool_);
    if (!support)
    {
      return;
    }
    step_ = plan.disparity_step;
    resolved_.min = std::min(resolved_.min, plan.disparity(static_cast<float>(support->core.first) + 0.5F));
    resolved_.max = std::max(resolved_.max, plan.disparity(static_cast<float>(support->core.last) - 0.5F));
    range_.min = std::min(resolved_.min, plan.disparity(static_cast<float>(support->all.first)));
    range_.max = std::max(resolved_.max, plan.disparity(static_cast<float>(support->all.last)));
    found_ = true;
  }

  ThreadPool& pool_;
  std::vector<AxisArm> arms_;
  int coarse_halvings_ = 0;
  int fine_halvings_ = 0;
  double nearest_ = 0.0;
  double farthest_ = 0.0;
  std::vector<SmallView> small_;  ///< the reference, then the views of the arms in order
  DisparityRange range_;
  /// What some sweep was sure of but for its resolution: noise may hide at a fine scale what stood out at a
  /// coarse one.
  DisparityRange resolved_{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  float step_ = 0.0F;
  bool found_ = false;
  bool noisy_ = false;
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
