#include "light_field_depth/core/run_context.h"

#include <algorithm>

namespace light_field_depth
{
void RunContext::save(const std::string& name, const cv::Mat& values) const
{
  if (save_intermediate && !values.empty())
  {
    save_intermediate(name, values);
  }
}

StageTimer::StageTimer(RunContext& context, std::string stage)
    : context_(context), stage_(std::move(stage)), start_(std::chrono::steady_clock::now())
{
}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start_;
  auto& times = context_.stage_times;
  const auto found = std::find_if(times.begin(), times.end(),
                                  [this](const StageTime& time) { return time.stage == stage_; });
  if (found != times.end())
  {
    found->milliseconds += elapsed.count();
  }
  else
  {
    times.push_back({stage_, elapsed.count()});
  }
}

}  // namespace light_field_depth
