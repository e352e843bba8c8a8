// Compiled once for each instruction set; the best one is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/multiview/refine/normal_equation_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/multiview/refine/linearize_kernels.h"
#include "core/multiview/refine/normal_equation_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace light_field_depth::multiview
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 16>;

// Where vectors are not spelt out, the compiler turns plain loops into those of each instruction set.

HWY_INLINE float smaller(float a, float b)
{
  return b < a ? b : a;
}

HWY_INLINE int clampedColumn(int x, int width)
{
  return x < 0 ? 0 : x >= width ? width - 1 : x;
}

void sumRowsSimd(const float* const* HWY_RESTRICT rows, int row_count, std::size_t count,
                 float* HWY_RESTRICT sums)
{
  const Floats f;
  const std::size_t lanes = hn::Lanes(f);
  std::size_t i = 0;
  for (; i + 2 * lanes <= count; i += 2 * lanes)
  {
    auto low = hn::LoadU(f, rows[0] + i);
    auto high = hn::LoadU(f, rows[0] + i + lanes);
    for (int row = 1; row < row_count; ++row)
    {
      low = hn::Add(low, hn::LoadU(f, rows[row] + i));
      high = hn::Add(high, hn::LoadU(f, rows[row] + i + lanes));
    }
    hn::StoreU(low, f, sums + i);
    hn::StoreU(high, f, sums + i + lanes);
  }
  for (; i < count; ++i)
  {
    float sum = rows[0][i];
    for (int row = 1; row < row_count; ++row)
    {
      sum += rows[row][i];
    }
    sums[i] = sum;
  }
}

HWY_INLINE float clampedSum(const float* in, int width, int radius, int x)
{
  float sum = 0.0F;
  for (int dx = -radius; dx <= radius; ++dx)
  {
    sum += in[clampedColumn(x + dx, width)];
  }
  return sum;
}

void boxRowSimd(const float* HWY_RESTRICT in, int width, int radius, float* HWY_RESTRICT out)
{
  const int edge = radius < width - radius ? radius : width;
  for (int x = 0; x < edge; ++x)
  {
    out[x] = clampedSum(in, width, radius, x);
    out[width - 1 - x] = clampedSum(in, width, radius, width - 1 - x);
  }
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(f));
  int x = edge;
  for (; x + lanes <= width - edge; x += lanes)
  {
    auto sum = hn::LoadU(f, in + x - radius);
    for (int dx = 1 - radius; dx <= radius; ++dx)
    {
      sum = hn::Add(sum, hn::LoadU(f, in + x + dx));
    }
    hn::StoreU(sum, f, out + x);
  }
  for (; x < width - edge; ++x)
  {
    out[x] = clampedSum(in, width, radius, x);
  }
}

void scaleAndLowerSimd(float factor, float offset, int width, float* HWY_RESTRICT values,
                       float* HWY_RESTRICT lowest)
{
  for (int x = 0; x < width; ++x)
  {
    const float value = values[x] * factor + offset;
    values[x] = value;
    lowest[x] = smaller(lowest[x], value);
  }
}

void shareOfArmSimd(const float* HWY_RESTRICT lowest, int width, float* HWY_RESTRICT values)
{
  for (int x = 0; x < width; ++x)
  {
    const float ratio = lowest[x] / values[x];
    const float square = ratio * ratio;
    values[x] = square * square;
  }
}

/// By one axis: the weights of the differences of the neighbours one and two pixels away.
void differentiateAlong(const float* HWY_RESTRICT before2, const float* HWY_RESTRICT before,
                        const float* HWY_RESTRICT after, const float* HWY_RESTRICT after2, int width,
                        float* HWY_RESTRICT derivative)
{
  // Fourth-order central difference: exact for polynomials of degree four.
  constexpr float near_tap = 8.0F / 12.0F;
  constexpr float far_tap = 1.0F / 12.0F;
  for (int x = 0; x < width; ++x)
  {
    derivative[x] = near_tap * (after[x] - before[x]) - far_tap * (after2[x] - before2[x]);
  }
}

