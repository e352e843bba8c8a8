#ifndef LIGHT_FIELD_DEPTH_CORE_MEMORY_NEED_H
#define LIGHT_FIELD_DEPTH_CORE_MEMORY_NEED_H

#include <cstddef>
#include <string>

#include <opencv2/core.hpp>

#include "light_field_depth/core/pipeline.h"

namespace light_field_depth
{
/// What the memory of a run depends on.
struct LightFieldShape
{
  std::size_t views = 0;  ///< that are read, or come as messages
  cv::Size size;          ///< of each view, pixels
  int type = CV_8UC3;     ///< of each view, as View::image has it
};

/// The most memory that a process needs that reads a light field, runs the pipeline and writes its results,
/// in MB of 10^6 bytes. An upper bound from measurements, computed without any allocation: the peak is
/// between 0.4 and 1 of it.
double memoryNeedMb(const LightFieldShape& shape, const PipelineOptions& options,
                    const ProductRequest& request);

/// Refuses what does not fit, before it is allocated.
/// @param limit_mb MB of 10^6 bytes; 0: what the machine has
/// @param remedy   how the limit is raised, for the sentence
/// @throw InputError that says how many views, or which size of theirs, would fit
void requireMemory(const LightFieldShape& shape, const PipelineOptions& options,
                   const ProductRequest& request, double limit_mb, const std::string& remedy);

/// The main memory of this machine, in MB of 10^6 bytes.
double machineMemoryMb();

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_MEMORY_NEED_H
