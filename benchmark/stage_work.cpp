#include "stage_work.h"

#include "core/multiview/refine/edge_aware_smoothing.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr double FLOAT = 4.0;   // bytes
constexpr double WORD = 2.0;    // bytes
constexpr double PLANAR = 3.0;  // bytes of a pixel, three channels in planes

StageWork prepare(const FrameSize& frame)
{
  const double per_view = frame.channels + PLANAR;
  return {"prepare", frame.pixels * (frame.views * per_view + frame.channels + PLANAR), 0.0, Lane::None};
}

StageWork cost(const FrameSize& frame)
{
  // Of each channel |a - b| is two subtractions and an or; two sums, a minimum, and the sum of the arm.
  const double operations = 4.0 * frame.channels + 1.0;
  return {"cost", frame.pixels * (PLANAR * (frame.views + 1.0) + frame.labels),
          frame.pixels * frame.labels * frame.views * operations, Lane::Byte};
}

StageWork visibleCost(const FrameSize& frame)
{
  const double operations = 4.0 * frame.channels + 6.0;  // also: is it hidden, mask and count
  const double bytes = PLANAR * (frame.views + 1.0) + frame.views + frame.labels;
  return {"visible_cost", frame.visibility_passes * frame.pixels * bytes,
          frame.visibility_passes * frame.pixels * frame.labels * frame.views * operations, Lane::Byte};
}

StageWork visibility(const FrameSize& frame)
{
  // Each view reads the disparity, clears its surface, writes to it, and closes gaps.
  constexpr double bytes = FLOAT + 1.0 + 1.0 + 2.0;
  constexpr double operations = 10.0;
  return {"visibility", frame.visibility_passes * frame.pixels * frame.views * bytes,
          frame.visibility_passes * frame.pixels * frame.views * operations, Lane::Float};
}

StageWork aggregate(const FrameSize& frame)
{
  // Rows: cost read, packed sums written. Columns: both read, and the cost once more; the steps of P2 are
  // written once and read by each. The result is written. The sums of the first path of a strip or column
  // stay in a core's cache.
  const double volume = frame.labels * (2.0 + 2.0 + 1.0);
  const double steps = PLANAR + 2.0 * WORD + 3.0 * WORD;
  constexpr double paths = 4.0;
  constexpr double per_path = 8.0;  // see pathStep()
  constexpr double selection = 3.0;
  const double passes = 1.0 + frame.visibility_passes;
  return {"aggregate", passes * frame.pixels * (volume + steps + FLOAT),
          passes * frame.pixels * frame.labels * (paths * per_path + selection), Lane::Word};
}

StageWork median(const FrameSize& frame)
{
  const double passes = 1.0 + frame.visibility_passes;
  return {"median", passes * frame.pixels * 2.0 * FLOAT, 0.0, Lane::None};
}

StageWork linearize(const FrameSize& frame)
{
  constexpr double results = 4.0 * FLOAT;
  // In words, twice as many of which fit a vector: weights, four taps of three channels, differences to the
  // reference. In floats: position, shares, moments.
  constexpr double per_view = (14.0 + 4.0 * 9.0 + 9.0) / 2.0 + 7.0 + 35.0;
  return {"linearize", frame.refinements * frame.pixels * (PLANAR * (frame.views + 1.0) + FLOAT + results),
          frame.refinements * frame.pixels * frame.views * per_view, Lane::Float};
}

StageWork smooth(const FrameSize& frame)
{
  const multiview::SmoothingSettings settings;
  // In the first sweep guides are read and links written instead of links read.
  constexpr double link_bytes = FLOAT * 2.0;
  constexpr double link_operations = 14.0;
  // A band of rows, and likewise columns: weight, target, links, disparity read, disparity written.
  constexpr double row_bytes = FLOAT * (5.0 + 1.0);
  constexpr double column_bytes = FLOAT * (5.0 + 1.0);
  constexpr double line_operations = 24.0;
  constexpr double sweeps = 2.0;
  // The correction reads the system and writes the disparity; its own grids together are a third of a sweep.
  constexpr double coarse_bytes = FLOAT * (4.0 + 2.0) + (row_bytes + column_bytes) / 3.0;
  constexpr double coarse_operations = 16.0 + 2.0 * line_operations / 3.0;
  const auto reweightings = static_cast<double>(settings.flat_px.size());
  const double runs = frame.refinements * reweightings;
  return {"smooth",
          frame.pixels * (runs * (link_bytes + sweeps * (row_bytes + column_bytes) + coarse_bytes) + PLANAR +
                          2.0 * FLOAT),
          frame.pixels * runs * (link_operations + sweeps * 2.0 * line_operations + coarse_operations),
          Lane::Float};
}

StageWork confidence(const FrameSize& frame)
{
  constexpr double maps = 8.0;          // seven read, one written
  constexpr double operations = 100.0;  // mostly smallest and largest of 3 x 3 and 5 x 5 pixels
  return {"confidence", frame.pixels * maps * FLOAT, frame.pixels * operations, Lane::Float};
}

/// Stages that look at every pixel of every view once.
StageWork lookAtViews(const char* stage, const FrameSize& frame)
{
  return {stage, frame.pixels * frame.channels * (frame.views + 1.0), 0.0, Lane::None};
}

}  // namespace

std::vector<StageWork> stageWork(const FrameSize& frame)
{
  return {lookAtViews("exposure", frame),
          lookAtViews("range", frame),
          {"noise", frame.pixels * frame.channels, 0.0, Lane::None},
          prepare(frame),
          cost(frame),
          aggregate(frame),
          median(frame),
          visibility(frame),
          visibleCost(frame),
          {"boundary_pixels", frame.pixels * (2.0 * FLOAT + PLANAR), 0.0, Lane::None},
          linearize(frame),
          smooth(frame),
          confidence(frame)};
}

}  // namespace light_field_depth::benchmark
