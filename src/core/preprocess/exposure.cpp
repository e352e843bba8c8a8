#include "light_field_depth/core/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "core/preprocess/exposure_fit.h"
#include "core/preprocess/exposure_views.h"
#include "core/preprocess/label_support.h"
#include "core/preprocess/mutual_matches.h"
#include "core/preprocess/plane_sweep.h"
#include "core/preprocess/search_bounds.h"
#include "core/preprocess/sweep_views.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
/// The reduced views have at least this many pixels on their longer side (if the views have them).
constexpr int SMALL_SIDE_PX = 96;
/// The windows of smaller views are too few.
constexpr int MIN_SIDE_PX = 32;
/// Spacing of the labels, in pixels of the reduced views, in the farthest view.
constexpr float LABEL_DISPLACEMENT = 0.5F;
/// More pairs of a view cost time only.
constexpr std::size_t MAX_PAIRS = 1000;

/// A pixel of the reduced reference and its disparity.
struct Match
{
  cv::Point pixel;
  float disparity;
};

class ExposureFinder
{
public:
  ExposureFinder(const LightField& light_field, ThreadPool& pool, float max_displacement_px)
      : light_field_(light_field), pool_(pool), max_displacement_px_(max_displacement_px),
        arms_(axisArmsOf(light_field)), halvings_(halvingsFor(light_field.size(), SMALL_SIDE_PX)),
        scale_(static_cast<float>(std::ldexp(1.0, -halvings_))), small_(light_field.views.size()),
        cut_off_(light_field.views.size()), normalized_(light_field.views.size())
  {
    forEachView([&](std::size_t i) { small_[i] = halve(light_field_.views[i].image, halvings_); });
    forEachView(
        [&](std::size_t i)
        {
          if (takesPart(i))
          {
            normalized_[i] = normalizeLocally(toGrey(small_[i]));
          }
          cut_off_[i] = cutOffValues(small_[i]);
          small_[i] = lowPass(small_[i]);
        });
  }

  std::vector<ViewExposure> find()
  {
    const std::vector<Match> matches = findMatches();
    const ExposureModel model = isPair(arms_) ? ExposureModel::Curve : ExposureModel::Line;
    std::vector<ViewExposure> exposures(small_.size());
    forEachView(
        [&](std::size_t i)
        {
          if (i != light_field_.reference_index)
          {
            exposures[i] = fitExposure(collectPairs(i, matches), small_[i].channels(), model);
          }
        });
    return exposures;
  }

private:
  void forEachView(const std::function<void(std::size_t)>& body)
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

  /// In the sweeps.
  bool takesPart(std::size_t index) const
  {
    const View* const view = &light_field_.views[index];
    return index == light_field_.reference_index ||
           std::any_of(arms_.begin(), arms_.end(),
                       [&](const AxisArm& arm)
                       { return std::find(arm.begin(), arm.end(), view) != arm.end(); });
  }

  SweepView sweepView(const View& view) const
  {
    const auto index = static_cast<std::size_t>(&view - light_field_.views.data());
    return {normalized_[index], cv::Point2f(view.steps) * scale_, cv::Point2f(view.offset_px) * scale_};
  }

  float labelStep(double reach) const { return LABEL_DISPLACEMENT / (scale_ * static_cast<float>(reach)); }

  PlaneSweep planSweep(const DisparityRange& range, double reach) const
  {
    PlaneSweep plan;
    plan.reference = normalized_[light_field_.reference_index];
    plan.disparity_step = labelStep(reach);
    plan.first_disparity = range.min;
    plan.labels = 1 + static_cast<int>(std::ceil((range.max - range.min) / plan.disparity_step));
    return plan;
  }

  /// What the nearest views say.
  struct NearSweep
  {
    PlaneSweep plan;
    SweepCosts volume;
    std::vector<std::uint8_t> trusted;  ///< see findSupportedLabels()
    std::optional<LabelSupport> support;

    DisparityRange supported() const
    {
      return {plan.disparity(static_cast<float>(support->core.first)),
              plan.disparity(static_cast<float>(support->core.last))};
    }
  };

  NearSweep sweepNearest(const DisparityRange& range, double nearest) const
  {
    NearSweep sweep;
    sweep.plan = planSweep(range, nearest);
    for (const AxisArm& arm : arms_)
    {
      sweep.plan.arms.push_back({sweepView(*arm.front())});
    }
    sweep.volume = sweepPlanes(sweep.plan, pool_);
    if (isPair(arms_))
    {
      sweep.trusted = findMutualMatches(sweep.plan, sweep.volume, pool_);
    }
    sweep.support = findSupportedLabels(sweep.volume, pool_, sweep.trusted);
    return sweep;
  }

