#include "core/multiview/expected_stages.h"

namespace light_field_depth::multiview
{
namespace
{
// All shares are milliseconds of `balanced` on cotton (benchmark/results/profile.md), those of a stage that
// comes more than once divided among its turns; those of upsampling and the left-right check
// are estimates. They need not be exact: the bar has to move, and to move evenly enough.

using Stages = std::vector<ExpectedStage>;

void append(Stages& stages, const Stages& more)
{
  stages.insert(stages.end(), more.begin(), more.end());
}

Stages ofMeasuring()
{
  return {{"exposure", 4.2}, {"range", 4.1}, {"registration", 3.0}, {"noise", 0.4}};
}

/// Before it is known who sees what.
Stages ofFirstSearch()
{
  // A stage that a preset leaves out is passed over.
  return {{"prepare", 1.4},    {"cost", 10.8},     {"aggregate", 4.2}, {"median", 0.3},
          {"background", 1.4}, {"aggregate", 4.2}, {"median", 0.2},    {"background", 1.4}};
}

Stages ofSolver(const MultiviewOptions& options)
{
  Stages stages = ofFirstSearch();
  for (int pass = 0; pass < options.visibility_passes; ++pass)
  {
    append(stages, {{"visibility", 3.1}, {"visible_cost", 11.6}, {"aggregate", 4.2}, {"median", 0.3}});
  }
  append(stages, {{"boundary_pixels", 0.7}, {"noise", 0.4}, {"smooth", 0.5}});
  for (int i = 0; i < options.refinements; ++i)
  {
    append(stages, {{"linearize", 7.7}, {"smooth", 3.0}});
  }
  stages.push_back({"confidence", 0.8});
  return stages;
}

/// A search at half the resolution has a quarter of the pixels.
Stages atHalfResolution(Stages stages)
{
  for (ExpectedStage& stage : stages)
  {
    stage.share *= 0.25;
  }
  return stages;
}

}  // namespace

std::vector<ExpectedStage> expectedStages(const MultiviewOptions& options, bool coarse_to_fine, bool pair)
{
  const MultiviewOptions numbers = withPresetNumbers(options);
  Stages stages = ofMeasuring();
  if (coarse_to_fine)
  {
    append(stages, atHalfResolution(ofSolver(numbers)));
    stages.push_back({"upsample", 1.0});
  }
  append(stages, ofSolver(numbers));
  if (pair)
  {
    append(stages, atHalfResolution(ofFirstSearch()));
    stages.push_back({"left_right_check", 1.0});
  }
  return stages;
}

}  // namespace light_field_depth::multiview
