#include "light_field_depth/core/view_layout.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/named_scenes.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
bool isLine(const LightField& light_field)
{
  bool row = true;
  bool column = true;
  for (const View& view : light_field.views)
  {
    row = row && view.grid.row == light_field.reference().grid.row;
    column = column && view.grid.column == light_field.reference().grid.column;
  }
  return row || column;
}

GridLayout expectedLayout(const LightField& light_field, const GridSymmetry& symmetry)
{
  return {symmetry.transposed, !isLine(light_field) && symmetry.rows_reversed != symmetry.columns_reversed};
}

TEST(ViewLayout, EachOfTheEightSymmetriesIsFoundOrLeftOpenInEveryNamedScene)
{
  ThreadPool pool(2);
  int decided = 0;
  int asked = 0;
  for (const testing::NamedScene& scene : testing::namedScenes())
  {
    const LightField light_field = scene.render().light_field;
    // Three of the eight for each scene, so that all of them occur with many scenes.
    for (int i = 0; i < 3; ++i)
    {
      const GridSymmetry symmetry = allGridSymmetries()[static_cast<std::size_t>(asked % 8)];
      const FoundLayout found = findLayout(relabelled(light_field, symmetry), pool);
      ++asked;
      decided += found.decided ? 1 : 0;
      EXPECT_TRUE(!found.decided || found.layout == expectedLayout(light_field, symmetry))
          << scene.name << ", transposed " << symmetry.transposed << ", rows " << symmetry.rows_reversed
          << ", columns " << symmetry.columns_reversed << ": ratio " << found.ratio << ", significance "
          << found.significance << ", match " << found.match;
    }
  }
  EXPECT_GE(decided, asked * 11 / 15);
}

LightField standardGrid(int rows, int columns)
{
  testing::SceneSettings settings;
  settings.positions = testing::gridPositions(rows, columns);
  return testing::renderScene(testing::standardScene(settings.size), settings).light_field;
}

TEST(ViewLayout, DoesNotDependOnTheNumberOfThreads)
{
  const LightField light_field = standardGrid(3, 3);
  ThreadPool one(1);
  ThreadPool three(3);
  EXPECT_EQ(findLayout(light_field, one).ratio, findLayout(light_field, three).ratio);
}

TEST(ViewLayout, TwoByTwoViewsAreEnough)
{
  ThreadPool pool(2);
  const LightField light_field = standardGrid(2, 2);
  for (const GridSymmetry& symmetry : allGridSymmetries())
  {
    const FoundLayout found = findLayout(relabelled(light_field, symmetry), pool);
    EXPECT_TRUE(found.decided);
    EXPECT_TRUE(found.layout == expectedLayout(light_field, symmetry));
  }
}

TEST(ViewLayout, UnrelatedOrConstantViewsAreLeftOpen)
{
  ThreadPool pool(2);
  std::vector<View> noise;
  std::vector<View> constant;
  cv::RNG random(5);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      cv::Mat image(96, 128, CV_8UC1);
      random.fill(image, cv::RNG::UNIFORM, 0, 256);
      noise.push_back(gridView(row, column, image));
      constant.push_back(gridView(row, column, cv::Mat(96, 128, CV_8UC3, cv::Scalar(90, 90, 90))));
    }
  }
  EXPECT_FALSE(findLayout(makeLightField(noise), pool).decided);
  EXPECT_FALSE(findLayout(makeLightField(constant), pool).decided);
}

TEST(ViewLayout, ViewsBesideTheRowAndTheColumnAreLeftOpen)
{
  ThreadPool pool(2);
  LightField diagonal = standardGrid(3, 3);
  diagonal.views = {diagonal.views[0], diagonal.views[4], diagonal.views[8]};
  diagonal.reference_index = 1;
  EXPECT_FALSE(findLayout(diagonal, pool).decided);
}

}  // namespace
}  // namespace light_field_depth
