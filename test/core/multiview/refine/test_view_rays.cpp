#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/multiview/refine/view_rays.h"
#include "support/synthetic_scene.h"

namespace light_field_depth::multiview
{
namespace
{
ViewSet viewSetOf(const std::vector<GridPosition>& positions, ThreadPool& pool)
{
  std::vector<View> views;
  for (const GridPosition& position : positions)
  {
    views.push_back(gridView(position.row, position.column, cv::Mat(20, 20, CV_8UC1, 100)));
  }
  ViewSet view_set;
  prepareViews(makeLightField(std::move(views)), {}, pool, view_set);
  return view_set;
}

TEST(ViewRays, OfACrossAreItsFourArms)
{
  ThreadPool pool(1);
  const ViewSet views = viewSetOf(testing::crossPositions(5, 5), pool);
  const ViewRays rays = findViewRays(views);
  ASSERT_EQ(rays.rays.size(), 4U);
  ASSERT_EQ(rays.of_arm.size(), 4U);
  for (const ViewRay& ray : rays.rays)
  {
    EXPECT_EQ(ray.last - ray.first, 2);
  }
}

TEST(ViewRays, OfAGridAreMoreThanItsArms)
{
  ThreadPool pool(1);
  const ViewSet views = viewSetOf(testing::gridPositions(5, 5), pool);
  const ViewRays rays = findViewRays(views);
  EXPECT_EQ(rays.of_arm.size(), 8U);
  EXPECT_EQ(rays.rays.size(), 16U);  // eight of two views, eight of one a knight's move away
  EXPECT_EQ(rays.views.size(), views.views.size());
  for (std::size_t ray = 0; ray < rays.rays.size(); ++ray)
  {
    for (int view = rays.rays[ray].first; view < rays.rays[ray].last; ++view)
    {
      const SampledView& sampled = rays.views[static_cast<std::size_t>(view)];
      EXPECT_NEAR(sampled.step_x, sampled.position * rays.directions[ray].x, 1e-5);
      EXPECT_NEAR(sampled.step_y, sampled.position * rays.directions[ray].y, 1e-5);
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
