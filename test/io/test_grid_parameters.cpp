#include <gtest/gtest.h>

#include <string>

#include "io/scene_folders.h"
#include "light_field_depth/io/dataset.h"

namespace light_field_depth
{
namespace
{
using testing::TemporaryFolder;

/// Views 1 to 3 of 5 rows and columns, and a param.txt.
Dataset readMiddle(const TemporaryFolder& folder, const std::string& parameters)
{
  for (int row = 1; row <= 3; ++row)
  {
    for (int column = 0; column <= 2; ++column)
    {
      testing::write(folder, testing::padded(row, 2) + "_" + testing::padded(column, 2) + ".png",
                     testing::RenderedScene::view(row, column));
    }
  }
  folder.write("param.txt", parameters);
  return readDataset(folder.path());
}

TEST(GridParameters, TheReferenceIsTheMiddleOfTheStatedGrid)
{
  for (const char* const parameters :
       {"num_x 5\nnum_y 5\n", "num_x = 5\r\nnum_y = 5\r\n", "\"num_x\": 5,\n\"num_y\": 5\n"})
  {
    const TemporaryFolder folder;
    const Dataset dataset = readMiddle(folder, parameters);
    EXPECT_EQ(dataset.light_field.reference().grid, (GridPosition{2, 2})) << parameters;
    ASSERT_FALSE(dataset.notes.empty());
    EXPECT_NE(dataset.notes.front().find("5 x 5"), std::string::npos) << dataset.notes.front();
    EXPECT_TRUE(dataset.warnings.empty());
  }
}

TEST(GridParameters, RowsStandAsFarApartAsIsSaid)
{
  const TemporaryFolder folder;
  const Dataset dataset = readMiddle(folder, "base_x 0.2\nbase_y 0.3\n");
  const View* const view = testing::viewAt(dataset.light_field, 1.0, 1.5);
  ASSERT_TRUE(view != nullptr);
  EXPECT_EQ(view->grid, (GridPosition{3, 2}));
}

TEST(GridParameters, AGridThatTheNamesContradictIsWarnedAbout)
{
  const TemporaryFolder folder;
  const Dataset dataset = readMiddle(folder, "num_x 2\nnum_y 2\n");
  EXPECT_EQ(dataset.light_field.views.size(), 9U);
  ASSERT_EQ(dataset.warnings.size(), 1U);
  EXPECT_NE(dataset.warnings.front().find("2 x 2"), std::string::npos) << dataset.warnings.front();
}

TEST(GridParameters, WhatSaysNothingOfAGridIsPassedOver)
{
  for (const char* const parameters :
       {"", "num_x nan\nnum_y inf\nbase_x 0\nbase_y 1\n", "num_x 1e99\nnum_y 3\n", "lr = 0.001\nepochs: 30\n",
        "base_x 1\nbase_y 50\n"})
  {
    const TemporaryFolder folder;
    const Dataset dataset = readMiddle(folder, parameters);
    EXPECT_EQ(dataset.light_field.views.size(), 9U) << parameters;
    EXPECT_TRUE(dataset.notes.empty()) << parameters;
    EXPECT_TRUE(dataset.warnings.empty()) << parameters;
    EXPECT_TRUE(testing::viewAt(dataset.light_field, 1, 1) != nullptr) << parameters;
  }
}

}  // namespace
}  // namespace light_field_depth
