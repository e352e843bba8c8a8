#ifndef LIGHT_FIELD_DEPTH_BENCHMARK_STAGE_WORK_H
#define LIGHT_FIELD_DEPTH_BENCHMARK_STAGE_WORK_H

#include <string>
#include <vector>

namespace light_field_depth::benchmark
{
/// The sizes that the work of a frame follows from.
struct FrameSize
{
  double pixels = 0.0;
  double views = 0.0;  ///< that are matched, without the reference
  double channels = 3.0;
  double labels = 0.0;
  double arms = 4.0;
  double visibility_passes = 1.0;
  double refinements = 2.0;
};

enum class Lane
{
  None,  ///< not counted
  Byte,
  Word,
  Float
};

/// What one stage of the multi-view method has to do.
struct StageWork
{
  std::string stage;        ///< as StageTime names it
  double bytes = 0.0;       ///< to and from memory
  double operations = 0.0;  ///< on single lanes
  Lane lane = Lane::None;
};

/// Bytes are counted from the sizes of the arrays: every array that does not fit the cache of a core is read
/// once and written once in each pass over the frame that uses it; what is kept for a few rows or columns
/// (sub-pixel rows, states of paths, moments) is not counted. Operations are those of the inner loops,
/// counted in the source, without addresses, loads and stores. All labels count in every search, also where
/// the later ones try fewer.
std::vector<StageWork> stageWork(const FrameSize& frame);

}  // namespace light_field_depth::benchmark

#endif  // LIGHT_FIELD_DEPTH_BENCHMARK_STAGE_WORK_H
