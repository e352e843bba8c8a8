// Cameras that fail, lose images or come late.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <stereo_msgs/DisparityImage.h>

#include "array_fixture.h"
#include "light_field_depth/LightFieldDepthStats.h"

namespace light_field_depth::testing
{
namespace
{
using FailingCamerasTest = ArrayFixture;
using StatsListener = Listener<LightFieldDepthStats>;
using DiagnosticsListener = Listener<diagnostic_msgs::DiagnosticArray>;

const cv::Size SMALL(64, 48);

/// Publishes some views of set after set until the condition holds.
bool publishSome(ArrayPublisher& array, const std::function<ros::Time()>& stamp,
                 const std::function<bool(std::size_t)>& wanted, const std::function<bool()>& condition)
{
  return waitFor(
      [&]
      {
        const ros::Time now = stamp();
        array.publishInfos(now, wanted);
        array.publishImages(now, wanted);
        return waitFor(condition, std::chrono::milliseconds(50));
      });
}

TEST_F(FailingCamerasTest, AreDoneWithoutAndUsedAgain)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 1.0);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const DiagnosticsListener diagnostics(*array_space_, "/diagnostics");
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 0 && stats.newest()->views_used == 9; }));

  const auto without_corner = [](std::size_t view) { return view != 2; };
  EXPECT_TRUE(publishSome(
      array, [&] { return nextStamp(); }, without_corner, [&] { return stats.newest()->views_used == 8; }));
  const LightFieldDepthStats& partial = *stats.newest();
  EXPECT_FALSE(partial.used_by_view[2]);
  EXPECT_TRUE(partial.used_by_view[3]);
  EXPECT_GE(partial.sets_partial, 1U);
  EXPECT_TRUE(publishSome(
      array, [&] { return nextStamp(); }, without_corner,
      [&] {
        return diagnosed(diagnostics, {"View (0, 2) (view_0_2/image_rect_color)", "8 of 9 views"});
      }));
  EXPECT_TRUE(publishUntil(array, [&] { return stats.newest()->views_used == 9; })) << "it is back";
}

TEST_F(FailingCamerasTest, ThatNeverWorkedAreDoneWithout)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 0.5);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  EXPECT_TRUE(publishSome(
      array, [&] { return nextStamp(); }, [](std::size_t view) { return view != 8; },
      [&] { return stats.count() > 0; }));
  EXPECT_EQ(stats.newest()->views_used, 8U);
}

TEST_F(FailingCamerasTest, ThatAreTheReferenceAreAnError)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 0.5);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const DiagnosticsListener diagnostics(*array_space_, "/diagnostics");
  EXPECT_TRUE(publishSome(
      array, [&] { return nextStamp(); }, [](std::size_t view) { return view != 4; },
      [&] {
        return diagnosed(diagnostics, {"View (1, 1)", "reference view"});
      }));
  EXPECT_EQ(stats.count(), 0U);
}

TEST_F(FailingCamerasTest, MayLoseSingleImagesWhereAllowed)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(3, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("allow_incomplete", true);
  setParameter("keep_all", true);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  ASSERT_TRUE(publishUntil(array, [&] { return stats.count() > 0; }));
  const ros::Time broken = nextStamp();
  array.publishImages(broken, [](std::size_t view) { return view != 0; });
  EXPECT_TRUE(publishUntil(array, [&] { return stats.newest()->header.stamp > broken; }));
  bool used = false;
  for (const auto& frame : stats.all())
  {
    used = used || (frame->header.stamp == broken && frame->views_used == 8);
  }
  EXPECT_TRUE(used);
}

TEST_F(FailingCamerasTest, ThatComeLateGetAdviceAboutTheQueue)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  setParameter("patience", 1.0);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const DiagnosticsListener diagnostics(*array_space_, "/diagnostics");
  ASSERT_TRUE(waitFor([&] { return array.topicsHeard() == array.topics(); }));
  const bool told = waitFor(
      [&]
      {
        const ros::Time now = nextStamp();
        array.publishInfos(now, [](std::size_t) { return true; });
        array.publishImages(now, [](std::size_t view) { return view != 1; });
        array.publishImages(now - ros::Duration(1.0), [](std::size_t view) { return view == 1; });
        return waitFor(
            [&] {
              return diagnosed(diagnostics, {"View (0, 1)", "queue_size"});
            },
            std::chrono::milliseconds(20));
      });
  EXPECT_TRUE(told);
  EXPECT_EQ(stats.count(), 0U);
}

TEST_F(FailingCamerasTest, AreReportedByTheirShareOfIncompleteSets)
{
  const SyntheticLightField scene = syntheticArray(gridPositions(1, 3), SMALL);
  ArrayPublisher array(*array_space_, scene.light_field);
  startNode(scene.light_field);
  const StatsListener stats(*node_space_, "stats");
  const DiagnosticsListener diagnostics(*array_space_, "/diagnostics");
  int frame = 0;
  EXPECT_TRUE(waitFor(
      [&]
      {
        const bool whole = ++frame % 4 == 0;
        array.publishInfos(nextStamp(), [](std::size_t) { return true; });
        array.publishImages(stamp_, [whole](std::size_t view) { return whole || view != 2; });
        return waitFor(
            [&] {
              return diagnosed(diagnostics, {"lacked views", "View (0, 2)", "cable"});
            },
            std::chrono::milliseconds(20));
      }));
}

}  // namespace
}  // namespace light_field_depth::testing
