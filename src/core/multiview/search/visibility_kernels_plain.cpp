#include "core/multiview/search/visibility_kernels.h"

namespace light_field_depth::multiview
{
void warpTargetsPlain(const WarpRow& row, std::int32_t* targets)
{
  for (int x = 0; x < row.width; ++x)
  {
    targets[x] = warpTarget(row, x);
  }
}

}  // namespace light_field_depth::multiview
