#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_SWEEP_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_SWEEP_KERNELS_H

#include <cstddef>
#include <cstdint>

namespace light_field_depth
{
/// The inner loops of plane sweeps and of exposure, each over `count` elements, with the best vector
/// instructions that the processor has. Results do not depend on these.

/// Weights of blendBytes() add up to this.
constexpr int BLEND_WEIGHTS = 32;

/// to = a and b weighed with BLEND_WEIGHTS - weight_b and weight_b, rounded.
void blendBytes(const std::uint8_t* a, const std::uint8_t* b, int weight_b, std::size_t count,
                std::uint8_t* to);

/// sums += min(|a - b|, most), modulo 256.
void addDifferences(const std::uint8_t* a, const std::uint8_t* b, std::uint8_t most, std::size_t count,
                    std::uint8_t* sums);

/// columns += entering - leaving.
void slideColumns(const std::uint8_t* entering, const std::uint8_t* leaving, std::size_t count,
                  std::uint16_t* columns);

/// value = (columns[i] + .. + columns[i + 4]) * factor / 65536, rounded down; total += value;
/// worst = max(worst, value).
/// @param columns of count + 4 elements whose sums over five are below 65536
void addWindows(const std::uint16_t* columns, std::uint16_t factor, std::size_t count, std::uint16_t* total,
                std::uint16_t* worst);

/// total = (total - worst) / divisor, rounded down.
/// @param divisor 1 to 3
void dropWorst(const std::uint16_t* worst, std::uint16_t divisor, std::size_t count, std::uint16_t* total);

/// Where cost < best_cost: best_cost = cost, best_label = label.
void keepBest(const std::uint16_t* cost, std::uint16_t label, std::size_t count, std::uint16_t* best_cost,
              std::uint16_t* best_label);

/// least = min(least, cost).
void keepLeast(const std::uint16_t* cost, std::size_t count, std::uint16_t* least);

/// The same where |label - best_label| >= distance.
void keepRival(const std::uint16_t* cost, std::uint16_t label, const std::uint16_t* best_label,
               std::uint16_t distance, std::size_t count, std::uint16_t* least);

/// to = value * (factor + shading * gain) + offset, rounded and kept in 0..255.
struct ExposureRow
{
  const float* factor;
  const float* gain;
  const float* offset;
  float shading;
};
void exposeBytes(const std::uint8_t* value, const ExposureRow& row, std::size_t count, std::uint8_t* to);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_SWEEP_KERNELS_H
