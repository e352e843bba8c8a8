#ifndef LIGHT_FIELD_DEPTH_CORE_PIPELINE_H
#define LIGHT_FIELD_DEPTH_CORE_PIPELINE_H

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "light_field_depth/core/cancellation.h"
#include "light_field_depth/core/estimator.h"
#include "light_field_depth/core/light_field.h"
#include "light_field_depth/core/multiview_options.h"
#include "light_field_depth/core/paper2017_options.h"
#include "light_field_depth/core/point_cloud.h"
#include "light_field_depth/core/run_context.h"
#include "light_field_depth/core/thread_pool.h"
#include "light_field_depth/core/view_maps.h"

namespace light_field_depth
{
class MultiviewEstimator;
class Paper2017Estimator;

enum class Method
{
  Multiview,  ///< all views solved together, aware of occlusions
  Paper2017   ///< the method of the 2017 paper, stage by stage
};

/// "multiview", "paper2017".
std::string toString(Method method);
/// The inverse of toString(). @throw InputError that lists the names.
Method methodFromString(const std::string& name);
/// The names of all methods, the default first.
std::vector<std::string> methodNames();

/// All settings of a run. Each stage's struct is the one home of its defaults.
struct PipelineOptions
{
  Method method = Method::Multiview;          ///< which estimator finds the disparity
  ViewSelection views = ViewSelection::Auto;  ///< which views take part
  /// In pixels per grid step; found from the images when absent. No disparity leaves a range that is given. A
  /// range that moves everything out of every view is refused.
  std::optional<DisparityRange> disparity_range;
  Paper2017Options paper2017;  ///< for Method::Paper2017
  MultiviewOptions multiview;  ///< for Method::Multiview
  /// Confidence below which the organised cloud and the depth map have NaN. Raise it to see only what is
  /// certain.
  float min_confidence = 0.0F;
  /// Whether depth map and organised cloud also show what is filled (DisparityEstimate::filled). The dense
  /// cloud never does, as its least confidence is above 0.
  bool keep_filled = false;
  DenseCloudOptions dense_cloud;  ///< for the extra cloud of all views
  /// Limits of depth, metres; 0: none. Beyond them depth and clouds have NaN. Set them to what a robot has to
  /// do with: its own parts in front of the cameras, or a far background that only costs.
  float min_depth_m = 0.0F;
  float max_depth_m = 0.0F;  ///< likewise
};

/// One whole sentence for each option that cannot be used; empty when all can.
std::vector<std::string> validate(const PipelineOptions& options);

/// The products that a caller wants; what is not wanted is not computed.
struct ProductRequest
{
  bool depth = false;            ///< PipelineResult::depth
  bool organized_cloud = false;  ///< PipelineResult::organized_cloud
  bool dense_cloud = false;      ///< PipelineResult::dense_cloud
  /// The estimate has what Pipeline::runDenseCloud() takes; costs next to nothing.
  bool dense_cloud_later = false;
  ViewMapSink view_maps;  ///< receives the map of every view; empty: none are made
  /// Where the points go; empty: into the vectors of the result.
  PointAllocator organized_cloud_allocator;
  DensePointSink dense_cloud_sink;  ///< where the points of the dense cloud go, block after block; likewise
};

/// The views that Pipeline::run() will use of a light field whose views need no images yet: the others need
/// not be read. The products do not depend on them.
ViewSelection viewsToRead(const LightField& light_field, const PipelineOptions& options);

/// What a run gives: what was asked for, and how long it took.
struct PipelineResult
{
  DisparityEstimate estimate;  ///< disparity and confidence; always there
  cv::Mat depth;               ///< CV_32FC1 metres, NaN where unknown; empty without calibration
  // Both clouds are empty without calibration, and where the request has room for them.
  std::vector<ColoredPoint> organized_cloud;  ///< row-major, NaN where unknown
  std::vector<DensePoint> dense_cloud;        ///< no NaN
  std::vector<StageTime> stage_times;         ///< in the order in which the stages began
  double total_ms = 0.0;                      ///< of the whole run
};

/// Runs the stages in order. Keeps threads and buffers from frame to frame; used by one thread at a time,
/// except cancel(). The only place that knows the order of the stages.
class Pipeline
{
public:
  /// @param threads that work inside a stage, the caller's included; 0 takes one per processor.
  explicit Pipeline(int threads = 0);
  ~Pipeline();

  int threads() const { return pool_.threads(); }  ///< the caller's included

  /// Its threads, for other work between two runs, by the thread that runs.
  ThreadPool& pool() { return pool_; }

  /// Receives intermediate results and progress of the following runs.
  void setIntermediateSink(IntermediateSink sink) { intermediate_sink_ = std::move(sink); }
  void setProgressSink(ProgressSink sink) { progress_sink_ = std::move(sink); }  ///< likewise

  /// @throw InputError for options or input that cannot be used, Cancelled after cancel()
  PipelineResult run(const LightField& light_field, const PipelineOptions& options,
                     const ProductRequest& request);

  /// The dense cloud of a result whose run had ProductRequest::dense_cloud_later: point for point that of a
  /// run with ProductRequest::dense_cloud. May be another pipeline's than that of the run, which then goes on
  /// with the next frame meanwhile; nothing that a pipeline carries from frame to frame is touched. Reads
  /// the images and the maps and changes none of them.
  /// @param light_field, options as they were given to the run
  /// @param estimate that the run gave
  /// @return times of the stages; none, and no points, without a calibration
  /// @throw InputError, Cancelled
  std::vector<StageTime> runDenseCloud(const LightField& light_field, const PipelineOptions& options,
                                       const DisparityEstimate& estimate, const DensePointSink& sink);

  /// The next run starts as the first one does: nothing of earlier frames helps it (see
  /// MultiviewOptions::temporal). To be called by the thread that runs.
  void forget();

  /// Makes the run in hand and every later one throw Cancelled soon. Thread safe.
  void cancel() { cancellation_.cancel(); }

private:
  MultiviewEstimator& multiviewEstimator(const PipelineOptions& options);
  Estimator& estimatorFor(const PipelineOptions& options);
  void unproject(const LightField& light_field, const PipelineOptions& options, const ProductRequest& request,
                 RunContext& context, PipelineResult& result);

  CancellationToken cancellation_;
  ThreadPool pool_;
  IntermediateSink intermediate_sink_;
  ProgressSink progress_sink_;
  std::unique_ptr<Paper2017Estimator> paper2017_;
  std::unique_ptr<MultiviewEstimator> multiview_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_PIPELINE_H
