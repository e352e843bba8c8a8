#include <algorithm>
#include <cstdint>

#include "core/preprocess/view_noise_kernels.h"

namespace light_field_depth
{
DifferenceSums sumDifferencesPlain(const BlockPair& pair, int bytes)
{
  DifferenceSums sums;
  for (int y = 0; y < NOISE_BLOCK_PX; ++y)
  {
    for (int x = 0; x < bytes; ++x)
    {
      const int value = pair.one[y * pair.one_stride + x] - pair.other[y * pair.other_stride + x];
      sums.columns[x] += value;
      sums.squares += value * value;
    }
  }
  return sums;
}

std::int32_t sumSlopesPlain(const BlockPair& pair)
{
  std::int32_t sum = 0;
  for (int y = 0; y < NOISE_BLOCK_PX; ++y)
  {
    for (int x = 0; x < NOISE_BLOCK_PX; ++x)
    {
      const auto at = [&](int dx, int dy)
      {
        const int value =
            pair.one[(y + dy) * pair.one_stride + x + dx] - pair.other[(y + dy) * pair.other_stride + x + dx];
        return std::clamp(value, -MAX_NOISE_DIFFERENCE, MAX_NOISE_DIFFERENCE);
      };
      const int along_x = 8 * (at(1, 0) - at(-1, 0)) - (at(2, 0) - at(-2, 0));
      const int along_y = 8 * (at(0, 1) - at(0, -1)) - (at(0, 2) - at(0, -2));
      sum += along_x * along_x + along_y * along_y;
    }
  }
  return sum;
}

}  // namespace light_field_depth
