#include "core/paper2017/disparity_paths.h"

#include <cmath>
#include <cstddef>

namespace light_field_depth
{
namespace
{
std::int32_t roundedPixel(double x, double y, const cv::Size& size)
{
  const int column = cvRound(x);
  const int row = cvRound(y);
  const bool inside = column >= 0 && row >= 0 && column < size.width && row < size.height;
  return inside ? row * size.width + column : PathLinks::NONE;
}

/// Where each pixel's path leads. @param sign 1 from the earlier view to the later, -1 back
std::int32_t destination(const ViewPair& pair, int sign, int x, int y, float disparity, const cv::Size& size)
{
  const double dx = sign * (pair.offset_px.x - disparity * pair.steps.x);
  const double dy = sign * (pair.offset_px.y - disparity * pair.steps.y);
  return roundedPixel(x + dx, y + dy, size);
}

void linkForward(const ViewPair& pair, const cv::Mat& disparity, const cv::Mat& known, PathLinks& links)
{
  const cv::Size size = disparity.size();
  const auto* const disparities = disparity.ptr<float>();
  for (int y = 0; y < size.height; ++y)
  {
    const auto* const row = disparity.ptr<float>(y);
    const auto* const known_row = known.ptr<float>(y);
    for (int x = 0; x < size.width; ++x)
    {
      const std::int32_t to =
          known_row[x] > 0.0F ? destination(pair, 1, x, y, row[x], size) : PathLinks::NONE;
      if (to == PathLinks::NONE)
      {
        continue;
      }
      std::int32_t& from = links.predecessor[static_cast<std::size_t>(to)];
      if (from == PathLinks::NONE || disparities[from] < row[x])
      {
        from = y * size.width + x;
      }
    }
  }
}

void linkHomeless(const ViewPair& pair, const cv::Mat& disparity, const cv::Mat& known, PathLinks& links)
{
  const cv::Size size = disparity.size();
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      std::int32_t& from =
          links.predecessor[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                            static_cast<std::size_t>(x)];
      if (from == PathLinks::NONE && known.at<float>(y, x) > 0.0F)
      {
        from = destination(pair, -1, x, y, disparity.at<float>(y, x), size);
      }
    }
  }
}

}  // namespace

PathLinks linkPaths(const ViewPair& pair, const cv::Mat& disparity, const cv::Mat& known,
                    const cv::Mat& backward_disparity, const cv::Mat& backward_known)
{
  PathLinks links;
  links.predecessor.assign(disparity.total(), PathLinks::NONE);
  links.successor.assign(disparity.total(), PathLinks::NONE);
  linkForward(pair, disparity, known, links);
  for (std::size_t i = 0; i < links.predecessor.size(); ++i)
  {
    if (links.predecessor[i] != PathLinks::NONE)
    {
      links.successor[static_cast<std::size_t>(links.predecessor[i])] = static_cast<std::int32_t>(i);
    }
  }
  std::vector<std::int32_t> forward = links.predecessor;
  linkHomeless(pair, backward_disparity, backward_known, links);
  for (std::size_t i = 0; i < links.predecessor.size(); ++i)
  {
    const std::int32_t from = links.predecessor[i];
    if (forward[i] == PathLinks::NONE && from != PathLinks::NONE &&
        links.successor[static_cast<std::size_t>(from)] == PathLinks::NONE)
    {
      links.successor[static_cast<std::size_t>(from)] = static_cast<std::int32_t>(i);
    }
  }
  return links;
}

}  // namespace light_field_depth
