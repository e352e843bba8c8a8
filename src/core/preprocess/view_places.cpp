#include "light_field_depth/core/view_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "core/preprocess/axis_sweep.h"
#include "core/preprocess/contrast_views.h"
#include "core/preprocess/layout_views.h"

namespace light_field_depth
{
namespace
{
/// The same as for the layout.
constexpr std::array<Displacements, 2> LABEL_SETS = {{{12.0F, 0.5F}, {2.5F, 0.125F}}};
/// Set by hand: the time grows with them.
constexpr int MAX_POINTS = 1500;
constexpr int MIN_POINTS = 200;
/// Samples in all; with many views fewer points have to do.
constexpr double MAX_SAMPLES = 1e7;
/// Of the points, that must be inside of a view.
constexpr double MIN_INSIDE = 0.25;
/// Least cost over mean cost of the displacements, above which nothing matches.
constexpr double MAX_MATCH = 0.6;
/// As in the sweeps (axis_sweep.cpp).
constexpr float TRUNCATION = 1.5F;
/// Costs below this are those of a perfect match.
constexpr double NEGLIGIBLE_COST = 0.05;

/// A point of the reference.
struct Point
{
  cv::Point2f pixel;
  float value = 0.0F;
  float displacement = 0.0F;  ///< in pixels of the contrast images for one grid step
};

struct Points
{
  std::vector<Point> points;
  double match = 1.0;
};

/// The sum of the costs along the row and along the column.
cv::Mat costsOf(const LightField& light_field, const std::vector<ContrastView>& views,
                const ContrastView& reference, int distance, const Displacements& displacements,
                ThreadPool& pool)
{
  cv::Mat sum;
  for (const bool row : {true, false})
  {
    const LineViews pair = viewsOnLine(light_field, row, distance);
    std::vector<SweptView> swept;
    for (std::size_t i = 0; i < pair.indices.size(); ++i)
    {
      swept.push_back({shiftedBack(views[pair.indices[i]]), pair.units[i]});
    }
    if (!swept.empty())
    {
      const cv::Mat costs = sweepAxis(reference.image, swept, row ? Axis::X : Axis::Y, displacements, pool);
      sum = sum.empty() ? costs : cv::Mat(sum + costs);
    }
  }
  return sum;
}

/// Where the parabola through three costs is least, in labels from the middle one.
float vertex(float before, float here, float behind)
{
  const float curvature = before - 2.0F * here + behind;
  return curvature > 1e-6F ? std::clamp(0.5F * (before - behind) / curvature, -0.5F, 0.5F) : 0.0F;
}

float gradientAt(const cv::Mat& image, int x, int y)
{
  const int left = std::max(x - 1, 0);
  const int right = std::min(x + 1, image.cols - 1);
  const int top = std::max(y - 1, 0);
  const int bottom = std::min(y + 1, image.rows - 1);
  return std::hypot(image.at<float>(y, right) - image.at<float>(y, left),
                    image.at<float>(bottom, x) - image.at<float>(top, x));
}

/// The points that tell their displacement best.
Points pointsFrom(const cv::Mat& costs, const cv::Mat& reference, int distance,
                  const Displacements& displacements, std::size_t most)
{
  const int width = reference.cols / CELL_SIDE_PX;
  std::vector<float> least(static_cast<std::size_t>(costs.cols), 1e9F);
  std::vector<float> mean(least.size(), 0.0F);
  std::vector<int> best(least.size(), 0);
  for (int label = 0; label < costs.rows; ++label)
  {
    const auto* const row = costs.ptr<float>(label);
    for (std::size_t i = 0; i < least.size(); ++i)
    {
      mean[i] += row[i] / static_cast<float>(costs.rows);
      if (row[i] < least[i])
      {
        least[i] = row[i];
        best[i] = label;
      }
    }
  }
  std::vector<float> worth(least.size(), 0.0F);
  for (std::size_t i = 0; i < least.size(); ++i)
  {
    const int x = static_cast<int>(i) % width * CELL_SIDE_PX;
    const int y = static_cast<int>(i) / width * CELL_SIDE_PX;
    worth[i] = (mean[i] - least[i]) * gradientAt(reference, x, y);
  }
  std::vector<std::size_t> order(least.size());
  std::iota(order.begin(), order.end(), 0U);
  const std::size_t count = std::min(most, order.size());
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count) - 1, order.end(),
                   [&](std::size_t a, std::size_t b)
                   { return worth[a] != worth[b] ? worth[a] > worth[b] : a < b; });
  Points result;
  for (std::size_t n = 0; n < count; ++n)
  {
    const std::size_t i = order[n];
    const int x = static_cast<int>(i) % width * CELL_SIDE_PX;
    const int y = static_cast<int>(i) / width * CELL_SIDE_PX;
    const int label = best[i];
    const auto at = [&](int l)
    { return costs.at<float>(std::clamp(l, 0, costs.rows - 1), static_cast<int>(i)); };
    const float displacement =
        displacements.at(label) + displacements.step * vertex(at(label - 1), at(label), at(label + 1));
    result.points.push_back({cv::Point2f(static_cast<float>(x), static_cast<float>(y)),
                             reference.at<float>(y, x), displacement / static_cast<float>(distance)});
  }
  result.match = cv::sum(cv::Mat(least))[0] / std::max(cv::sum(cv::Mat(mean))[0], 1e-9);
  return result;
}

