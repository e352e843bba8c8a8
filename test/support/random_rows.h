#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace light_field_depth
{
/// Pixels of a row with which kernels are tested: no multiple of any vector.
constexpr int ROW_WIDTH = 203;
/// From row to row, with room to read beyond a row's end.
constexpr std::size_t ROW_STRIDE = 320;

/// Rows of random numbers, the same in each run.
class RandomRows
{
public:
  std::vector<std::uint8_t> bytes(std::size_t count, int limit = 256)
  {
    std::vector<std::uint8_t> values(count);
    for (auto& value : values)
    {
      value = static_cast<std::uint8_t>(std::uniform_int_distribution<int>(0, limit - 1)(engine_));
    }
    return values;
  }
  std::vector<float> floats(std::size_t count, float low, float high)
  {
    std::vector<float> values(count);
    for (auto& value : values)
    {
      value = std::uniform_real_distribution<float>(low, high)(engine_);
    }
    return values;
  }

private:
  std::mt19937 engine_{7};
};

/// The first `count` values, without what stands beyond the end of a row.
template <typename Values>
Values firstPart(const Values& values, std::size_t count)
{
  return Values(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H
