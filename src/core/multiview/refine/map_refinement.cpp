#include "core/multiview/refine/map_refinement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/multiview/refine/known_around.h"

namespace light_field_depth::multiview
{
namespace
{
/// How far a refined disparity may lie outside the range of the search, in pixels: slopes of surfaces at the
/// end of the range go on.
constexpr float REACH_PX = 1.0F;
/// How far rows and columns may place pixels apart (median, px) before less is believed: clean renders 0.003
/// to 0.005, plenoptic captures 0.005 to 0.008, arrays 0.018. Noise of the values explains more of it. Twice
/// as little helps captures and costs noisy renders; docs/experiments.md.
constexpr float EXPLAINED_DISAGREEMENT_PX = 0.003F;
/// With a tenth soft edges, as cameras see them, are off by 0.07 px on 15 instead of 12 % of the pixels, with
/// a quarter the demo's cloud of five maps has 0.12 instead of 0.07 % of flying points.
constexpr float LEAST_BELIEVED = 0.5F;
constexpr float TINY_SQUARE = 1e-12F;
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;

/// Where nothing is known and the image cuts a line of pixels off from the others, the equations of the
/// smoothing are singular but for rounding: what leaves the range of the search, or is no number, is as it
/// was at the start.
void keepInRange(const DisparityRange& range, const cv::Mat& start, ThreadPool& pool, cv::Mat& disparity)
{
  const float low = range.min - REACH_PX;
  const float high = range.max + REACH_PX;
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       auto* const row = disparity.ptr<float>(y);
                       const auto* const at_start = start.ptr<float>(y);
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const bool kept = row[x] >= low && row[x] <= high;
                         row[x] = kept ? row[x] : at_start[x];
                       }
                     }
                   });
}

/// The part of the most that a pixel may weigh, from how far rows and columns place well-textured pixels
/// apart. What they get wrong for themselves, by their sampling, demosaicing or places, no window averages
/// away.
/// @param growth of what is explained, by noise of the values
float believed(const Linearization& linearization, float growth)
{
  constexpr int stride_px = 4;
  const float textured = SlopeSettings().full_weight;
  std::vector<float> disagreements;
  for (int y = 0; y < linearization.weight.rows; y += stride_px)
  {
    const auto* const weight = linearization.weight.ptr<float>(y);
    const auto* const disagreement = linearization.disagreement.ptr<float>(y);
    for (int x = 0; x < linearization.weight.cols; x += stride_px)
    {
      if (weight[x] > textured)
      {
        disagreements.push_back(std::abs(disagreement[x]));
      }
    }
  }
  if (disagreements.empty())
  {
    return 1.0F;
  }
  const auto middle = disagreements.begin() + static_cast<std::ptrdiff_t>(disagreements.size() / 2);
  std::nth_element(disagreements.begin(), middle, disagreements.end());
  const float explained = EXPLAINED_DISAGREEMENT_PX * EXPLAINED_DISAGREEMENT_PX * growth;
  return std::clamp(explained / std::max(*middle * *middle, TINY_SQUARE), LEAST_BELIEVED, 1.0F);
}

}  // namespace

void MapRefinement::run(const RefinementInput& input, const RefinementSettings& settings,
                        const cv::Mat& start, RunContext& context, cv::Mat& disparity)
{
  start.copyTo(disparity);
  {
    const StageTimer timer(context, "noise");
    measureViewNoise(input.views, disparity, context.pool, noise_);
  }
  const float more = 1.0F + settings.strength_per_variance * noise_.value_variance;
  if (settings.refinements == 0)
  {
    linearize(input, settings.linearization, settings.noise_discount, more, context, disparity);
    return;
  }
  SmoothingSettings smoothing = settings.smoothing;
  smoothing.strength *= more;
  NoiseDiscountSettings discount = settings.noise_discount;
  discount.max_weight *= more;
  {
    const StageTimer timer(context, "smooth");
    smoother_.setGuide(input.guide, smoothing, context.pool);
  }
  for (int i = 1; i <= settings.refinements; ++i)
  {
    const bool is_last = i == settings.refinements;
    LinearizationSettings linearization = settings.linearization;
    linearization.one_channel =
        i == 1 && !is_last && noise_.value_variance <= settings.one_channel_max_variance;
    linearize(input, linearization, discount, more, context, disparity);
    const StageTimer timer(context, "smooth");
    if (i == 1)
    {
      bringToKnownAround(linearization_.weight, context.pool, disparity);
    }
    smoothing.follow_slopes = is_last;
    smoother_.run(linearization_.weight, linearization_.target, smoothing, context.pool, disparity);
    keepInRange(input.range, start, context.pool, disparity);
  }
}

void MapRefinement::linearize(const RefinementInput& input, const LinearizationSettings& settings,
                              const NoiseDiscountSettings& discount, float growth, RunContext& context,
                              const cv::Mat& disparity)
{
  const StageTimer timer(context, "linearize");
  linearizer_.run(input.views, disparity, noise_.local_slope_variance, settings, context.pool,
                  linearization_);
  NoiseDiscountSettings limited = discount;
  limited.max_weight *= believed(linearization_, growth);
  discount_.apply(limited, context.pool, linearization_);
}

}  // namespace light_field_depth::multiview
