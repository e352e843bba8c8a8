#include "light_field_depth/core/run_context.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace light_field_depth
{
void RunContext::save(const std::string& name, const cv::Mat& values) const
{
  if (save_intermediate && !values.empty())
  {
    save_intermediate(name, values);
  }
}

void RunContext::expect(std::vector<ExpectedStage> stages)
{
  expected_ = std::move(stages);
  next_expected_ = 0;
}

void RunContext::begin(const std::string& stage)
{
  if (!progress)
  {
    return;
  }
  const auto first = expected_.begin();
  const auto found = std::find_if(first + static_cast<std::ptrdiff_t>(next_expected_), expected_.end(),
                                  [&](const ExpectedStage& expected) { return expected.stage == stage; });
  if (found != expected_.end())
  {
    next_expected_ = static_cast<std::size_t>(found - first);
  }
  const auto add_share = [](double sum, const ExpectedStage& expected) { return sum + expected.share; };
  const double before =
      std::accumulate(first, first + static_cast<std::ptrdiff_t>(next_expected_), 0.0, add_share);
  const double all = std::accumulate(first, expected_.end(), 0.0, add_share);
  progress(stage, all > 0.0 ? before / all : 0.0);
}

StageTimer::StageTimer(RunContext& context, std::string stage)
    : context_(context), stage_(std::move(stage)), start_(std::chrono::steady_clock::now())
{
  context_.begin(stage_);
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
