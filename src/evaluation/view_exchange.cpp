#include "evaluation/view_exchange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "evaluation/textured_pixels.h"
#include "light_field_depth/core/noise_estimate.h"

namespace light_field_depth
{
namespace
{
/// Those that tell the most. Set by hand: the time grows with them.
constexpr std::size_t MAX_PIXELS = 600;
constexpr std::size_t MIN_PIXELS = 60;
/// Mean distance of their disparities from the mean, below which nothing moves by what can be seen. Set by
/// hand: the refinement is good to about this.
constexpr double MIN_SPREAD_PX = 0.02;
/// Neighbours of a view, and how much farther than the nearest one they may be: not along diagonals.
constexpr std::size_t MAX_NEIGHBOURS = 4;
constexpr double MAX_NEIGHBOUR_DISTANCE = 1.3;
/// Every fourth pixel decides alone where it is worse by this, in terms of the standard error.
constexpr std::size_t QUICK_PITCH = 4;
constexpr double CLEARLY_WORSE = -3.0;
constexpr int SHIFT_ROUNDS = 2;
/// Where the reference is one of the two: how many of the nearest views are asked, and the share that must
/// say so.
constexpr std::size_t MAX_VIEWS_ASKED = 6;
constexpr double MIN_SHARE_OF_VIEWS = 0.75;

/// What the pixels say of the places of views.
class PlaceTest
{
public:
  PlaceTest(std::vector<TexturedPixel> pixels) : pixels_(std::move(pixels))
  {
    for (const TexturedPixel& pixel : pixels_)
    {
      mean_disparity_ += pixel.disparity / static_cast<double>(pixels_.size());
    }
    const auto telling = [&](const TexturedPixel& pixel)
    { return pixel.contrast * std::abs(pixel.disparity - mean_disparity_); };
    const std::size_t count = std::min(pixels_.size(), MAX_PIXELS);
    std::nth_element(pixels_.begin(), pixels_.begin() + static_cast<std::ptrdiff_t>(count), pixels_.end(),
                     [&](const TexturedPixel& a, const TexturedPixel& b) { return telling(a) > telling(b); });
    pixels_.resize(count);
  }

  bool tells() const
  {
    double spread = 0.0;
    for (const TexturedPixel& pixel : pixels_)
    {
      spread += std::abs(pixel.disparity - mean_disparity_) / static_cast<double>(pixels_.size());
    }
    return pixels_.size() >= MIN_PIXELS && spread >= MIN_SPREAD_PX;
  }

  /// By how much a view matches better if it stands elsewhere, in terms of the standard error. A part of the
  /// pixels tells where it clearly does not, as in right light fields everywhere.
  double gain(const View& view, const cv::Point2d& elsewhere) const
  {
    if (pixels_.size() >= QUICK_PITCH * MIN_PIXELS)
    {
      const double quick = gainOf(view, elsewhere, QUICK_PITCH);
      if (quick < CLEARLY_WORSE)
      {
        return quick;
      }
    }
    return gainOf(view, elsewhere, 1);
  }

private:
  double gainOf(const View& view, const cv::Point2d& elsewhere, std::size_t pitch) const
  {
    const std::vector<float> here = mismatches(view, view.steps, {}, pitch);
    // What has the mean disparity is shown at the place that the view claims, or at that of the other one.
    const cv::Point2d held = mean_disparity_ * (elsewhere - view.steps);
    return std::max(significance(here, mismatches(view, elsewhere, {}, pitch)),
                    significance(here, mismatches(view, elsewhere, held, pitch)));
  }

  /// For every so-manieth pixel the difference over the contrast, at most 1; negative outside of the view.
  std::vector<float> mismatches(const View& view, const cv::Point2d& steps, cv::Point2d shift_px,
                                std::size_t pitch) const
  {
    Patch seen{};
    for (int round = 0; round < SHIFT_ROUNDS; ++round)
    {
      ShiftEquations equations;
      for (std::size_t i = 0; i < pixels_.size(); i += pitch)
      {
        if (readSeenPatch(view, pixels_[i], steps, shift_px, seen) &&
            tellsShift(pixels_[i], differenceOf(seen, pixels_[i].patch)))
        {
          equations.add(pixels_[i], seen);
        }
      }
      shift_px += equations.solve();
    }
    std::vector<float> values;
    for (std::size_t i = 0; i < pixels_.size(); i += pitch)
    {
      values.push_back(readSeenPatch(view, pixels_[i], steps, shift_px, seen)
                           ? std::min(differenceOf(seen, pixels_[i].patch) / pixels_[i].contrast, 1.0F)
                           : -1.0F);
    }
    return values;
  }

  /// Of the mean by which the second values are less.
  static double significance(const std::vector<float>& here, const std::vector<float>& elsewhere)
  {
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i)
    {
      if (here[i] >= 0.0F && elsewhere[i] >= 0.0F)
      {
        const double gain = here[i] - elsewhere[i];
        sum += gain;
        squares += gain * gain;
        ++count;
      }
    }
    const double variance = count > 0.0 ? squares / count - sum * sum / (count * count) : 0.0;
    return count >= static_cast<double>(MIN_PIXELS) && variance > 0.0 ? sum / std::sqrt(count * variance)
                                                                      : 0.0;
  }

