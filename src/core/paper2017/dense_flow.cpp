#include "core/paper2017/dense_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "light_field_depth/core/error.h"

#ifdef LIGHT_FIELD_DEPTH_HAS_XIMGPROC
#include <opencv2/ximgproc/edge_filter.hpp>
#include <opencv2/ximgproc/sparse_match_interpolator.hpp>
#endif
#ifdef LIGHT_FIELD_DEPTH_HAS_OPTFLOW
#include <opencv2/optflow.hpp>
#endif

namespace light_field_depth
{
namespace
{
#ifdef LIGHT_FIELD_DEPTH_HAS_XIMGPROC
constexpr bool HAS_XIMGPROC = true;
#else
constexpr bool HAS_XIMGPROC = false;
#endif
#ifdef LIGHT_FIELD_DEPTH_HAS_OPTFLOW
constexpr bool HAS_OPTFLOW = true;
#else
constexpr bool HAS_OPTFLOW = false;
#endif

cv::Ptr<cv::DenseOpticalFlow> makeFlow(FlowInitializer initializer)
{
#ifdef LIGHT_FIELD_DEPTH_HAS_OPTFLOW
  if (initializer == FlowInitializer::DeepFlow)
  {
    return cv::optflow::createOptFlow_DeepFlow();
  }
  if (initializer == FlowInitializer::PcaFlow)
  {
    return cv::optflow::createOptFlow_PCAFlow();
  }
#endif
  CV_Assert(initializer == FlowInitializer::Dis);
  return cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
}

/// @param flow CV_32FC2
SeedMatches alongEpipolarLine(const cv::Mat& flow, const ViewPair& pair,
                              const std::optional<DisparityRange>& range)
{
  const cv::Size size = flow.size();
  SeedMatches matches;
  matches.columns_px.resize(static_cast<std::size_t>(size.width));
  matches.rows_px.resize(static_cast<std::size_t>(size.height));
  std::iota(matches.columns_px.begin(), matches.columns_px.end(), 0);
  std::iota(matches.rows_px.begin(), matches.rows_px.end(), 0);
  matches.cost = cv::Mat::zeros(size, CV_32FC1);
  matches.centre_share = cv::Mat::ones(size, CV_32FC1);
  matches.disparity.create(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      const auto& moved = flow.at<cv::Vec2f>(y, x);
      const cv::Point2d explained = cv::Point2d(moved[0], moved[1]) - pair.offset_px;
      const auto disparity = static_cast<float>(-explained.dot(pair.steps) / pair.steps.dot(pair.steps));
      const float known = std::isfinite(disparity) ? disparity : 0.0F;
      matches.disparity.at<float>(y, x) = range ? std::clamp(known, range->min, range->max) : known;
    }
  }
  return matches;
}

#ifdef LIGHT_FIELD_DEPTH_HAS_XIMGPROC
/// OpenCV's interpolation refuses more points than this.
constexpr std::size_t MAX_POINTS = std::numeric_limits<short>::max() - 1;
/// Of its default of 128 neighbours; fewer points than these tell nothing.
constexpr std::size_t MIN_POINTS = 16;

/// The points that take part, evenly thinned out where they are too many.
struct FlowPoints
{
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
};

FlowPoints pointsOf(const SparseDisparity& matches, int grid_spacing_px, const ViewPair& pair)
{
  FlowPoints points;
  int pitch = std::max(grid_spacing_px, 1);
  const auto in_grid = [&] { return matches.disparity.total() / static_cast<std::size_t>(pitch * pitch); };
  while (in_grid() > MAX_POINTS / 2 && matches.disparity.total() > MAX_POINTS)
  {
    ++pitch;
  }
  for (int y = pitch / 2; y < matches.disparity.rows; y += pitch)
  {
    for (int x = pitch / 2; x < matches.disparity.cols; x += pitch)
    {
      if (matches.confidence.at<float>(y, x) > 0.0F)
      {
        const cv::Point2d place(x, y);
        points.from.emplace_back(place);
        points.to.emplace_back(place + pair.offset_px - matches.disparity.at<float>(y, x) * pair.steps);
      }
    }
  }
  return points;
}

void replaceUnknown(const cv::Vec2f& value, cv::Mat& flow)
{
  for (int y = 0; y < flow.rows; ++y)
  {
    auto* const row = flow.ptr<cv::Vec2f>(y);
    std::replace_if(
        row, row + flow.cols, [](const cv::Vec2f& at) { return !std::isfinite(at[0] + at[1]); }, value);
  }
}
#endif

}  // namespace

std::optional<std::string> whatIsMissingFor(FlowInitializer initializer)
{
  const bool of_optflow = initializer == FlowInitializer::DeepFlow || initializer == FlowInitializer::PcaFlow;
  const bool missing =
      (of_optflow && !HAS_OPTFLOW) || (initializer == FlowInitializer::EpicFlow && !HAS_XIMGPROC);
  if (!missing)
  {
    return std::nullopt;
  }
  return "initializer is " + toString(initializer) + ", for which this build has no OpenCV module " +
         (of_optflow ? "optflow" : "ximgproc") +
         "; build with OpenCV's contributed modules, or choose cpm or dis.";
}

SeedMatches matchByFlow(const View& from, const View& to, FlowInitializer initializer,
                        const std::optional<DisparityRange>& range)
{
  cv::Mat flow;
  makeFlow(initializer)->calc(toGrey(from.image), toGrey(to.image), flow);
  return alongEpipolarLine(flow, pairOf(from, to), range);
}

SeedMatches spreadByEpicFlow(const View& from, const View& to, const SparseDisparity& matches,
                             int grid_spacing_px, const std::optional<DisparityRange>& range)
{
  const ViewPair pair = pairOf(from, to);
  cv::Mat flow = cv::Mat::zeros(from.image.size(), CV_32FC2);
#ifdef LIGHT_FIELD_DEPTH_HAS_XIMGPROC
  const FlowPoints points = pointsOf(matches, grid_spacing_px, pair);
  if (points.from.size() >= MIN_POINTS)
  {
    const auto inColour = [](const cv::Mat& image)
    {
      cv::Mat colour = image;
      if (image.channels() == 1)
      {
        cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
      }
      return colour;
    };
    const auto interpolator = cv::ximgproc::createEdgeAwareInterpolator();
    interpolator->setK(std::min(interpolator->getK(), static_cast<int>(points.from.size()) - 1));
    interpolator->setUsePostProcessing(false);
    const cv::Mat guide = inColour(from.image);
    interpolator->interpolate(guide, points.from, inColour(to.image), points.to, flow);
    // Far from all points their weights vanish, and what they are divided by; the smoothing would spread it.
    const cv::Scalar mean = cv::mean(points.to) - cv::mean(points.from);
    replaceUnknown({static_cast<float>(mean[0]), static_cast<float>(mean[1])}, flow);
    cv::ximgproc::fastGlobalSmootherFilter(guide, flow, flow, interpolator->getFGSLambda(),
                                           interpolator->getFGSSigma());
  }
#else
  static_cast<void>(matches);
  static_cast<void>(grid_spacing_px);
#endif
  return alongEpipolarLine(flow, pair, range);
}

}  // namespace light_field_depth