/// The displacements of the distance that shows them best.
std::optional<Points> findPoints(const LightField& light_field, const std::vector<ContrastView>& views,
                                 std::size_t most, ThreadPool& pool)
{
  const ContrastView& reference = views[light_field.reference_index];
  std::optional<Points> best;
  double most_telling = 0.0;
  for (const int distance : layoutDistances(light_field))
  {
    for (const Displacements& displacements : LABEL_SETS)
    {
      const cv::Mat costs = costsOf(light_field, views, reference, distance, displacements, pool);
      if (costs.empty())
      {
        continue;
      }
      Points points = pointsFrom(costs, reference.image, distance, displacements, most);
      const double telling = (1.0 - points.match) * cv::mean(costs)[0];
      if (telling > most_telling)
      {
        most_telling = telling;
        best = std::move(points);
      }
    }
  }
  return best;
}

/// Mean difference of a view from the reference at the points, as if it stood at `steps`.
double costAt(const ContrastView& view, const cv::Point2f& steps, const std::vector<Point>& points)
{
  double sum = 0.0;
  int inside = 0;
  for (const Point& point : points)
  {
    const cv::Point2f place = point.pixel - point.displacement * steps + view.offset;
    float value = 0.0F;
    if (sampleContrast(view.image, place.x, place.y, value))
    {
      sum += std::min(std::abs(value - point.value), TRUNCATION);
      ++inside;
    }
  }
  return inside >= MIN_INSIDE * static_cast<double>(points.size()) ? sum / inside : TRUNCATION;
}

/// Costs of one view.
struct PlaceCosts
{
  double own = 0.0;
  double best = 0.0;
  std::size_t best_place = 0;
};

std::vector<PlaceCosts> costsOfPlaces(const LightField& light_field, const std::vector<ContrastView>& views,
                                      const std::vector<Point>& points, ThreadPool& pool)
{
  std::vector<PlaceCosts> result(views.size());
  pool.parallelFor(0, static_cast<int>(views.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto v = static_cast<std::size_t>(first); v < static_cast<std::size_t>(last); ++v)
                     {
                       PlaceCosts& costs = result[v];
                       costs.own = costAt(views[v], cv::Point2f(light_field.views[v].steps), points);
                       costs.best = costs.own;
                       costs.best_place = v;
                       for (std::size_t place = 0; place < views.size(); ++place)
                       {
                         const double cost =
                             costAt(views[v], cv::Point2f(light_field.views[place].steps), points);
                         if (cost < costs.best)
                         {
                           costs.best = cost;
                           costs.best_place = place;
                         }
                       }
                     }
                   });
  return result;
}