void differentiateSimd(const DerivativeRow& row)
{
  const float* const here = row.rows[2];
  differentiateAlong(here - 2, here - 1, here + 1, here + 2, row.width, row.along_x);
  differentiateAlong(row.rows[0], row.rows[1], row.rows[3], row.rows[4], row.width, row.along_y);
}

/// One channel of a ray; everything in registers or behind pointers of its own, or it is not vectorised.
void addRayChannel(const float* HWY_RESTRICT share, const float* HWY_RESTRICT moment_kk,
                   const float* HWY_RESTRICT moment_kr, const float* HWY_RESTRICT along_x,
                   const float* HWY_RESTRICT along_y, float direction_x, float direction_y, int width,
                   float* HWY_RESTRICT gg, float* HWY_RESTRICT gr, float* HWY_RESTRICT sum_kg,
                   float* HWY_RESTRICT sum_kr)
{
  for (int x = 0; x < width; ++x)
  {
    const float slope = direction_x * along_x[x] + direction_y * along_y[x];
    const float kg = share[x] * moment_kk[x] * slope;
    const float kr = share[x] * moment_kr[x];
    gg[x] += kg * slope;
    gr[x] -= kr * slope;
    sum_kg[x] -= kg;
    sum_kr[x] += kr;
  }
}

void addProduct(const float* HWY_RESTRICT a, const float* HWY_RESTRICT b, int width, float* HWY_RESTRICT sum)
{
  for (int x = 0; x < width; ++x)
  {
    sum[x] += a[x] * b[x];
  }
}

void addRaySimd(const RayRow& ray, float* pair)
{
  const std::size_t stride = ray.stride;
  const float* const moment_kk = ray.moments + RAY_KK * stride;
  addProduct(ray.share, moment_kk, ray.width, pair + MOMENT_KK * stride);
  for (int c = 0; c < ray.channels; ++c)
  {
    const std::size_t channel = static_cast<std::size_t>(c) * stride;
    addRayChannel(ray.share, moment_kk, ray.moments + RAY_KR * stride + channel, ray.along_x + channel,
                  ray.along_y + channel, ray.direction_x, ray.direction_y, ray.width,
                  pair + MOMENT_GG * stride, pair + MOMENT_GR * stride, pair + MOMENT_KG * stride + channel,
                  pair + momentKr(ray.channels) * stride + channel);
  }
}

void addPairSimd(const PairRow& pair, const SolutionRow& solution)
{
  const Floats f;
  const auto zero = hn::Zero(f);
  const auto tiny = hn::Set(f, 1e-6F);
  const auto enabled = hn::Set(f, pair.brightness_slope ? 1.0F : 0.0F);
  const std::size_t stride = pair.stride;
  for (int x = 0; x < pair.width; x += static_cast<int>(hn::Lanes(f)))
  {
    const float* const moments = pair.moments + x;
    const auto inverse = hn::Div(enabled, hn::Add(hn::LoadU(f, moments + MOMENT_KK * stride), tiny));
    auto curvature = hn::LoadU(f, moments + MOMENT_GG * stride);
    auto gradient = hn::Neg(hn::LoadU(f, moments + MOMENT_GR * stride));
    for (std::size_t c = 0; c < static_cast<std::size_t>(pair.channels); ++c)
    {
      const auto kg = hn::LoadU(f, moments + (MOMENT_KG + c) * stride);
      const auto kr = hn::LoadU(f, moments + (momentKr(pair.channels) + c) * stride);
      const auto eliminated = hn::Mul(kg, inverse);
      curvature = hn::Sub(curvature, hn::Mul(eliminated, kg));
      gradient = hn::Add(gradient, hn::Mul(eliminated, kr));
    }
    curvature = hn::Max(curvature, zero);
    const auto own = hn::Div(hn::Mul(gradient, gradient), hn::Add(curvature, tiny));
    hn::StoreU(hn::Add(hn::LoadU(f, solution.curvature + x), curvature), f, solution.curvature + x);
    hn::StoreU(hn::Add(hn::LoadU(f, solution.gradient + x), gradient), f, solution.gradient + x);
    hn::StoreU(hn::Add(hn::LoadU(f, solution.disagreement + x), own), f, solution.disagreement + x);
    const auto positions = hn::LoadU(f, moments + MOMENT_KK * stride);
    hn::StoreU(hn::Add(hn::LoadU(f, solution.positions + x), positions), f, solution.positions + x);
  }
}

