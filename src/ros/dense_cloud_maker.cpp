#include "ros/dense_cloud_maker.h"

#include <unistd.h>

#include <new>
#include <utility>

#include "light_field_depth/core/error.h"
#include "light_field_depth/ros/result_messages.h"

namespace light_field_depth
{
namespace
{
/// A thirtieth of the processor time that another thread gets where there is not enough for both, and all
/// that is left where there is. On a machine that was busy with other work 13 and 19 of 100 sets of the demo
/// at 10 Hz were dropped without a cloud, 23 with clouds and 10, 12 with 19, which made a fifth of the
/// clouds.
constexpr int NICENESS = 15;

/// For the calling thread and those that it starts from now on.
void giveWay()
{
  // On Linux niceness belongs to the thread.
  [[maybe_unused]] const int niceness = nice(NICENESS);
}

}  // namespace

DenseCloudMaker::DenseCloudMaker(int threads, Receiver on_cloud, FailureReceiver on_failure)
    : threads_(threads), on_cloud_(std::move(on_cloud)), on_failure_(std::move(on_failure)), runner_(giveWay)
{
}

DenseCloudMaker::~DenseCloudMaker()
{
  stop();
}

bool DenseCloudMaker::offer(FinishedFrame frame)
{
  return runner_.runIfIdle(jobOf(std::move(frame)));
}

bool DenseCloudMaker::queue(FinishedFrame frame)
{
  return runner_.run(jobOf(std::move(frame)));
}

DenseCloudMaker::Job DenseCloudMaker::jobOf(FinishedFrame frame)
{
  const auto held = std::make_shared<const FinishedFrame>(std::move(frame));
  return [this, held, epoch = epoch_.load()] { makeSafely(*held, epoch); };
}

void DenseCloudMaker::cancel()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  cancelled_ = true;
  if (pipeline_ != nullptr)
  {
    pipeline_->cancel();
  }
}

void DenseCloudMaker::stop()
{
  cancel();
  runner_.stop();
}

/// On the thread of the runner, from which the pipeline's threads have their niceness.
Pipeline& DenseCloudMaker::pipeline()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (cancelled_)
  {
    throw Cancelled();
  }
  if (pipeline_ == nullptr)
  {
    pipeline_ = std::make_unique<Pipeline>(threads_);
  }
  return *pipeline_;
}

void DenseCloudMaker::makeSafely(const FinishedFrame& frame, unsigned epoch)
{
  try
  {
    make(frame, epoch);
  }
  catch (const Cancelled&)
  {
    // Nobody waits for it any more.
  }
  catch (const std::bad_alloc&)
  {
    on_failure_("The memory does not suffice for the dense cloud; use fewer or smaller views (decimation).");
  }
  catch (const std::exception& error)
  {
    on_failure_(std::string("The dense cloud could not be made: ") + error.what());
  }
}

void DenseCloudMaker::make(const FinishedFrame& frame, unsigned epoch)
{
  const PipelineOptions& options = frame.settings->pipeline;
  const std::size_t every_nth = thinningOfDenseCloud(frame.light_field, options.dense_cloud);
  const sensor_msgs::PointCloud2Ptr cloud = clouds_.take();
  beginDenseCloud(frame.header, *cloud);
  pipeline().runDenseCloud(frame.light_field, options, frame.estimate,
                           [&](const DensePoint* points, std::size_t count)
                           { appendDensePoints(points, count, every_nth, *cloud); });
  if (epoch == epoch_)
  {
    on_cloud_(frame, cloud);
  }
}

std::size_t thinningOfDenseCloud(const LightField& light_field, const DenseCloudOptions& options)
{
  return options.voxel_size_m > 0.0F
             ? 1
             : thinningOfDenseCloud(light_field.views.size() *
                                    static_cast<std::size_t>(light_field.size().area()));
}

}  // namespace light_field_depth
