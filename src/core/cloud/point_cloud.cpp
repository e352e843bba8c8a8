#include "light_field_depth/core/point_cloud.h"

#include <algorithm>
#include <limits>

#include "core/cloud/unprojection.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;

}  // namespace

void unprojectReference(const LightField& light_field, const cv::Mat& disparity, const cv::Mat& confidence,
                        float min_confidence, ThreadPool& pool, ColoredPoint* points)
{
  const LightField shown = toEightBit(light_field);
  const cloud::RowUnprojection unprojection(shown.reference(), *shown.calibration);
  constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       ColoredPoint* const row = points + static_cast<std::ptrdiff_t>(y) * disparity.cols;
                       for (int x = 0; x < disparity.cols; ++x)
                       {
                         const bool trusted = cloud::isTrusted(confidence, y, x, min_confidence);
                         row[x] = unprojection.point(y, x, trusted ? disparity.at<float>(y, x) : NaN);
                         row[x].confidence =
                             confidence.empty() ? 1.0F : std::max(confidence.at<float>(y, x), 0.0F);
                       }
                     }
                   });
}

}  // namespace light_field_depth