void solveRowSimd(const FinalRow& row, const SolutionRow& solution)
{
  const Floats f;
  const auto tiny = hn::Set(f, 1e-6F);
  const auto limit = hn::Set(f, row.max_step_px);
  const auto window = hn::Set(f, row.window);
  for (int x = 0; x < row.width; x += static_cast<int>(hn::Lanes(f)))
  {
    const auto curvature = hn::LoadU(f, solution.curvature + x);
    const auto divisor = hn::Add(curvature, tiny);
    const auto minimum = hn::Div(hn::LoadU(f, solution.gradient + x), divisor);
    const auto spread =
        hn::Sub(hn::Div(hn::LoadU(f, solution.disagreement + x), divisor), hn::Mul(minimum, minimum));
    const auto step = hn::Min(hn::Max(minimum, hn::Neg(limit)), limit);
    hn::StoreU(hn::Sqrt(hn::Max(spread, hn::Zero(f))), f, solution.disagreement + x);
    hn::StoreU(hn::Add(hn::LoadU(f, row.disparity + x), step), f, solution.gradient + x);
    const auto noise = hn::Mul(hn::LoadU(f, solution.positions + x), hn::LoadU(f, row.slope_noise + x));
    hn::StoreU(hn::Div(noise, window), f, solution.positions + x);
    hn::StoreU(hn::Div(curvature, window), f, solution.curvature + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace light_field_depth::multiview
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace light_field_depth::multiview
{
HWY_EXPORT(sumRowsSimd);
HWY_EXPORT(boxRowSimd);
HWY_EXPORT(scaleAndLowerSimd);
HWY_EXPORT(shareOfArmSimd);
HWY_EXPORT(differentiateSimd);
HWY_EXPORT(addRaySimd);
HWY_EXPORT(addPairSimd);
HWY_EXPORT(solveRowSimd);

void sumRows(const float* const* rows, int row_count, std::size_t count, float* sums)
{
  HWY_DYNAMIC_DISPATCH(sumRowsSimd)(rows, row_count, count, sums);
}

void boxRow(const float* in, int width, int radius, float* out)
{
  HWY_DYNAMIC_DISPATCH(boxRowSimd)(in, width, radius, out);
}

void scaleAndLower(float factor, float offset, int width, float* values, float* lowest)
{
  HWY_DYNAMIC_DISPATCH(scaleAndLowerSimd)(factor, offset, width, values, lowest);
}

void shareOfArm(const float* lowest, int width, float* values)
{
  HWY_DYNAMIC_DISPATCH(shareOfArmSimd)(lowest, width, values);
}

void differentiate(const DerivativeRow& row)
{
  HWY_DYNAMIC_DISPATCH(differentiateSimd)(row);
}

void addRay(const RayRow& ray, float* pair)
{
  HWY_DYNAMIC_DISPATCH(addRaySimd)(ray, pair);
}

void addPair(const PairRow& pair, const SolutionRow& solution)
{
  HWY_DYNAMIC_DISPATCH(addPairSimd)(pair, solution);
}

void solveRow(const FinalRow& row, const SolutionRow& solution)
{
  HWY_DYNAMIC_DISPATCH(solveRowSimd)(row, solution);
}

}  // namespace light_field_depth::multiview
#endif  // HWY_ONCE
