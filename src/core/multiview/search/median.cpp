#include "core/multiview/search/median.h"

#include <algorithm>

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
constexpr int RADIUS = MEDIAN_SIZE / 2;  // of the window

}  // namespace

void MedianFilter::run(const cv::Mat& label, const LabelSpace& labels, ThreadPool& pool, cv::Mat& disparity)
{
  disparity.create(label.size(), CV_32FC1);
  const auto rowOf = [&](int y, std::vector<float>& scratch)
  {
    MedianRow row;
    for (int i = 0; i < MEDIAN_SIZE; ++i)
    {
      const int inside = std::clamp(y + i - RADIUS, 0, label.rows - 1);
      row.rows[static_cast<std::size_t>(i)] = label.ptr<float>(inside);
    }
    row.width = label.cols;
    row.scale = labels.step_px;
    row.offset = labels.first_px;
    row.sorted_columns = scratch.data();
    row.medians = disparity.ptr<float>(y);
    return row;
  };
  pool.parallelFor(0, label.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     scratch_.use(
                         [&](std::vector<float>& scratch)
                         {
                           scratch.resize(medianScratch(label.cols));
                           for (int y = first; y < last; ++y)
                           {
                             medianRow(rowOf(y, scratch));
                           }
                         });
                   });
}

}  // namespace light_field_depth::multiview
