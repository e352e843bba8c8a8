#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_KERNELS_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_KERNELS_H

#include <functional>
#include <string>
#include <vector>

namespace light_field_depth::benchmark
{
/// An inner loop over one row of data that the nearest caches hold, and the same loop without vectors.
struct Kernel
{
  std::string name;
  std::string item;    ///< what it does over and over again
  double items = 0.0;  ///< in one call
  double bytes = 0.0;  ///< read and written in one call
  std::function<void()> vectors;
  std::function<void()> plain;
};

/// On a row of a frame of 512 x 512, 17 colour views on a cross and 32 labels: the kernels that views and
/// labels go through, and those that maps of the disparity do.
std::vector<Kernel> searchKernels();
std::vector<Kernel> mapKernels();
/// Both.
std::vector<Kernel> kernels();

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_KERNELS_H
