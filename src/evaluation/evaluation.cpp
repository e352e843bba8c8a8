#include "light_field_depth/evaluation/evaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "evaluation/figure_text.h"
#include "evaluation/scored_pixels.h"

namespace light_field_depth
{
namespace
{
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
  const ScoredPixels scored = scorePixels(result, truth, mask, border_px);
  Evaluation evaluation;
  evaluation.mse_100 = 100.0 * meanSquare(scored.errors);
  evaluation.badpix_007 = percentageAbove(scored.errors, 0.07F);
  evaluation.badpix_003 = percentageAbove(scored.errors, 0.03F);
  evaluation.badpix_001 = percentageAbove(scored.errors, 0.01F);
  evaluation.q25 = 100.0 * quantile(scored.errors, 0.25);
  evaluation.coverage = static_cast<double>(scored.known) / static_cast<double>(scored.errors.size());
  return evaluation;
}

std::string toText(const Evaluation& evaluation)
{
  return figureText(namedFigures(evaluation));
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
