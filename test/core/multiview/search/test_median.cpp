#include "core/multiview/search/median.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/multiview/search/median_kernels.h"
#include "support/random_rows.h"

namespace light_field_depth::multiview
{
namespace
{
TEST(Median, OfAMapRepeatsTheBordersOnAnyNumberOfThreads)
{
  const LabelSpace space{-2.0F, 0.125F, 9};
  const cv::Mat labels = testing::randomMap(37, 50, 0.0F, 8.0F);
  for (const int threads : {1, 3})
  {
    ThreadPool pool(threads);
    MedianFilter filter;
    cv::Mat disparity;
    filter.run(labels, space, pool, disparity);
    for (int y = 0; y < labels.rows; ++y)
    {
      for (int x = 0; x < labels.cols; ++x)
      {
        std::vector<float> window(static_cast<std::size_t>(MEDIAN_SIZE) * MEDIAN_SIZE);
        for (int i = 0; i < MEDIAN_SIZE * MEDIAN_SIZE; ++i)
        {
          window[static_cast<std::size_t>(i)] =
              labels.at<float>(std::clamp(y + i / MEDIAN_SIZE - 2, 0, labels.rows - 1),
                               std::clamp(x + i % MEDIAN_SIZE - 2, 0, labels.cols - 1));
        }
        std::sort(window.begin(), window.end());
        ASSERT_EQ(disparity.at<float>(y, x), space.disparity(window[window.size() / 2])) << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace light_field_depth::multiview