ViewPlaces judge(const LightField& light_field, const std::vector<PlaceCosts>& costs,
                 const ViewPlacesOptions& options)
{
  ViewPlaces places;
  places.checked = true;
  std::vector<double> best;
  for (std::size_t v = 0; v < costs.size(); ++v)
  {
    if (v != light_field.reference_index)
    {
      best.push_back(costs[v].best);
    }
  }
  std::nth_element(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(best.size() / 2), best.end());
  places.median_cost = best[best.size() / 2];
  for (std::size_t v = 0; v < costs.size(); ++v)
  {
    if (v == light_field.reference_index)
    {
      continue;
    }
    const PlaceCosts& cost = costs[v];
    const View& place = light_field.views[cost.best_place];
    const cv::Point2d away = place.steps - light_field.views[v].steps;
    ViewDoubt doubt{v, ViewDoubt::Kind::Foreign, place.grid, cost.own, cost.best};
    if (cost.best > options.min_foreign_cost && cost.best > options.min_foreign_ratio * places.median_cost)
    {
      places.doubts.push_back(doubt);
    }
    else if (cost.own > options.min_misplaced_ratio * (cost.best + NEGLIGIBLE_COST) &&
             std::hypot(away.x, away.y) >= options.min_steps_away - 0.1)
    {
      doubt.kind = ViewDoubt::Kind::Misplaced;
      places.doubts.push_back(doubt);
    }
  }
  return places;
}

/// The light field with another reference view, at whose place the steps begin.
LightField seenFrom(const LightField& light_field, std::size_t reference)
{
  LightField result = light_field;
  result.reference_index = reference;
  const cv::Point2d steps = light_field.views[reference].steps;
  const cv::Point2d offset = light_field.views[reference].offset_px;
  for (View& view : result.views)
  {
    view.steps -= steps;
    view.offset_px -= offset;
  }
  return result;
}

ViewPlaces checkFrom(const LightField& light_field, ThreadPool& pool, const ViewPlacesOptions& options)
{
  std::vector<std::size_t> all(light_field.views.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<ContrastView> views = contrastViews(light_field, all, pool);
  const auto count = static_cast<double>(views.size());
  const auto most =
      static_cast<std::size_t>(std::clamp(MAX_SAMPLES / (count * count), 1.0 * MIN_POINTS, 1.0 * MAX_POINTS));
  const std::optional<Points> points = findPoints(light_field, views, most, pool);
  if (!points || points->match > MAX_MATCH)
  {
    return {};
  }
  return judge(light_field, costsOfPlaces(light_field, views, points->points, pool), options);
}

/// The view nearest to the reference.
std::size_t neighbourOf(const LightField& light_field)
{
  std::size_t nearest = 0;
  double least = 1e9;
  for (std::size_t v = 0; v < light_field.views.size(); ++v)
  {
    const double distance = std::hypot(light_field.views[v].steps.x, light_field.views[v].steps.y);
    if (v != light_field.reference_index && distance < least)
    {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

double shareOfDoubts(const ViewPlaces& places, const LightField& light_field)
{
  return static_cast<double>(places.doubts.size()) / static_cast<double>(light_field.views.size() - 1);
}

}  // namespace

ViewPlaces checkViewPlaces(const LightField& light_field, ThreadPool& pool, const ViewPlacesOptions& options)
{
  constexpr std::size_t MIN_VIEWS = 4;  // with fewer there is no majority
  if (light_field.views.size() < MIN_VIEWS)
  {
    return {};
  }
  ViewPlaces places = checkFrom(light_field, pool, options);
  if (places.checked && shareOfDoubts(places, light_field) < options.min_shuffled_share)
  {
    return places;
  }
  ViewPlaces second = checkFrom(seenFrom(light_field, neighbourOf(light_field)), pool, options);
  if (second.checked && shareOfDoubts(second, light_field) < options.min_shuffled_share)
  {
    return second;
  }
  places.shuffled = places.checked;
  return places;
}

}  // namespace light_field_depth
