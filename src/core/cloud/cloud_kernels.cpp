// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cloud/cloud_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "core/base/vector_loops-inl.h"
#include "core/cloud/cloud_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::cloud
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using light_field_depth::HWY_NAMESPACE::forElements;

template <class F>
using Vec = hn::Vec<F>;

/// compression() of a vector.
template <class F>
HWY_INLINE Vec<F> compressionOf(F f, Vec<F> slope_x, Vec<F> slope_y, float steps_x, float steps_y)
{
  return hn::Sub(hn::Sub(hn::Set(f, 1.0F), hn::Mul(slope_x, hn::Set(f, steps_x))),
                 hn::Mul(slope_y, hn::Set(f, steps_y)));
}

/// x, x + 1, ...
template <class F>
HWY_INLINE Vec<F> columnsFrom(F f, int x)
{
  const hn::RebindToSigned<F> i;
  return hn::ConvertTo(f, hn::Iota(i, static_cast<std::int32_t>(x)));
}

void projectRowSimd(const ProjectedRow& row)
{
  forElements<float>(
      0, row.width,
      [&](auto f, int x)
      {
        const hn::RebindToSigned<decltype(f)> i;
        const auto zero = hn::Zero(f);
        const auto half = hn::Set(f, 0.5F);
        const auto d = hn::LoadU(f, row.disparity + x);
        const auto at_x =
            hn::Sub(hn::Add(columnsFrom(f, x), hn::Set(f, row.begin_x)), hn::Mul(d, hn::Set(f, row.steps_x)));
        const auto at_y = hn::Sub(hn::Set(f, row.begin_y), hn::Mul(d, hn::Set(f, row.steps_y)));
        const auto in_x =
            hn::And(hn::Ge(at_x, zero), hn::Lt(at_x, hn::Set(f, static_cast<float>(row.width))));
        const auto in_y =
            hn::And(hn::Ge(at_y, zero), hn::Lt(at_y, hn::Set(f, static_cast<float>(row.height))));
        const auto part = hn::And(in_x, in_y);
        const auto column = hn::ConvertTo(i, hn::IfThenElseZero(part, at_x));
        const auto line = hn::ConvertTo(i, hn::IfThenElseZero(part, at_y));
        const auto gap_x = hn::Sub(hn::Add(hn::ConvertTo(f, column), half), at_x);
        const auto gap_y = hn::Sub(hn::Add(hn::ConvertTo(f, line), half), at_y);
        const auto slope_x = hn::LoadU(f, row.slope_x + x);
        const auto slope_y = hn::LoadU(f, row.slope_y + x);
        const auto squeeze = compressionOf(f, slope_x, slope_y, row.steps_x, row.steps_y);
        const auto rise = hn::Add(hn::Mul(gap_x, slope_x), hn::Mul(gap_y, slope_y));
        const auto seen = hn::Gt(squeeze, hn::Set(f, MIN_COMPRESSION));
        const auto ring_line = hn::And(line, hn::Set(i, row.row_mask));
        const auto target = hn::Add(hn::Mul(ring_line, hn::Set(i, row.width)), column);
        hn::StoreU(hn::IfThenElse(hn::RebindMask(i, part), target, hn::Set(i, -1)), i, row.target + x);
        hn::StoreU(hn::IfThenElse(seen, hn::Add(d, hn::Div(rise, squeeze)), d), f, row.there + x);
      });
}

