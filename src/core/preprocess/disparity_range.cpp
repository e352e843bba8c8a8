#include "light_field_depth/core/disparity_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/light_field/view_mask.h"
#include "core/preprocess/label_support.h"
#include "core/preprocess/mutual_matches.h"
#include "core/preprocess/plane_sweep.h"
#include "core/preprocess/search_bounds.h"
#include "core/preprocess/sweep_views.h"

namespace light_field_depth
{
namespace
{
/// The reduced images have at least this many pixels on their longer side (if the views have them). Set by
/// hand: a coarse sweep takes a millisecond or two, and labels of the fine one are half as large.
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

/// The nearest object of a pair is often a small one, and the range of a pair is wide, so that single labels
/// of the reduced images are large: the near end is widened by this.
constexpr float PAIR_PAD_FRACTION = 0.15F;
constexpr DisparityRange NOTHING_RESOLVED = {std::numeric_limits<float>::max(),
                                             std::numeric_limits<float>::lowest()};

/// Of the windows of plane sweeps, with a pixel for the blur.
constexpr int SWEEP_WINDOW_RADIUS_PX = 3;

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
    mask_ = light_field.reference().mask;
  }

  DisparityRange find(const DisparityRangeOptions& options)
  {
    const DisparityRange bounds = sweepWithinBounds(options.max_displacement_px);
    if (farthest_ > 1.5 * nearest_)
    {
      widen(MARGIN_LABELS * step_, bounds);
      const DisparityRange wide = range_;
      sweep(Views::Farther, coarse_halvings_);
      range_ = wide;
      sweep(Views::Farther, fine_halvings_);
    }
    if (!found_)
    {
      return {0.0F, 0.0F};
    }
    const float pad_labels = options.pad_labels + (noisy_ ? PAD_LABELS_OF_NOISE : 0.0F);
    const float pad = std::max(options.pad_fraction * (range_.max - range_.min), pad_labels * step_);
    DisparityRange padded = {range_.min - pad, range_.max + pad};
    if (isPair(arms_))
    {
      padded.max = std::max(padded.max, (1.0F + PAIR_PAD_FRACTION) * range_.max);
    }
    return notBeyond(options.farthest_px, padded);
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

  static float labelStep(int halvings, double reach)
  {
    return LABEL_DISPLACEMENT / (static_cast<float>(std::ldexp(1.0, -halvings)) * static_cast<float>(reach));
  }

  PlaneSweep planSweep(Views which, int halvings) const
  {
    const auto scale = static_cast<float>(std::ldexp(1.0, -halvings));
    const bool coarse = halvings == coarse_halvings_;
    PlaneSweep plan;
    plan.reference = coarse ? small_.front().coarse : small_.front().fine;
    std::size_t next = 1;
    double reach = 0.0;
    const double most = std::max(nearest_, largestDistance(range_, LABEL_DISPLACEMENT / scale));
    for (const AxisArm& arm : arms_)
    {
      SweepArm sweep_arm;
      for (std::size_t i = 0; i < arm.size(); ++i, ++next)
      {
        const bool wanted = which == Views::Nearest ? i == 0 : i > 0 || arm.size() == 1;
        if (wanted && distanceOf(*arm[i]) <= most)
        {
          sweep_arm.push_back({coarse ? small_[next].coarse : small_[next].fine,
                               cv::Point2f(arm[i]->steps) * scale, cv::Point2f(arm[i]->offset_px) * scale});
          reach = std::max(reach, distanceOf(*arm[i]));
        }
      }
      if (!sweep_arm.empty())
      {
        plan.arms.push_back(std::move(sweep_arm));
      }
    }
    plan.disparity_step = labelStep(halvings, reach);
    const float centre = 0.5F * (range_.min + range_.max);
    const int half = static_cast<int>(std::ceil(0.5F * (range_.max - range_.min) / plan.disparity_step));
    plan.labels = 2 * half + 1;
    plan.first_disparity = centre - static_cast<float>(half) * plan.disparity_step;
    return plan;
  }

  /// The sweeps of the nearest views, and again as often as their bounds turn out to be too narrow.
  /// @return the bounds that were wide enough
  DisparityRange sweepWithinBounds(float max_displacement_px)
  {
    SearchBounds bounds(arms_, max_displacement_px, labelStep(coarse_halvings_, nearest_));
    do
    {
      forget();
    } while (!sweepNearest(bounds));
    return bounds.range();
  }

  /// Everything within the bounds, and in finer images what that left.
  /// @return false if what that found reaches the bounds, which are widened then
  bool sweepNearest(SearchBounds& bounds)
  {
    const float label_step = labelStep(coarse_halvings_, nearest_);
    range_ = bounds.range();
    sweep(Views::Nearest, coarse_halvings_);
    if (found_ && bounds.widenFor(core_, label_step))
    {
      return false;
    }
    if (found_ && fine_halvings_ < coarse_halvings_)
    {
      widen(std::max(SMALL_OBJECT_LABELS * step_, SMALL_OBJECT_FRACTION * (range_.max - range_.min)),
            bounds.range());
      sweep(Views::Nearest, fine_halvings_);
    }
    // Patches of a pair are often wrong, see stayNearCore().
    return !found_ || isPair(arms_) || !bounds.widenFor(range_, label_step);
  }

  void forget()
  {
    resolved_ = NOTHING_RESOLVED;
    found_ = false;
  }

  void widen(float margin, const DisparityRange& bounds)
  {
    range_.min = std::max(range_.min - margin, bounds.min);
    range_.max = std::min(range_.max + margin, bounds.max);
  }

  /// The range without what lies behind infinity, if only its margin does.
  DisparityRange notBeyond(const std::optional<float>& farthest, DisparityRange range) const
  {
    if (farthest && found_ && core_.min >= *farthest - step_ && range.max > *farthest + step_)
    {
      range.min = std::max(range.min, *farthest);
    }
    return range;
  }

  /// Narrows range_ to what is supported inside it.
  void sweep(Views which, int halvings)
  {
    const PlaneSweep plan = planSweep(which, halvings);
    if (plan.arms.empty())
    {
      return;
    }
    const SweepCosts volume = sweepPlanes(plan, pool_);
    std::vector<std::uint8_t> trusted =
        isPair(arms_) ? findMutualMatches(plan, volume, pool_) : std::vector<std::uint8_t>();
    distrustMasked(halvings, trusted);
    const std::optional<LabelSupport> support = findSupportedLabels(volume, pool_, trusted);
    if (!support)
    {
      return;
    }
    step_ = plan.disparity_step;
    resolved_.min = std::min(resolved_.min, plan.disparity(static_cast<float>(support->core.first) + 0.5F));
    resolved_.max = std::max(resolved_.max, plan.disparity(static_cast<float>(support->core.last) - 0.5F));
    core_ = {plan.disparity(static_cast<float>(support->core.first)),
             plan.disparity(static_cast<float>(support->core.last))};
    range_.min = std::min(resolved_.min, plan.disparity(static_cast<float>(support->all.first)));
    range_.max = std::max(resolved_.max, plan.disparity(static_cast<float>(support->all.last)));
    // The finer sweep looks only near what this left, and half as large a margin would cut off near objects.
    if (isPair(arms_) && halvings == coarse_halvings_)
    {
      stayNearCore();
    }
    found_ = true;
  }

  /// A window that sees a masked pixel says nothing.
  void distrustMasked(int halvings, std::vector<std::uint8_t>& trusted) const
  {
    if (mask_.empty())
    {
      return;
    }
    cv::Mat mask = mask_;
    for (int i = 0; i < halvings; ++i)
    {
      mask = halvedMask(mask);
    }
    const cv::Mat masked = maskedWithin(mask, SWEEP_WINDOW_RADIUS_PX);
    trusted.resize(masked.total(), 1);
    std::transform(trusted.begin(), trusted.end(), masked.ptr<std::uint8_t>(), trusted.begin(),
                   [](std::uint8_t is_trusted, std::uint8_t is_masked) -> std::uint8_t
                   { return is_masked != 0 ? 0 : is_trusted; });
  }

  /// What a single view says of small patches is often wrong where nothing contradicts it.
  void stayNearCore()
  {
    const float margin = SMALL_OBJECT_FRACTION * (core_.max - core_.min) + SMALL_OBJECT_LABELS * step_;
    range_.min = std::max(range_.min, core_.min - margin);
    range_.max = std::min(range_.max, core_.max + margin);
  }

  ThreadPool& pool_;
  std::vector<AxisArm> arms_;
  cv::Mat mask_;  ///< of the reference
  int coarse_halvings_ = 0;
  int fine_halvings_ = 0;
  double nearest_ = 0.0;
  double farthest_ = 0.0;
  std::vector<SmallView> small_;  ///< the reference, then the views of the arms in order
  DisparityRange range_;
  DisparityRange core_;  ///< the bulk of it, in the last sweep
  /// What some sweep was sure of but for its resolution: noise may hide at a fine scale what stood out at a
  /// coarse one.
  DisparityRange resolved_ = NOTHING_RESOLVED;
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
