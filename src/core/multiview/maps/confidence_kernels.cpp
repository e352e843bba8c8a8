// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/maps/confidence_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/maps/confidence_kernels.h"

#ifndef LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_CONFIDENCE_WEIGHTS
#define LIGHT_FIELD_DEPTH_CORE_MULTIVIEW_CONFIDENCE_WEIGHTS
namespace light_field_depth::multiview
{
/// Weights of the evidence against a disparity; the limits keep one piece of evidence from being everything.
constexpr float BASE = -6.9F;
constexpr float EDGE_WEIGHT = 12.0F;      // a jump in 3 x 3 pixels
constexpr float NEAR_EDGE_WEIGHT = 4.0F;  // in 5 x 5 pixels
constexpr float EDGE_FROM_PX = 0.05F;
constexpr float NEAR_EDGE_FROM_PX = 0.1F;
constexpr float EDGE_WIDTH_PX = 0.3F;
constexpr float UNCERTAINTY_WEIGHT = 20.0F;  // of 1 / sqrt(1 + weight of the data in units of LITTLE_DATA)
/// The smoothing carries far, so that a surface is known where its data weigh little; it is not where they
/// weigh next to nothing. Measured with scripts/fit_confidence.py: with 1 instead of 1/64 the area above the
/// ideal order (AUSE, BadPix 0.07) is 0.182 instead of 0.179 on the demo and twice as large on clean renders.
constexpr float LITTLE_DATA = 1.0F / 64.0F;
constexpr float DISAGREEMENT_WEIGHT = 25.0F;
constexpr float DISAGREEMENT_LIMIT_PX = 0.3F;
constexpr float PULL_WEIGHT = 18.0F;  // from the views' minimum to the smooth surface
constexpr float PULL_LIMIT_PX = 0.15F;
constexpr float MOVE_WEIGHT = 27.0F;  // by the refinement
constexpr float MOVE_LIMIT_PX = 0.3F;
constexpr float CHANGE_WEIGHT = 6.4F;  // from the first search to the second
constexpr float CHANGE_LIMIT_PX = 0.3F;
constexpr float RESIDUAL_WEIGHT = 0.1F;
constexpr float RESIDUAL_FREE = 15.0F;      // sum of three channels
constexpr float RESIDUAL_PER_NOISE = 4.0F;  // of a difference of two noisy pixels, three channels
}  // namespace light_field_depth::multiview
#endif

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

void weighEvidenceSimd(const EvidenceRow& row, float* against)
{
  forPixels(
      0, row.width,
      [&](auto f, int x)
      {
        const auto at = [&](const float* values) { return hn::LoadU(f, values + x); };
        const auto set = [&](float value) { return hn::Set(f, value); };
        const auto ramp = [&](auto value, float from)
        {
          const auto share = hn::Div(hn::Sub(value, set(from)), set(EDGE_WIDTH_PX));
          return hn::Min(hn::Max(share, set(0.0F)), set(1.0F));
        };
        auto sum = set(BASE);
        const auto add = [&](float weight, auto value) { sum = hn::Add(sum, hn::Mul(set(weight), value)); };
        add(EDGE_WEIGHT, ramp(hn::Sub(at(row.high), at(row.low)), EDGE_FROM_PX));
        add(NEAR_EDGE_WEIGHT, ramp(hn::Sub(at(row.wide_high), at(row.wide_low)), NEAR_EDGE_FROM_PX));
        const auto precision = hn::Sqrt(hn::Add(hn::Mul(at(row.weight), set(1.0F / LITTLE_DATA)), set(1.0F)));
        sum = hn::Add(sum, hn::Div(set(UNCERTAINTY_WEIGHT), precision));
        const auto distance = [&](const float* one, const float* other, float limit)
        { return hn::Min(hn::Abs(hn::Sub(at(one), at(other))), set(limit)); };
        add(DISAGREEMENT_WEIGHT, hn::Min(at(row.disagreement), set(DISAGREEMENT_LIMIT_PX)));
        add(PULL_WEIGHT, distance(row.target, row.disparity, PULL_LIMIT_PX));
        add(MOVE_WEIGHT, distance(row.searched, row.disparity, MOVE_LIMIT_PX));
        add(CHANGE_WEIGHT, distance(row.first_search, row.searched, CHANGE_LIMIT_PX));
        const auto unexplained =
            hn::Sub(hn::Sub(at(row.residual), set(RESIDUAL_FREE)), set(RESIDUAL_PER_NOISE * row.noise_sigma));
        add(RESIDUAL_WEIGHT, hn::Max(set(0.0F), unexplained));
        hn::StoreU(sum, f, against + x);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(weighEvidenceSimd);

namespace
{
float ramp(float value, float from, float width)
{
  return std::clamp((value - from) / width, 0.0F, 1.0F);
}

}  // namespace

void weighEvidence(const EvidenceRow& row, float* against)
{
  HWY_DYNAMIC_DISPATCH(weighEvidenceSimd)(row, against);
}

void weighEvidencePlain(const EvidenceRow& row, float* against)
{
  for (int x = 0; x < row.width; ++x)
  {
    const float pull = std::abs(row.target[x] - row.disparity[x]);
    const float move = std::abs(row.searched[x] - row.disparity[x]);
    const float change = std::abs(row.first_search[x] - row.searched[x]);
    const float unexplained = row.residual[x] - RESIDUAL_FREE - RESIDUAL_PER_NOISE * row.noise_sigma;
    against[x] =
        BASE + EDGE_WEIGHT * ramp(row.high[x] - row.low[x], EDGE_FROM_PX, EDGE_WIDTH_PX) +
        NEAR_EDGE_WEIGHT * ramp(row.wide_high[x] - row.wide_low[x], NEAR_EDGE_FROM_PX, EDGE_WIDTH_PX) +
        UNCERTAINTY_WEIGHT / std::sqrt(row.weight[x] * (1.0F / LITTLE_DATA) + 1.0F) +
        DISAGREEMENT_WEIGHT * std::min(row.disagreement[x], DISAGREEMENT_LIMIT_PX) +
        PULL_WEIGHT * std::min(pull, PULL_LIMIT_PX) + MOVE_WEIGHT * std::min(move, MOVE_LIMIT_PX) +
        CHANGE_WEIGHT * std::min(change, CHANGE_LIMIT_PX) + RESIDUAL_WEIGHT * std::max(0.0F, unexplained);
  }
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
