#ifndef LIGHT_FIELD_DEPTH_CORE_RUN_CONTEXT_H
#define LIGHT_FIELD_DEPTH_CORE_RUN_CONTEXT_H

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// Wall-clock time of one stage of the pipeline.
struct StageTime
{
  std::string stage;          ///< its name, as in 'visible_cost'
  double milliseconds = 0.0;  ///< of wall-clock time
};

/// Receives intermediate results: a name usable as a file name without extension, and a matrix.
using IntermediateSink = std::function<void(const std::string& name, const cv::Mat& values)>;

/// Receives the name of the stage that begins and the fraction of the work done before it, 0..1.
using ProgressSink = std::function<void(const std::string& stage, double fraction)>;

/// A stage that is going to run.
struct ExpectedStage
{
  std::string stage;   ///< name, as in StageTime
  double share = 0.0;  ///< of the time, in any unit that all stages have in common
};

/// What every stage of a run shares besides its data. Stages are named in small letters with underscores,
/// as in 'visible_cost'. Belongs to one run on one thread.
struct RunContext
{
  explicit RunContext(ThreadPool& thread_pool) : pool(thread_pool) {}  ///< a run without sinks

  /// Tells what is going to run, in order; a stage may come more than once. Progress is measured by it.
  void expect(std::vector<ExpectedStage> stages);
  /// Tells the progress sink that a stage begins. One that is not expected any more leaves the fraction where
  /// it is, which so never falls.
  void begin(const std::string& stage);

  ThreadPool& pool;                    ///< used by one stage at a time
  std::vector<StageTime> stage_times;  ///< in order of first appearance; repeated stages are added up
  IntermediateSink save_intermediate;  ///< empty when nobody wants them
  ProgressSink progress;               ///< empty when nobody wants it

  /// Hands an intermediate result to the sink, if there is one. An empty matrix is left out.
  void save(const std::string& name, const cv::Mat& values) const;

private:
  std::vector<ExpectedStage> expected_;
  std::size_t next_expected_ = 0;
};

/// Begins a stage of the context, and adds the time from its construction to its destruction to it.
class StageTimer
{
public:
  StageTimer(RunContext& context, std::string stage);  ///< the context must outlive the timer
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

private:
  RunContext& context_;
  std::string stage_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_RUN_CONTEXT_H
