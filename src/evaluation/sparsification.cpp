#include "light_field_depth/evaluation/sparsification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "evaluation/figure_text.h"
#include "evaluation/scored_pixels.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
constexpr float BAD_ERROR_PX = 0.07F;  // BadPix 0.07 of the HCI benchmark
constexpr int TENTH = SPARSIFICATION_STEPS / 10;

/// Indices of the pixels, the surest first.
std::vector<std::size_t> surestFirst(const std::vector<float>& confidence)
{
  std::vector<std::size_t> order(confidence.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return confidence[a] > confidence[b]; });
  return order;
}

/// The losses in the given order, each replaced by the mean of those of equal confidence.
std::vector<double> inOrder(const std::vector<double>& loss, const std::vector<std::size_t>& order,
                            const std::vector<float>& confidence)
{
  std::vector<double> sorted(order.size());
  for (std::size_t first = 0; first < order.size();)
  {
    std::size_t last = first;
    double sum = 0.0;
    while (last < order.size() && confidence[order[last]] == confidence[order[first]])
    {
      sum += loss[order[last]];
      ++last;
    }
    std::fill(sorted.begin() + static_cast<std::ptrdiff_t>(first),
              sorted.begin() + static_cast<std::ptrdiff_t>(last), sum / static_cast<double>(last - first));
    first = last;
  }
  return sorted;
}

/// Entry k - 1: the mean of the first k.
std::vector<double> meansOfFirst(std::vector<double> values)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    sum += values[i];
    values[i] = sum / static_cast<double>(i + 1);
  }
  return values;
}

/// What is left at each step of SPARSIFICATION_STEPS. @param kept entry k - 1: error of the k that are kept
std::vector<double> sampled(const std::vector<double>& kept)
{
  std::vector<double> samples;
  for (int step = 0; step < SPARSIFICATION_STEPS; ++step)
  {
    const double share = 1.0 - static_cast<double>(step) / SPARSIFICATION_STEPS;
    const auto count = std::lround(share * static_cast<double>(kept.size()));
    samples.push_back(kept[static_cast<std::size_t>(std::max(count, 1L) - 1)]);
  }
  return samples;
}

SparsificationCurve curveOf(std::vector<double> loss, const std::vector<std::size_t>& order,
                            const std::vector<float>& confidence)
{
  const std::vector<double> kept = meansOfFirst(inOrder(loss, order, confidence));
  std::sort(loss.begin(), loss.end());
  const std::vector<double> ideal = meansOfFirst(std::move(loss));
  SparsificationCurve curve;
  curve.error = sampled(kept);
  curve.ideal = sampled(ideal);
  const double area =
      std::inner_product(kept.begin(), kept.end(), ideal.begin(), 0.0, std::plus<>(), std::minus<>()) /
      static_cast<double>(kept.size());
  curve.ause = kept.back() > 0.0 ? area / kept.back() : 0.0;
  return curve;
}

std::vector<float> confidenceAt(const cv::Mat& confidence, const std::vector<cv::Point>& positions)
{
  std::vector<float> values;
  values.reserve(positions.size());
  for (const cv::Point& position : positions)
  {
    const float value = confidence.at<float>(position);
    values.push_back(std::isnan(value) ? -std::numeric_limits<float>::infinity() : value);
  }
  return values;
}

std::array<std::pair<const char*, double>, 4> namedFigures(const Sparsification& sparsification)
{
  return {{{"ause_mse", sparsification.mse_100.ause},
           {"ause_badpix_007", sparsification.badpix_007.ause},
           {"mse_100_without_tenth", withoutLeastConfidentTenth(sparsification.mse_100)},
           {"badpix_007_without_tenth", withoutLeastConfidentTenth(sparsification.badpix_007)}}};
}

}  // namespace

double withoutLeastConfidentTenth(const SparsificationCurve& curve)
{
  return curve.error[TENTH];
}

Sparsification sparsify(const cv::Mat& result, const cv::Mat& confidence, const cv::Mat& truth,
                        const cv::Mat& mask, int border_px)
{
  CV_Assert(confidence.type() == CV_32FC1);
  if (confidence.size() != result.size())
  {
    throw InputError("The confidence has " + std::to_string(confidence.cols) + " x " +
                     std::to_string(confidence.rows) + " pixels, the result " + std::to_string(result.cols) +
                     " x " + std::to_string(result.rows) + "; give the map that belongs to the result.");
  }
  const ScoredPixels scored = scorePixels(result, truth, mask, border_px);
  const std::vector<float> sureness = confidenceAt(confidence, scored.positions);
  const std::vector<std::size_t> order = surestFirst(sureness);
  constexpr double hundred = 100.0;
  std::vector<double> squared;
  std::vector<double> bad;
  squared.reserve(scored.errors.size());
  bad.reserve(scored.errors.size());
  for (const float error : scored.errors)
  {
    squared.push_back(hundred * error * error);
    bad.push_back(error > BAD_ERROR_PX ? hundred : 0.0);
  }
  return {curveOf(std::move(squared), order, sureness), curveOf(std::move(bad), order, sureness)};
}

std::string toText(const Sparsification& sparsification)
{
  return figureText(namedFigures(sparsification));
}

std::string toJson(const Sparsification& sparsification)
{
  nlohmann::json json;
  for (const auto& [name, value] : namedFigures(sparsification))
  {
    json[name] = value;
  }
  json["mse_100_curve"] = sparsification.mse_100.error;
  json["mse_100_ideal_curve"] = sparsification.mse_100.ideal;
  json["badpix_007_curve"] = sparsification.badpix_007.error;
  json["badpix_007_ideal_curve"] = sparsification.badpix_007.ideal;
  return json.dump();
}

}  // namespace light_field_depth
