#include "light_field_depth/core/depth_sign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/multiview/multiview_estimator.h"
#include "light_field_depth/core/exposure.h"
#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth
{
namespace
{
/// Pixels to which the map's edges are right.
constexpr int EDGE_WIDTH_PX = 2;
/// Least width of what is hidden, and the largest that is looked at. Set by hand: less is lost among the
/// mixed pixels of the edge, and so far from an edge another one is likely.
constexpr float MIN_HIDDEN_PX = 1.5F;
constexpr int MAX_HIDDEN_PX = 12;
/// Of the jump: so flat must the map be on both sides, as far as one looks.
constexpr float MAX_SLOPE_SHARE = 0.25F;
/// Views in which near and far move apart by more show too much that the reference does not.
constexpr double MAX_RELATIVE_MOVE_PX = 12.0;
/// Of one edge, in terms of the noise: more of it is no better evidence, and less is none. Set by hand, like
/// the limits of DepthSignOptions on what `bench --order` reads.
constexpr float MAX_SCORE = 8.0F;
constexpr float MIN_SCORE = 1.5F;
/// In 8-bit levels, added to the noise: what interpolation and gloss leave.
constexpr float UNEXPLAINED = 2.0F;
/// Edges are long, and their pixels agree with each other: one vote for each part of the image.
constexpr int PARTS_PER_SIDE = 16;

/// The line of pixels along which an edge is looked at, and the views to both sides of the reference.
struct Line
{
  bool horizontal = true;
  const View* towards = nullptr;  ///< the view at positive steps along the line
  const View* away = nullptr;     ///< at negative steps
};

/// The two views on opposite sides of the reference that stand the farthest apart by equal steps, but no
/// more than so many unless there are no others.
std::optional<Line> lineOf(const LightField& light_field, bool horizontal, double max_steps)
{
  constexpr double MAX_INEQUALITY = 1.2;  // of the two distances, as in arrays that stand unevenly
  Line best{horizontal, nullptr, nullptr};
  double reach = 0.0;
  const auto along = [&](const View& view) { return horizontal ? view.steps.x : view.steps.y; };
  const auto across = [&](const View& view) { return horizontal ? view.steps.y : view.steps.x; };
  const auto is_on_line = [&](const View& view)
  { return std::abs(across(view)) < 0.05 * std::abs(along(view)); };
  for (const View& a : light_field.views)
  {
    for (const View& b : light_field.views)
    {
      const double nearer = std::min(along(a), -along(b));
      const double farther = std::max(along(a), -along(b));
      const bool better = reach > max_steps ? nearer < reach : nearer > reach && nearer <= max_steps;
      if (is_on_line(a) && is_on_line(b) && nearer > 0.0 && (better || reach == 0.0) &&
          farther < MAX_INEQUALITY * nearer)
      {
        reach = nearer;
        best.towards = &a;
        best.away = &b;
      }
    }
  }
  return reach > 0.0 ? std::make_optional(best) : std::nullopt;
}

/// The map, the images, and what the edges say.
class Votes
{
public:
  Votes(const LightField& light_field, const cv::Mat& disparity)
      : disparity_(disparity), reference_(light_field.reference().image),
        scale_(estimateNoise(reference_) + UNEXPLAINED)
  {
  }

  void look(const Line& line)
  {
    const cv::Size size = disparity_.size();
    const int reach = MAX_HIDDEN_PX + EDGE_WIDTH_PX;
    for (int y = 0; y < size.height; ++y)
    {
      for (int x = 0; x < size.width; ++x)
      {
        const int along = line.horizontal ? x : y;
        const int length = line.horizontal ? size.width : size.height;
        if (along >= reach && along + reach < length)
        {
          lookAt({x, y}, line);
        }
      }
    }
  }

  DepthSign count(const DepthSignOptions& options) const
  {
    std::vector<double> votes;
    for (const Part& part : parts_)
    {
      if (part.count >= MIN_EDGE_PIXELS)
      {
        const double mean = part.sum / part.count;
        if (std::abs(mean) > MIN_SCORE)
        {
          votes.push_back(mean);
        }
      }
    }
    DepthSign sign;
    sign.votes = static_cast<int>(votes.size());
    if (votes.size() < 2)
    {
      return sign;
    }
    const auto n = static_cast<double>(votes.size());
    double mean = 0.0;
    double squares = 0.0;
    for (const double vote : votes)
    {
      mean += vote / n;
      squares += vote * vote / n;
    }
    sign.share = static_cast<double>(
                     std::count_if(votes.begin(), votes.end(), [](double vote) { return vote > 0.0; })) /
                 n;
    sign.significance = mean / std::sqrt(std::max(squares - mean * mean, 1e-9) / (n - 1.0));
    sign.decided = sign.votes >= options.min_votes &&
                   std::max(sign.share, 1.0 - sign.share) >= options.min_share &&
                   std::abs(sign.significance) >= options.min_significance &&
                   (sign.share > 0.5) == (sign.significance > 0.0);
    sign.reversed = sign.decided && sign.share < 0.5;
    return sign;
  }

private:
  static constexpr int MIN_EDGE_PIXELS = 3;  // one or two may be an error of the map

  struct Part
  {
    double sum = 0.0;
    int count = 0;
  };

  float disparityAt(const cv::Point& pixel) const { return disparity_.at<float>(pixel); }

  /// Mean absolute difference between the reference and a view over the band of so many pixels that begins at
  /// `first` in the direction `step`, if one disparity holds for it; negative outside of the view.
  float misfit(const View& view, const cv::Point& first, const cv::Point& step, int width, float d) const
  {
    float sum = 0.0F;
    for (int i = 0; i < width; ++i)
    {
      const cv::Point pixel = first + i * step;
      const auto x = static_cast<float>(pixel.x - d * view.steps.x + view.offset_px.x);
      const auto y = static_cast<float>(pixel.y - d * view.steps.y + view.offset_px.y);
      const int left = cvFloor(x);
      const int top = cvFloor(y);
      if (left < 0 || top < 0 || left + 1 >= view.image.cols || top + 1 >= view.image.rows)
      {
        return -1.0F;
      }
      const float fx = x - static_cast<float>(left);
      const float fy = y - static_cast<float>(top);
      const auto* const upper = view.image.ptr<std::uint8_t>(top) + left;
      const auto* const lower = view.image.ptr<std::uint8_t>(top + 1) + left;
      const float value =
          (1 - fy) * ((1 - fx) * static_cast<float>(upper[0]) + fx * static_cast<float>(upper[1])) +
          fy * ((1 - fx) * static_cast<float>(lower[0]) + fx * static_cast<float>(lower[1]));
      sum += std::abs(value - static_cast<float>(reference_.at<std::uint8_t>(pixel)));
    }
    return sum / static_cast<float>(width);
  }

  void lookAt(const cv::Point& pixel, const Line& line)
  {
    const cv::Point step = line.horizontal ? cv::Point(1, 0) : cv::Point(0, 1);
    const float before = disparityAt(pixel - EDGE_WIDTH_PX * step);
    const float behind = disparityAt(pixel + EDGE_WIDTH_PX * step);
    const float jump = behind - before;
    const auto unit = static_cast<float>(line.horizontal ? line.towards->steps.x : line.towards->steps.y);
    const float hidden = std::abs(jump) * unit;
    if (hidden < MIN_HIDDEN_PX || !isSteepest(pixel, step, std::abs(jump)))
    {
      return;
    }
    const int width = std::min(static_cast<int>(hidden), MAX_HIDDEN_PX);
    if (!isFlat(pixel - EDGE_WIDTH_PX * step, -step, width, jump) ||
        !isFlat(pixel + EDGE_WIDTH_PX * step, step, width, jump))
    {
      return;
    }
    // The side of larger disparity moves against the steps: over the other side in the view towards which
    // that one lies.
    const bool larger_before = jump < 0.0F;
    const View& overlapping = larger_before ? *line.away : *line.towards;
    const View& opposite = larger_before ? *line.towards : *line.away;
    const cv::Point outwards = larger_before ? -step : step;  // on the side of larger disparity
    const float larger = std::max(before, behind);
    const float smaller = std::min(before, behind);
    const cv::Point larger_first = pixel + (larger_before ? 0 : 1) * step + outwards * 0;
    const cv::Point smaller_first = larger_first - outwards;
    const auto difference = [&](const View& view)
    {
      const float of_larger = misfit(view, larger_first, outwards, width, larger);
      const float of_smaller = misfit(view, smaller_first, -outwards, width, smaller);
      return of_larger < 0.0F || of_smaller < 0.0F ? std::nan("") : of_smaller - of_larger;
    };
    const auto score = static_cast<float>((difference(overlapping) - difference(opposite)) / scale_);
    if (std::isfinite(score))
    {
      const cv::Size size = disparity_.size();
      const int part_row = pixel.y * PARTS_PER_SIDE / size.height;
      const int index = part_row * PARTS_PER_SIDE + pixel.x * PARTS_PER_SIDE / size.width;
      Part& part = parts_[static_cast<std::size_t>(index)];
      part.sum += std::clamp(score, -MAX_SCORE, MAX_SCORE);
      ++part.count;
    }
  }

  /// The largest jump between neighbours stands here.
  bool isSteepest(const cv::Point& pixel, const cv::Point& step, float jump) const
  {
    const float here = std::abs(disparityAt(pixel + step) - disparityAt(pixel));
    return here > 0.5F * jump;
  }

  bool isFlat(const cv::Point& first, const cv::Point& step, int width, float jump) const
  {
    const float change = disparityAt(first + std::max(width - EDGE_WIDTH_PX, 1) * step) - disparityAt(first);
    return std::abs(change) < MAX_SLOPE_SHARE * std::abs(jump);
  }

  const cv::Mat& disparity_;
  const cv::Mat& reference_;
  float scale_;
  std::array<Part, static_cast<std::size_t>(PARTS_PER_SIDE* PARTS_PER_SIDE)> parts_;
};

/// The views at most so many grid steps from the reference: those farther away add little but occlusions.
LightField nearViews(const LightField& light_field)
{
  constexpr int MAX_GRID_STEPS = 4;  // the 9 x 9 views of the benchmark
  const GridPosition centre = light_field.reference().grid;
  std::vector<View> views;
  std::copy_if(light_field.views.begin(), light_field.views.end(), std::back_inserter(views),
               [&](const View& view)
               {
                 return std::abs(view.grid.row - centre.row) <= MAX_GRID_STEPS &&
                        std::abs(view.grid.column - centre.column) <= MAX_GRID_STEPS;
               });
  return views.size() < 3 ? light_field : makeLightField(std::move(views), centre);
}

/// Disparity from a search that knows nothing of near and far.
cv::Mat symmetricDisparity(const LightField& light_field, ThreadPool& pool)
{
  MultiviewOptions options;
  options.preset = MultiviewPreset::Realtime;
  options.visibility_passes = 0;
  options.background_fusion = false;
  options.boundary_pixels = false;
  options.refinements = 0;
  options.registration = false;  // takes longer than the map, and edges are looked at pixels wide
  MultiviewEstimator estimator(options);
  RunContext context(pool);
  return estimator.estimate(light_field, {}, context).disparity;
}

/// Between the nearest and the farthest twentieth of the image.
DisparityRange rangeOf(const cv::Mat& disparity)
{
  std::vector<float> values;
  for (int y = 0; y < disparity.rows; y += 4)
  {
    for (int x = 0; x < disparity.cols; x += 4)
    {
      values.push_back(disparity.at<float>(y, x));
    }
  }
  const auto twentieth = static_cast<std::ptrdiff_t>(values.size() / 20);
  std::nth_element(values.begin(), values.begin() + twentieth, values.end());
  const float least = values[static_cast<std::size_t>(twentieth)];
  std::nth_element(values.begin(), values.end() - 1 - twentieth, values.end());
  return {least, *(values.end() - 1 - twentieth)};
}

LightField inGrey(const LightField& light_field)
{
  LightField grey = light_field;
  for (View& view : grey.views)
  {
    view.image = toGrey(view.image);
  }
  return grey;
}

}  // namespace

DepthSign findDepthSign(const LightField& light_field, ThreadPool& pool, const DepthSignOptions& options)
{
  LightField near = nearViews(light_field);
  if (!lineOf(near, true, 0.0) && !lineOf(near, false, 0.0))
  {
    return {};
  }
  near = toEightBit(near);
  // What moves over what shows in brightness, which has to be the same in all views.
  near = compensateExposure(near, estimateExposure(near, pool), pool);
  const LightField grey = inGrey(near);
  const cv::Mat disparity = symmetricDisparity(near, pool);
  const DisparityRange range = rangeOf(disparity);
  const double max_steps = MAX_RELATIVE_MOVE_PX / std::max(range.max - range.min, 1e-3F);
  Votes votes(grey, disparity);
  for (const bool horizontal : {true, false})
  {
    if (const std::optional<Line> line = lineOf(grey, horizontal, max_steps))
    {
      votes.look(*line);
    }
  }
  DepthSign sign = votes.count(options);
  sign.range = range;
  return sign;
}

}  // namespace light_field_depth
