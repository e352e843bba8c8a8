#include "light_field_depth/evaluation/verdict.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "light_field_depth/core/pipeline.h"
#include "support/mis_set_cases.h"
#include "support/named_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
Verdict judgedByResult(const LightField& field, const std::optional<DisparityRange>& range)
{
  static Pipeline pipeline(2);
  static ThreadPool pool(2);
  PipelineOptions options;
  options.multiview.preset = MultiviewPreset::Realtime;
  options.disparity_range = range;
  return judgeResult(field, pipeline.run(field, options, {}).estimate, pool);
}

Verdict judgedByOrder(const LightField& field, bool with_layout)
{
  static ThreadPool pool(2);
  return judgeOrder(field, pool, with_layout);
}

/// The cheap checks come first: most cases need no more.
bool isWarnedAbout(const LightField& field, const std::optional<DisparityRange>& range)
{
  return judgedByOrder(field, false).isDoubtful() || judgedByResult(field, range).isDoubtful() ||
         judgedByOrder(field, true).isDoubtful();
}

std::string warningsOf(const Verdict& verdict)
{
  std::string text;
  for (const std::string& warning : verdict.warnings())
  {
    text += "\n  " + warning;
  }
  return text;
}

TEST(Verdict, EveryMisSetCaseIsWarnedAbout)
{
  const LightField right = testing::rightScene().light_field;
  const std::vector<testing::MisSetCase> cases = testing::misSetCases();
  for (const testing::MisSetCase& mis_set : cases)
  {
    LightField field = right;
    mis_set.spoil(field);
    EXPECT_TRUE(isWarnedAbout(field, mis_set.range)) << mis_set.name;
  }
  EXPECT_GE(cases.size(), 40U);
}

void expectNoWarning(const LightField& field, const std::string& name)
{
  for (const Verdict& verdict : {judgedByOrder(field, true), judgedByResult(field, std::nullopt)})
  {
    EXPECT_FALSE(verdict.isDoubtful()) << name << warningsOf(verdict);
  }
}

TEST(Verdict, NoRightLightFieldIsWarnedAbout)
{
  expectNoWarning(testing::rightScene().light_field, "standard scene");
  // One of each kind of difficulty: repeats, no texture, large steps, noise, brightness, hiding, one row.
  for (testing::NamedScene scene :
       {testing::repeatedTexture(), testing::gradients(), testing::sparseArray(), testing::darkAndNoisy(),
        testing::exposureDifferences(), testing::strongOcclusion(), testing::singleRow()})
  {
    // Without mixed pixels at edges, which only a measure of accuracy needs.
    scene.settings.samples = 1;
    expectNoWarning(scene.render().light_field, scene.name);
  }
}

TEST(Verdict, AMapThatIsFilledForTheMostPartIsWarnedAbout)
{
  const testing::SyntheticLightField scene = testing::rightScene();
  const LightField& field = scene.light_field;
  ThreadPool pool(2);
  DisparityEstimate estimate;
  estimate.disparity = scene.truth;
  estimate.range = {-3.0F, 3.0F};
  estimate.filled = cv::Mat::zeros(field.size(), CV_8UC1);
  for (const auto& [share, warned] : {std::make_pair(0.7, false), std::make_pair(0.9, true)})
  {
    estimate.filled.rowRange(0, static_cast<int>(share * field.size().height)).setTo(255);
    const std::string warnings = warningsOf(judgeResult(field, estimate, pool));
    EXPECT_EQ(warnings.find("of the map is filled") != std::string::npos, warned) << warnings;
  }
}

TEST(Verdict, NamesTheViewThatIsOfAnotherScene)
{
  LightField field = testing::rightScene().light_field;
  testing::viewsOfOtherScene({testing::misSetIndex(2, 4)})(field);
  const std::string warnings = warningsOf(judgedByOrder(field, false));
  EXPECT_NE(warnings.find("view (2, 4)"), std::string::npos) << warnings;
}

TEST(Verdict, SaysWhichNeighboursAreSwapped)
{
  LightField field = testing::rightScene().light_field;
  testing::exchangeViews(testing::misSetIndex(2, 3), testing::misSetIndex(2, 4))(field);
  const std::string warnings = warningsOf(judgedByResult(field, std::nullopt));
  EXPECT_NE(warnings.find("view (2, 3) and view (2, 4) have changed places"), std::string::npos) << warnings;
}

TEST(Verdict, SaysWhereASwappedViewBelongs)
{
  LightField field = testing::rightScene().light_field;
  testing::exchangeViews(testing::misSetIndex(2, 0), testing::misSetIndex(2, 4))(field);
  const std::string warnings = warningsOf(judgedByOrder(field, false));
  EXPECT_NE(warnings.find("view (2, 0) fits the place (2, 4)"), std::string::npos) << warnings;
}

}  // namespace
}  // namespace light_field_depth
