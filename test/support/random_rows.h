#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <opencv2/core.hpp>

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

namespace testing
{
/// @return integers from low to high, the same ones for the same seed
template <typename Value>
std::vector<Value> randomValues(std::size_t count, int low, int high, unsigned seed)
{
  std::mt19937 engine(seed);
  std::uniform_int_distribution<int> any(low, high);
  std::vector<Value> values(count);
  std::generate(values.begin(), values.end(), [&] { return static_cast<Value>(any(engine)); });
  return values;
}

/// @return CV_32FC1, other values with each call
inline cv::Mat randomMap(int height, int width, float low, float high)
{
  static std::mt19937 engine(5);
  std::uniform_real_distribution<float> distribution(low, high);
  cv::Mat map(height, width, CV_32FC1);
  std::generate(map.begin<float>(), map.end<float>(), [&] { return distribution(engine); });
  return map;
}

/// The same as a row.
inline std::vector<float> randomRow(int count, float low, float high)
{
  const cv::Mat row = randomMap(1, count, low, high);
  return {row.begin<float>(), row.end<float>()};
}

}  // namespace testing
}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_RANDOM_ROWS_H