  std::vector<TexturedPixel> pixels_;
  double mean_disparity_ = 0.0;
};

/// The other views, the nearest first.
std::vector<std::size_t> nearestOthers(const LightField& light_field, std::size_t index)
{
  const cv::Point2d place = light_field.views[index].steps;
  const auto distance = [&](std::size_t i) { return cv::norm(light_field.views[i].steps - place); };
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    if (i != index)
    {
      others.push_back(i);
    }
  }
  std::stable_sort(others.begin(), others.end(),
                   [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  return others;
}

std::vector<std::size_t> neighboursOf(const LightField& light_field, std::size_t index)
{
  const cv::Point2d place = light_field.views[index].steps;
  const auto distance = [&](std::size_t i) { return cv::norm(light_field.views[i].steps - place); };
  std::vector<std::size_t> others = nearestOthers(light_field, index);
  others.resize(std::min(others.size(), MAX_NEIGHBOURS));
  const double most = MAX_NEIGHBOUR_DISTANCE * distance(others.front());
  others.erase(
      std::remove_if(others.begin(), others.end(), [&](std::size_t i) { return distance(i) > most; }),
      others.end());
  return others;
}

std::vector<ViewExchange> neighbouringPairs(const LightField& light_field)
{
  std::vector<ViewExchange> pairs;
  for (std::size_t i = 0; i < light_field.views.size(); ++i)
  {
    for (const std::size_t other : neighboursOf(light_field, i))
    {
      const ViewExchange pair{std::min(i, other), std::max(i, other)};
      const bool known = std::any_of(pairs.begin(), pairs.end(),
                                     [&](const ViewExchange& listed)
                                     { return listed.first == pair.first && listed.second == pair.second; });
      if (!known && i != light_field.reference_index && other != light_field.reference_index)
      {
        pairs.push_back(pair);
      }
    }
  }
  return pairs;
}

/// Whether the reference stands at the place of a neighbour, as most of the other views tell.
double gainWithReferenceAt(const LightField& light_field, std::size_t neighbour, const PlaceTest& test)
{
  const cv::Point2d place = light_field.views[neighbour].steps;
  std::vector<double> gains;
  for (const std::size_t i : nearestOthers(light_field, light_field.reference_index))
  {
    if (i != neighbour && gains.size() < MAX_VIEWS_ASKED)
    {
      const View& view = light_field.views[i];
      gains.push_back(test.gain(view, view.steps - place));
    }
  }
  if (gains.size() < 2)
  {
    return 0.0;
  }
  const auto at = static_cast<std::ptrdiff_t>((1.0 - MIN_SHARE_OF_VIEWS) * static_cast<double>(gains.size()));
  std::nth_element(gains.begin(), gains.begin() + at, gains.end());
  return gains[static_cast<std::size_t>(at)];
}

void keepSignificant(std::vector<ViewExchange>& exchanges, double min_significance)
{
  exchanges.erase(
      std::remove_if(exchanges.begin(), exchanges.end(),
                     [&](const ViewExchange& exchange) { return exchange.significance < min_significance; }),
      exchanges.end());
}

}  // namespace

std::vector<ViewExchange> findExchanges(const LightField& light_field, const cv::Mat& disparity,
                                        double min_significance, ThreadPool& pool)
{
  constexpr std::size_t MIN_VIEWS = 4;  // with fewer there is no majority
  const cv::Mat& reference = light_field.reference().image;
  int looked_at = 0;
  const PlaceTest test(texturedPixels(reference, disparity, estimateNoise(reference), looked_at));
  if (light_field.views.size() < MIN_VIEWS || !test.tells())
  {
    return {};
  }
  std::vector<ViewExchange> with_reference;
  for (const std::size_t neighbour : neighboursOf(light_field, light_field.reference_index))
  {
    with_reference.push_back({neighbour, light_field.reference_index});
  }
  std::vector<ViewExchange> pairs = neighbouringPairs(light_field);
  const auto both = static_cast<int>(with_reference.size() + pairs.size());
  pool.parallelFor(0, both, 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       if (i < with_reference.size())
                       {
                         with_reference[i].significance =
                             gainWithReferenceAt(light_field, with_reference[i].first, test);
                         continue;
                       }
                       ViewExchange& pair = pairs[i - with_reference.size()];
                       const View& a = light_field.views[pair.first];
                       const View& b = light_field.views[pair.second];
                       pair.significance = test.gain(a, b.steps);
                       if (pair.significance >= min_significance)
                       {
                         pair.significance = std::min(pair.significance, test.gain(b, a.steps));
                       }
                     }
                   });
  keepSignificant(with_reference, min_significance);
  keepSignificant(pairs, min_significance);
  return with_reference.empty() ? pairs : with_reference;
}

}  // namespace light_field_depth
