#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_MUTUAL_MATCHES_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_MUTUAL_MATCHES_H

#include <cstdint>
#include <vector>

#include "core/preprocess/plane_sweep.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Not 0 for each pixel that is, for what it matches best in the other view, the best match as well. Where
/// one view alone stands beside the reference, no second one contradicts a pixel that it cannot see: such
/// pixels find something all the same, and that has a better match elsewhere.
/// @param sweep with one arm of one view
/// @param volume of that sweep
std::vector<std::uint8_t> findMutualMatches(const PlaneSweep& sweep, const SweepCosts& volume,
                                            ThreadPool& pool);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_MUTUAL_MATCHES_H