void agreeInRowSimd(const AgreedRow& row)
{
  forElements<float>(
      0, row.width,
      [&](auto f, int x)
      {
        const hn::RebindToSigned<decltype(f)> i;
        const hn::Rebind<std::uint8_t, decltype(f)> bytes;
        auto lowest = hn::Set(f, std::numeric_limits<float>::infinity());
        auto highest = hn::Neg(lowest);
        auto sources = hn::LoadU(i, row.maps[0].source + x);
        for (int m = 0; m < row.count; ++m)
        {
          const auto disparity = hn::LoadU(f, row.maps[m].disparity + x);
          lowest = hn::Min(lowest, disparity);
          highest = hn::Max(highest, disparity);
          sources = hn::Min(sources, hn::LoadU(i, row.maps[m].source + x));
        }
        const auto gap =
            hn::Max(hn::Mul(hn::Set(f, row.same_surface), hn::Add(lowest, hn::Set(f, row.offset_px))),
                    hn::Set(f, row.floor_px));
        const auto all = hn::RebindMask(f, hn::Gt(sources, hn::Set(i, -1)));
        const auto agreed = hn::And(all, hn::Le(hn::Sub(highest, lowest), gap));
        const auto ones = hn::IfThenElseZero(hn::RebindMask(i, agreed), hn::Set(i, 1));
        hn::StoreU(hn::DemoteTo(bytes, row.count == 1 ? hn::Set(i, 1) : ones), bytes, row.done + x);
        const auto unknown = hn::Set(f, std::numeric_limits<float>::quiet_NaN());
        if (hn::AllFalse(f, agreed))
        {
          hn::StoreU(unknown, f, row.disparity + x);
          return;
        }
        const auto first = hn::LoadU(f, row.maps[0].disparity + x);
        auto rise = hn::Zero(f);
        auto trust = hn::Zero(f);
        auto weight = hn::Zero(f);
        auto last = hn::Zero(f);
        auto heaviest = hn::Set(f, -1.0F);
        auto sure = hn::Lt(heaviest, heaviest);
        auto best = hn::Zero(i);
        for (int m = 0; m < row.count; ++m)
        {
          const MapOfRow& map = row.maps[m];
          const auto source = hn::Max(hn::LoadU(i, map.source + x), hn::Zero(i));
          const auto confidence = hn::GatherIndex(f, map.confidence, source);
          const auto of_map =
              hn::Mul(hn::Add(hn::Set(f, row.least_weight), confidence), hn::Set(f, map.nearness));
          rise = hn::Add(rise, hn::Mul(of_map, hn::Sub(hn::LoadU(f, map.disparity + x), first)));
          trust = hn::Add(trust, hn::Mul(of_map, confidence));
          weight = hn::Add(weight, of_map);
          last = confidence;
          if (map.nearness >= row.nearest)
          {
            sure = hn::Or(sure, hn::Ge(confidence, hn::Set(f, row.min_confidence)));
          }
          const auto heavier = hn::Gt(of_map, heaviest);
          heaviest = hn::Max(heaviest, of_map);
          best = hn::IfThenElse(hn::RebindMask(i, heavier), hn::Set(i, m), best);
        }
        const auto kept = hn::And(agreed, hn::Or(sure, hn::Ge(weight, hn::Set(f, row.min_weight))));
        const auto one = hn::Set(f, 1.0F);
        const auto scale = hn::Div(one, weight);
        hn::StoreU(hn::IfThenElse(kept, hn::Add(first, hn::Mul(rise, scale)), unknown), f, row.disparity + x);
        hn::StoreU(row.count == 1 ? last : hn::Mul(trust, scale), f, row.confidence + x);
        auto slope_x = hn::Zero(f);
        auto slope_y = hn::Zero(f);
        for (int m = 0; m < row.count; ++m)
        {
          const auto from_here = hn::And(kept, hn::RebindMask(f, hn::Eq(best, hn::Set(i, m))));
          if (!hn::AllFalse(f, from_here))
          {
            const MapOfRow& map = row.maps[m];
            const auto source = hn::Max(hn::LoadU(i, map.source + x), hn::Zero(i));
            const auto map_x = hn::GatherIndex(f, map.slope_x, source);
            const auto map_y = hn::GatherIndex(f, map.slope_y, source);
            const auto squeeze = compressionOf(f, map_x, map_y, map.steps_x, map.steps_y);
            const auto stretch =
                hn::IfThenElse(hn::Gt(squeeze, hn::Set(f, MIN_COMPRESSION)), hn::Div(one, squeeze), one);
            slope_x = hn::IfThenElse(from_here, hn::Mul(map_x, stretch), slope_x);
            slope_y = hn::IfThenElse(from_here, hn::Mul(map_y, stretch), slope_y);
          }
        }
        hn::StoreU(slope_x, f, row.slope_x + x);
        hn::StoreU(slope_y, f, row.slope_y + x);
      });
}

void unprojectRowSimd(const UnprojectedRow& row)
{
  const float ray_step = 1.0F / row.focal_length_px;
  forElements<float>(
      0, row.width,
      [&](auto f, int x)
      {
        const auto absolute = hn::Add(hn::LoadU(f, row.disparity + x), hn::Set(f, row.offset_px));
        const auto z = hn::Div(hn::Set(f, row.focal_times_baseline), absolute);
        const auto valid =
            hn::And(hn::Gt(absolute, hn::Zero(f)), hn::Le(z, hn::Set(f, std::numeric_limits<float>::max())));
        const auto slope_x = hn::LoadU(f, row.slope_x + x);
        const auto slope_y = hn::LoadU(f, row.slope_y + x);
        const auto column = hn::Sub(columnsFrom(f, x), hn::Set(f, row.principal_x_px));
        const auto at_centre =
            hn::Sub(hn::Sub(absolute, hn::Mul(slope_x, column)), hn::Mul(slope_y, hn::Set(f, row.row_px)));
        const auto normal_x = hn::Mul(hn::Set(f, row.focal_length_px), slope_x);
        const auto normal_y = hn::Mul(hn::Set(f, row.focal_length_px), slope_y);
        const auto square = hn::Add(hn::Add(hn::Mul(normal_x, normal_x), hn::Mul(normal_y, normal_y)),
                                    hn::Mul(at_centre, at_centre));
        const auto scale = hn::Div(hn::Set(f, -1.0F), hn::Sqrt(square));
        const auto to_x =
            hn::Add(hn::Set(f, row.centre_x_m), hn::Mul(hn::Mul(column, hn::Set(f, ray_step)), z));
        const auto to_y = hn::Add(hn::Set(f, row.centre_y_m), hn::Mul(hn::Set(f, row.row_px * ray_step), z));
        const hn::RebindToUnsigned<decltype(f)> u;
        hn::StoreInterleaved4(to_x, to_y, hn::IfThenElseZero(valid, z), hn::Mul(scale, normal_x), f,
                              row.place + 4 * x);
        hn::StoreInterleaved4(hn::Mul(scale, normal_y), hn::Mul(scale, at_centre),
                              hn::BitCast(f, hn::LoadU(u, row.colour + x)), hn::LoadU(f, row.confidence + x),
                              f, row.look + 4 * x);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::cloud
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::cloud
{
HWY_EXPORT(projectRowSimd);
HWY_EXPORT(agreeInRowSimd);
HWY_EXPORT(unprojectRowSimd);

void projectRow(const ProjectedRow& row)
{
  HWY_DYNAMIC_DISPATCH(projectRowSimd)(row);
}

void agreeInRow(const AgreedRow& row)
{
  HWY_DYNAMIC_DISPATCH(agreeInRowSimd)(row);
}

void unprojectRow(const UnprojectedRow& row)
{
  HWY_DYNAMIC_DISPATCH(unprojectRowSimd)(row);
}

}  // namespace light_field_depth::cloud
#endif  // HWY_ONCE
