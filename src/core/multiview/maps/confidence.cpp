#include "core/multiview/maps/confidence.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/multiview/maps/confidence_kernels.h"
#include "core/multiview/maps/window_extent_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 32;

/// Least and largest disparity about the pixels of a row.
struct Extents
{
  explicit Extents(int width) : scratch(extentScratch(width)), low(static_cast<std::size_t>(width)), high(low)
  {
  }

  void find(const cv::Mat& disparity, int y, int radius)
  {
    ExtentRow row = extentRowOf(disparity, y, radius);
    row.columns = scratch.data();
    row.low = low.data();
    row.high = high.data();
    findExtents(row);
  }

  std::vector<float> scratch;
  std::vector<float> low;
  std::vector<float> high;
};

EvidenceRow rowOf(const ConfidenceEvidence& evidence, int y, const Extents& close, const Extents& wide)
{
  const Linearization& linear = evidence.linearization;
  EvidenceRow row;
  row.disparity = evidence.disparity.ptr<float>(y);
  row.searched = evidence.searched.ptr<float>(y);
  row.first_search = evidence.first_search.ptr<float>(y);
  row.target = linear.target.ptr<float>(y);
  row.weight = linear.weight.ptr<float>(y);
  row.disagreement = linear.disagreement.ptr<float>(y);
  row.residual = linear.residual.ptr<float>(y);
  row.low = close.low.data();
  row.high = close.high.data();
  row.wide_low = wide.low.data();
  row.wide_high = wide.high.data();
  row.noise_sigma = evidence.noise_sigma;
  row.width = evidence.disparity.cols;
  return row;
}

}  // namespace

void estimateConfidence(const ConfidenceEvidence& evidence, ThreadPool& pool, cv::Mat& confidence)
{
  const cv::Mat& disparity = evidence.disparity;
  confidence.create(disparity.size(), CV_32FC1);
  pool.parallelFor(0, confidence.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     Extents close(disparity.cols);
                     Extents wide(disparity.cols);
                     for (int y = first; y < last; ++y)
                     {
                       close.find(disparity, y, 1);
                       wide.find(disparity, y, 2);
                       auto* const row = confidence.ptr<float>(y);
                       weighEvidence(rowOf(evidence, y, close, wide), row);
                       for (int x = 0; x < confidence.cols; ++x)
                       {
                         row[x] = 1.0F / (1.0F + std::exp(row[x]));
                       }
                     }
                   });
}

}  // namespace light_field_depth::multiview
