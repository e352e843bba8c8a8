#include "light_field_depth/io/evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
constexpr int MAX_BORDER_PX = 65536;

std::string sizeText(const cv::Size& size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

void checkSizes(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px)
{
  CV_Assert(result.type() == CV_32FC1 && truth.type() == CV_32FC1 &&
            (mask.empty() || mask.type() == CV_8UC1));
  if (result.cols > truth.cols || result.rows > truth.rows)
  {
    throw InputError("The result has " + sizeText(result.size()) +
                     " pixels and is larger than the truth with " + sizeText(truth.size()) +
                     "; compare maps of the same light field.");
  }
  if (!mask.empty() && mask.size() != truth.size())
  {
    throw InputError("The mask has " + sizeText(mask.size()) + " pixels, the truth " +
                     sizeText(truth.size()) + "; give a mask in the size of the truth.");
  }
  if (border_px < 0 || border_px > MAX_BORDER_PX)
  {
    throw InputError("The border is " + std::to_string(border_px) + " px; it must be between 0 and " +
                     std::to_string(MAX_BORDER_PX) + ".");
  }
}

/// The pixels of the truth that are scored: those of the result that are not within the border.
cv::Rect scoredArea(const cv::Size& result_size, const cv::Size& truth_size, int border_px)
{
  const cv::Point margin((truth_size.width - result_size.width) / 2,
                         (truth_size.height - result_size.height) / 2);
  const cv::Point cut(std::max(border_px - margin.x, 0), std::max(border_px - margin.y, 0));
  const cv::Rect area(margin + cut, result_size - cv::Size(2 * cut.x, 2 * cut.y));
  if (area.width <= 0 || area.height <= 0)
  {
    throw InputError("A border of " + std::to_string(border_px) + " px leaves nothing of a map of " +
                     sizeText(result_size) + " pixels; choose a smaller one.");
  }
  return area;
}

float finiteSpan(const cv::Mat& truth)
{
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float value = truth.at<float>(y, x);
      if (std::isfinite(value))
      {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  return high - low;
}

struct Errors
{
  std::vector<float> values;
  std::size_t known = 0;
};

Errors collectErrors(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask)
{
  const float worst = finiteSpan(truth);
  Errors errors;
  errors.values.reserve(truth.total());
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float expected = truth.at<float>(y, x);
      if (!std::isfinite(expected) || (!mask.empty() && mask.at<std::uint8_t>(y, x) == 0))
      {
        continue;
      }
      const float value = result.at<float>(y, x);
      errors.values.push_back(std::isfinite(value) ? std::abs(value - expected) : worst);
      errors.known += std::isfinite(value) ? 1 : 0;
    }
  }
  if (errors.values.empty())
  {
    throw InputError("The mask and the truth leave no pixel to score; check that they belong together.");
  }
  return errors;
}

double percentageAbove(const std::vector<float>& errors, float threshold_px)
{
  const auto bad =
      std::count_if(errors.begin(), errors.end(), [&](float error) { return error > threshold_px; });
  return 100.0 * static_cast<double>(bad) / static_cast<double>(errors.size());
}

double meanSquare(const std::vector<float>& errors)
{
  double sum = 0.0;
  for (const float error : errors)
  {
    sum += static_cast<double>(error) * error;
  }
  return sum / static_cast<double>(errors.size());
}

/// With linear interpolation between the two nearest ranks.
double quantile(std::vector<float> values, double fraction)
{
  const double rank = fraction * static_cast<double>(values.size() - 1);
  const auto lower = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), lower, values.end());
  const double below = *lower;
  const double above = lower + 1 == values.end() ? below : *std::min_element(lower + 1, values.end());
  return below + (rank - std::floor(rank)) * (above - below);
}

std::array<std::pair<const char*, double>, 6> namedFigures(const Evaluation& evaluation)
{
  return {{{"mse_100", evaluation.mse_100},
           {"badpix_007", evaluation.badpix_007},
           {"badpix_003", evaluation.badpix_003},
           {"badpix_001", evaluation.badpix_001},
           {"q25", evaluation.q25},
           {"coverage", evaluation.coverage}}};
}

}  // namespace

Evaluation evaluate(const cv::Mat& result, const cv::Mat& truth, const cv::Mat& mask, int border_px)
{
  checkSizes(result, truth, mask, border_px);
  const cv::Rect area = scoredArea(result.size(), truth.size(), border_px);
  const cv::Point margin((truth.cols - result.cols) / 2, (truth.rows - result.rows) / 2);
  const Errors errors = collectErrors(result(area - margin), truth(area), mask.empty() ? mask : mask(area));
  Evaluation evaluation;
  evaluation.mse_100 = 100.0 * meanSquare(errors.values);
  evaluation.badpix_007 = percentageAbove(errors.values, 0.07F);
  evaluation.badpix_003 = percentageAbove(errors.values, 0.03F);
  evaluation.badpix_001 = percentageAbove(errors.values, 0.01F);
  evaluation.q25 = 100.0 * quantile(errors.values, 0.25);
  evaluation.coverage = static_cast<double>(errors.known) / static_cast<double>(errors.values.size());
  return evaluation;
}

std::string toText(const Evaluation& evaluation)
{
  std::string text;
  for (const auto& [name, value] : namedFigures(evaluation))
  {
    std::array<char, 64> figure{};
    std::snprintf(figure.data(), figure.size(), "%s %.3f", name, value);
    text += (text.empty() ? "" : "  ") + std::string(figure.data());
  }
  return text;
}

std::string toJson(const Evaluation& evaluation)
{
  std::string text;
  for (const auto& [name, value] : namedFigures(evaluation))
  {
    text.append(text.empty() ? "{" : ", ")
        .append(nlohmann::json(name).dump())
        .append(": ")
        .append(nlohmann::json(value).dump());
  }
  return text + "}";
}

}  // namespace light_field_depth
