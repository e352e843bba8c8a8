// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/maps/confidence_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/base/pixel_loops-inl.h"
#include "core/multiview/maps/confidence_kernels.h"
#include "core/multiview/maps/confidence_weights.h"

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

void weighEvidence(const EvidenceRow& row, float* against)
{
  HWY_DYNAMIC_DISPATCH(weighEvidenceSimd)(row, against);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
