#include "core/multiview/refine/map_refinement.h"

namespace light_field_depth::multiview
{
namespace
{
/// How far a refined disparity may lie outside the range of the search, in pixels: slopes of surfaces at the
/// end of the range go on.
constexpr float REACH_PX = 1.0F;
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

}  // namespace

void MapRefinement::run(const RefinementInput& input, const RefinementSettings& settings,
                        const cv::Mat& start, RunContext& context, cv::Mat& disparity)
{
  start.copyTo(disparity);
  {
    const StageTimer timer(context, "noise");
    measureViewNoise(input.views, disparity, context.pool, noise_);
  }
  if (settings.refinements == 0)
  {
    linearize(input, settings.linearization, settings.noise_discount, context, disparity);
    return;
  }
  SmoothingSettings smoothing = settings.smoothing;
  const float more = 1.0F + settings.strength_per_variance * noise_.value_variance;
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
    linearize(input, linearization, discount, context, disparity);
    const StageTimer timer(context, "smooth");
    smoothing.follow_slopes = is_last;
    smoother_.run(linearization_.weight, linearization_.target, smoothing, context.pool, disparity);
    keepInRange(input.range, start, context.pool, disparity);
  }
}

void MapRefinement::linearize(const RefinementInput& input, const LinearizationSettings& settings,
                              const NoiseDiscountSettings& discount, RunContext& context,
                              const cv::Mat& disparity)
{
  const StageTimer timer(context, "linearize");
  linearizer_.run(input.views, disparity, noise_.local_slope_variance, settings, context.pool,
                  linearization_);
  discount_.apply(discount, context.pool, linearization_);
}

}  // namespace light_field_depth::multiview
