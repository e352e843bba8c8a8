#include "support/named_scenes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "light_field_depth/core/disparity_range.h"
#include "light_field_depth/core/exposure.h"

namespace light_field_depth::testing
{
namespace
{
TEST(NamedScenes, AreSmallWholeAndToldApartByName)
{
  std::set<std::string> names;
  for (const NamedScene& scene : namedScenes())
  {
    SCOPED_TRACE(scene.name);
    EXPECT_TRUE(names.insert(scene.name).second);
    const SyntheticLightField rendered = scene.render();
    EXPECT_EQ(rendered.light_field.views.size(), scene.settings.positions.size());
    EXPECT_TRUE(cv::checkRange(rendered.truth));
    double min = 0.0;
    double max = 0.0;
    cv::minMaxIdx(rendered.truth, &min, &max);
    EXPECT_GT(max - min, 1.0) << "a scene without depth shows nothing";
  }
}

TEST(NamedScenes, HaveARangeThatIsFoundFromTheImages)
{
  ThreadPool pool(2);
  for (const NamedScene& scene : namedScenes())
  {
    const SyntheticLightField rendered = scene.render();
    const std::vector<ViewExposure> exposures = estimateExposure(rendered.light_field, pool);
    const DisparityRange range =
        findDisparityRange(compensateExposure(rendered.light_field, exposures, pool), pool);
    const cv::Mat covered = (rendered.truth >= range.min) & (rendered.truth <= range.max);
    double min = 0.0;
    double max = 0.0;
    cv::minMaxIdx(rendered.truth, &min, &max);
    SCOPED_TRACE(scene.name + ": found " + std::to_string(range.min) + " .. " + std::to_string(range.max) +
                 ", true " + std::to_string(min) + " .. " + std::to_string(max));
    EXPECT_GE(100.0 * cv::countNonZero(covered) / static_cast<double>(covered.total()), 95.0);
    EXPECT_LT(range.max - range.min, 1.8 * (max - min) + 1.0);
  }
}

}  // namespace
}  // namespace light_field_depth::testing