  std::vector<Match> findMatches() const
  {
    const double nearest = nearestDistance(arms_);
    SearchBounds bounds(arms_, max_displacement_px_, labelStep(nearest));
    NearSweep sweep = sweepNearest(bounds.range(), nearest);
    while (sweep.support && bounds.widenFor(sweep.supported(), sweep.plan.disparity_step))
    {
      sweep = sweepNearest(bounds.range(), nearest);
    }
    const std::optional<LabelSupport>& support = sweep.support;
    const double farthest = farthestDistance(arms_);
    if (!support || farthest < 1.5 * nearest)
    {
      return likelyMatches(sweep.plan, sweep.volume, sweep.trusted);
    }
    const DisparityRange range = {sweep.plan.disparity(static_cast<float>(support->core.first) - 1.0F),
                                  sweep.plan.disparity(static_cast<float>(support->core.last) + 1.0F)};
    const double most = std::max(nearest, largestDistance(range, LABEL_DISPLACEMENT / scale_));
    PlaneSweep plan = planSweep(range, std::min(farthest, most));
    for (const AxisArm& arm : arms_)
    {
      SweepArm sweep_arm;
      for (const View* view : arm)
      {
        if (distanceOf(*view) <= most)
        {
          sweep_arm.push_back(sweepView(*view));
        }
      }
      if (!sweep_arm.empty())
      {
        plan.arms.push_back(std::move(sweep_arm));
      }
    }
    return likelyMatches(plan, sweepPlanes(plan, pool_));
  }

  std::vector<Match> likelyMatches(const PlaneSweep& plan, const SweepCosts& volume,
                                   const std::vector<std::uint8_t>& trusted = {}) const
  {
    const std::vector<float> labels = findLikelyLabels(volume, pool_, trusted);
    std::vector<Match> matches;
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      if (!std::isnan(labels[i]))
      {
        const int width = plan.reference.cols;
        matches.push_back(
            {cv::Point(static_cast<int>(i) % width, static_cast<int>(i) / width), plan.disparity(labels[i])});
      }
    }
    return matches;
  }

  std::vector<BrightnessPair> collectPairs(std::size_t index, const std::vector<Match>& matches) const
  {
    const View& view = light_field_.views[index];
    const cv::Mat& reference = small_[light_field_.reference_index];
    const cv::Mat& other = small_[index];
    const std::size_t stride = 1 + matches.size() / MAX_PAIRS;
    const cv::Rect inside(cv::Point(), other.size());
    const cv::Point2f middle(0.5F * static_cast<float>(other.cols - 1),
                             0.5F * static_cast<float>(other.rows - 1));
    const auto half_diagonal =
        0.5F * std::hypot(static_cast<float>(other.cols), static_cast<float>(other.rows));
    std::vector<BrightnessPair> pairs;
    pairs.reserve(matches.size() / stride + 1);
    for (std::size_t i = 0; i < matches.size(); i += stride)
    {
      const cv::Point2f seen = cv::Point2f(matches[i].pixel) +
                               scale_ * cv::Point2f(view.offset_px - matches[i].disparity * view.steps);
      const cv::Point nearest(cvRound(seen.x), cvRound(seen.y));
      if (inside.contains(nearest) && isExposed(index, nearest) &&
          isExposed(light_field_.reference_index, matches[i].pixel))
      {
        const cv::Point2f place = (seen - middle) / half_diagonal;
        pairs.push_back({valueAt(reference, matches[i].pixel), valueAt(other, nearest), place});
      }
    }
    return pairs;
  }

  /// Whether nothing near the pixel was cut off at black or white.
  bool isExposed(std::size_t index, const cv::Point& pixel) const
  {
    const cv::Mat& cut_off = cut_off_[index];
    return cut_off.channels() == 3 ? cut_off.at<cv::Vec3b>(pixel) == cv::Vec3b()
                                   : cut_off.at<std::uint8_t>(pixel) == 0;
  }

  static cv::Vec3f valueAt(const cv::Mat& image, const cv::Point& pixel)
  {
    return image.channels() == 3 ? cv::Vec3f(image.at<cv::Vec3b>(pixel))
                                 : cv::Vec3f::all(image.at<std::uint8_t>(pixel));
  }

  const LightField& light_field_;
  ThreadPool& pool_;
  float max_displacement_px_;
  std::vector<AxisArm> arms_;
  int halvings_;
  float scale_;                      ///< of the reduced views
  std::vector<cv::Mat> small_;       ///< all views, reduced and smoothed, in colour
  std::vector<cv::Mat> cut_off_;     ///< values of all views near black or white
  std::vector<cv::Mat> normalized_;  ///< of the views that take part in the sweeps
};

}  // namespace

std::vector<ViewExposure> estimateExposure(const LightField& light_field, ThreadPool& pool,
                                           float max_displacement_px)
{
  if (light_field.reference().image.depth() != CV_8U)
  {
    throw InputError("Exposure is estimated from 8-bit views; convert the light field first.");
  }
  if (std::min(light_field.size().width, light_field.size().height) < MIN_SIDE_PX)
  {
    return std::vector<ViewExposure>(light_field.views.size());
  }
  return ExposureFinder(light_field, pool, max_displacement_px).find();
}

}  // namespace light_field_depth
