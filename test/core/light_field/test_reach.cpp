// Positions and ranges that no image can serve are refused in a sentence, and none takes memory without end.

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <string>
#include <vector>

#include "core/light_field/reach.h"
#include "core/light_field/view_set.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/pipeline.h"
#include "support/synthetic_scene.h"
#include "support/temporary_folder.h"

namespace light_field_depth
{
namespace
{
/// Views of 64 x 64 pixels of a plane of disparity 2 in a row, whose positions are then said to be others.
LightField rowAt(const std::vector<double>& positions)
{
  testing::SceneSettings settings;
  settings.size = {64, 64};
  settings.positions.clear();
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    settings.positions.push_back({0, static_cast<int>(i)});
  }
  settings.samples = 1;
  const auto scene = testing::renderScene(testing::standardScene(settings.size), settings);
  std::vector<View> views;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    View view = gridView(0, static_cast<int>(i), scene.light_field.views[i].image);
    view.steps = {positions[i], 0.0};
    views.push_back(view);
  }
  return makeLightField(std::move(views));
}

long peakMemoryMb()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

std::string messageOfRun(const LightField& light_field, const PipelineOptions& options)
{
  return testing::messageOf<InputError>([&] { Pipeline(1).run(light_field, options, {}); });
}

TEST(Reach, RefusesWhatTheFarthestViewCannotFollow)
{
  struct Case
  {
    std::vector<double> positions;
    DisparityRange range;
  };
  for (const Case& wide : {Case{{-1e-8, 0.0, 1.0}, {-3e9F, 3e9F}}, Case{{0.0, 1.0, 999.0}, {-60.0F, 60.0F}},
                           Case{{0.0, 1e-6, 1.0}, {-1e6F, 1e6F}}})
  {
    const LightField light_field = rowAt(wide.positions);
    for (const std::string& method : methodNames())
    {
      PipelineOptions options;
      options.method = methodFromString(method);
      options.disparity_range = wide.range;
      const std::string message = messageOfRun(light_field, options);
      EXPECT_NE(message.find("view (0, "), std::string::npos) << message;
      EXPECT_NE(message.find("narrower disparity_range"), std::string::npos) << message;
    }
  }
  EXPECT_LT(peakMemoryMb(), 1000);
}

TEST(Reach, FindsRangesInBoundedMemoryWhateverTheDistances)
{
  for (const std::vector<double>& positions :
       {std::vector<double>{0.0, 1e-6, 1.0}, {0.0, 1e-8, 1.0}, {-1.0, 0.0, 1e-7, 1.0}, {0.0, 1.0, 1000.0}})
  {
    PipelineOptions options;
    const std::string message = messageOfRun(rowAt(positions), options);
    EXPECT_TRUE(message.empty() || message.find("view (0, ") != std::string::npos) << message;
  }
  EXPECT_LT(peakMemoryMb(), 1000);
}

TEST(Reach, KeepsWhatLongRowsCanBeAskedFor)
{
  std::vector<double> positions;
  for (int i = 0; i < 100; ++i)
  {
    positions.push_back(i);
  }
  EXPECT_NO_THROW(checkReach({-40.0F, 40.0F}, rowAt(positions)));
}

TEST(Reach, RefusesPositionsBeyondAnyArray)
{
  EXPECT_NE(testing::messageOf<InputError>(
                [] {
                  rowAt({0.0, 1.0, 1e300});
                })
                .find("View (0, 2)"),
            std::string::npos);
}

TEST(ViewSet, TakesNoMoreMemoryThanTheImagesShow)
{
  ThreadPool pool(1);
  multiview::ViewSet near;
  multiview::ViewSet far;
  multiview::ViewSetSettings settings;
  settings.range = {-65.0F, 65.0F};
  const LightField light_field = rowAt({0.0, 1.0});
  multiview::prepareViews(light_field, settings, pool, near);
  settings.range = {-3e9F, 3e9F};
  multiview::prepareViews(light_field, settings, pool, far);
  EXPECT_EQ(multiview::visibleShift(-3e9, 64), -67.0);
  EXPECT_EQ(multiview::visibleShift(12.25, 64), 12.25);
  EXPECT_GE(far.reference.pad(), near.reference.pad());
  EXPECT_LE(far.reference.pad(), 64 + 16);
}

}  // namespace
}  // namespace light_field_depth
