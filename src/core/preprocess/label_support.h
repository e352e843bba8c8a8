#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LABEL_SUPPORT_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LABEL_SUPPORT_H

#include <cstdint>
#include <optional>
#include <vector>

#include "core/preprocess/plane_sweep.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Labels of a plane sweep, both ends included.
struct LabelRange
{
  int first = 0;
  int last = 0;
};

/// Labels with evidence.
struct LabelSupport
{
  LabelRange core;  ///< holds the bulk of the pixels that are certain of their label
  LabelRange all;   ///< holds the core
};

/// The labels that the images of a plane sweep give evidence for.
///
/// A pixel is certain of its best label if every label outside that minimum costs clearly more. The bulk of
/// the certain pixels makes the core of the range; connected patches of pixels outside it widen the range if
/// they are certain, too, or if their best label costs clearly less than every label of the core. So neither
/// noise nor repeated texture widens it, and a small object does.
/// @param trusted not 0 for each pixel that counts; empty: all do
/// @return nothing if hardly any pixel is certain
std::optional<LabelSupport> findSupportedLabels(const SweepCosts& volume, ThreadPool& pool,
                                                const std::vector<std::uint8_t>& trusted = {});

/// For each pixel that would be certain of its best label if there were little noise, that label, refined
/// between labels; NaN for the others. For those who want many and can bear a few wrong ones.
std::vector<float> findLikelyLabels(const SweepCosts& volume, ThreadPool& pool,
                                    const std::vector<std::uint8_t>& trusted = {});

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_LABEL_SUPPORT_H
