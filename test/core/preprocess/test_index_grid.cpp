#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "light_field_depth/core/index_grid.h"
#include "support/synthetic_scene.h"

namespace light_field_depth
{
namespace
{
constexpr int SIDE = 6;

/// Thumbnails of 6 x 6 views, row by row.
const std::vector<cv::Mat>& thumbnails()
{
  static const std::vector<cv::Mat> all = []
  {
    testing::SceneSettings settings;
    settings.size = {80, 64};
    settings.positions = testing::gridPositions(SIDE, SIDE);
    settings.samples = 1;
    std::vector<cv::Mat> small;
    for (const View& view :
         testing::renderScene(testing::standardScene(settings.size), settings).light_field.views)
    {
      small.push_back(thumbnailOf(view.image));
    }
    return small;
  }();
  return all;
}

std::vector<cv::Mat> inOrder(int count, const std::function<int(int)>& view_of)
{
  std::vector<cv::Mat> ordered;
  for (int i = 0; i < count; ++i)
  {
    ordered.push_back(thumbnails()[static_cast<std::size_t>(view_of(i))]);
  }
  return ordered;
}

int backAndForth(int index)
{
  const int row = index / SIDE;
  return row * SIDE + (row % 2 == 0 ? index % SIDE : SIDE - 1 - index % SIDE);
}

TEST(IndexGrid, FindsTheLengthOfARow)
{
  const RunLength run = findRunLength(thumbnails(), SIDE * SIDE);
  EXPECT_EQ(run.length, SIDE);
  EXPECT_FALSE(run.alternating);
  EXPECT_LT(run.dip, 0.75);
}

TEST(IndexGrid, FindsTheLengthOfARowThatIsNoSquare)
{
  const RunLength run = findRunLength(inOrder(4 * SIDE, [](int i) { return i; }), 4 * SIDE);
  EXPECT_EQ(run.length, SIDE);
  EXPECT_FALSE(run.alternating);
}

TEST(IndexGrid, FindsRowsThatAreNumberedBackAndForth)
{
  for (const int rows : {SIDE, 4})
  {
    const RunLength run = findRunLength(inOrder(rows * SIDE, backAndForth), rows * SIDE);
    EXPECT_EQ(run.length, SIDE);
    EXPECT_TRUE(run.alternating);
    EXPECT_LT(run.fold, 0.65);
  }
}

TEST(IndexGrid, ASingleRowIsNoGrid)
{
  const RunLength of_row = findRunLength(inOrder(4, [](int i) { return 2 * SIDE + i; }), 4);
  EXPECT_EQ(of_row.length, 4);
  const RunLength of_column = findRunLength(inOrder(SIDE, [](int i) { return i * SIDE + 2; }), SIDE);
  EXPECT_EQ(of_column.length, SIDE);
}

TEST(IndexGrid, ViewsThatAreAllAlikeTellNothing)
{
  EXPECT_EQ(findRunLength(inOrder(9, [](int) { return 0; }), 9).length, 0);
}

TEST(IndexGrid, FindsTheLengthOfARowAndWhereItBeginsWithViewsMissing)
{
  std::vector<cv::Mat> all = thumbnails();
  for (const int corner : {SIDE - 1, SIDE * (SIDE - 1)})
  {
    all[static_cast<std::size_t>(corner)] = cv::Mat();
  }
  const std::vector<cv::Mat> without_ends(all.begin() + 1, all.end() - 1);
  const RunLength run = findRunLengthWithGaps(without_ends, SIDE * SIDE - 2, 1);
  EXPECT_EQ(run.length, SIDE);
  EXPECT_EQ(run.first_place, 1);
  all[0] = cv::Mat();
  const std::vector<cv::Mat> without_start(all.begin() + 2, all.end());
  EXPECT_EQ(findRunLengthWithGaps(without_start, SIDE * SIDE - 2, SIDE).first_place, 2);
  EXPECT_EQ(findRunLengthWithGaps(without_start, SIDE * SIDE - 2, 0).first_place, 0);
}

TEST(IndexGrid, ASquareWithoutCornersIsToldByItsNumbers)
{
  std::vector<bool> present(23, true);  // of 5 x 5 from the second to the last but one
  present[3] = present[19] = false;
  EXPECT_EQ(findSquareWithoutCorners(present, 1).side, 5);
  EXPECT_EQ(findSquareWithoutCorners(present, 1).missing_before, 1);
  EXPECT_EQ(findSquareWithoutCorners(present, 0).side, 0);
  present[10] = false;
  EXPECT_EQ(findSquareWithoutCorners(present, 1).side, 0);
}

TEST(IndexGrid, AFewThumbnailsTellTheRowsOfManyViews)
{
  EXPECT_EQ(thumbnailsForRunLength(81), 38);
  EXPECT_EQ(thumbnailsForRunLength(9), 9);
}

TEST(IndexGrid, ThumbnailsAreSmallGreyAndOfOneScale)
{
  const cv::Mat thumbnail = thumbnailOf(cv::Mat(48, 96, CV_16UC3, cv::Scalar::all(1000)));
  EXPECT_EQ(thumbnail.size(), cv::Size(32, 16));
  EXPECT_EQ(thumbnail.type(), CV_32FC1);
  EXPECT_EQ(cv::mean(thumbnail)[0], 1000.0);
}

}  // namespace
}  // namespace light_field_depth
