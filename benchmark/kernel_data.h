#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_DATA_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_DATA_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/label_bands.h"

namespace light_field_depth::benchmark
{
constexpr int WIDTH = 512;
constexpr std::size_t PIXELS = WIDTH;
constexpr std::size_t STRIDE = WIDTH + 2 * multiview::VECTOR_OVERRUN;  // between the channels of a row
constexpr std::size_t CHANNELS = 3;
constexpr std::size_t VIEWS = 16;
constexpr int LABELS = 32;
constexpr std::size_t ENTRIES = PIXELS * LABELS;
constexpr std::size_t TILE_ENTRIES =
    static_cast<std::size_t>(multiview::TILE_PX) * multiview::TILE_PX * LABELS;

inline std::vector<std::uint8_t> randomBytes(std::size_t count, int limit)
{
  std::mt19937 engine(static_cast<std::uint32_t>(count));
  std::uniform_int_distribution<int> distribution(0, limit);
  std::vector<std::uint8_t> values(count);
  for (auto& value : values)
  {
    value = static_cast<std::uint8_t>(distribution(engine));
  }
  return values;
}

/// One call of a kernel on data that the call keeps alive.
template <class Data, class Call>
std::function<void()> calling(std::shared_ptr<Data> data, const Call& call)
{
  return [data = std::move(data), call] { call(*data); };
}

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_KERNEL_DATA_H
