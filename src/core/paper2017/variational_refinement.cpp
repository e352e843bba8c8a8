#include "core/paper2017/variational_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "core/paper2017/sor_solver.h"
#include "light_field_depth/core/enum_names.h"

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 16;
/// Of sqrt(s^2 + epsilon^2), which is |s| but for a rounded corner: epsilon is 0.001, as is usual (Brox et
/// al. 2004).
constexpr float PSI_EPSILON_SQUARED = 1e-6F;
/// Added to the squared gradients that normalise the data term, in grey levels.
constexpr float NORMALIZATION_SQUARED = 0.01F;

constexpr EnumNames<RefinementViews, 3> VIEWS_NAMES = {{
    {RefinementViews::All, "all"},
    {RefinementViews::Adjacent, "adjacent"},
    {RefinementViews::Outermost, "outermost"},
}};

/// Derivative of sqrt(squared + epsilon) with respect to `squared`.
float psiDerivative(float squared)
{
  return 0.5F / std::sqrt(squared + PSI_EPSILON_SQUARED);
}

cv::Mat derivative(const cv::Mat& image, int dx, int dy)
{
  static const cv::Matx<float, 1, 5> TAPS(1.0F / 12, -8.0F / 12, 0.0F, 8.0F / 12, -1.0F / 12);
  cv::Mat result;
  cv::filter2D(image, result, CV_32F, dx > 0 ? cv::Mat(TAPS) : cv::Mat(TAPS.t()), {-1, -1}, 0,
               cv::BORDER_REPLICATE);
  (void)dy;
  return result;
}

cv::Mat smoothedLuminance(const cv::Mat& image, double sigma)
{
  cv::Mat values;
  toGrey(image).convertTo(values, CV_32F);
  if (sigma > 0.0)
  {
    cv::GaussianBlur(values, values, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
  }
  return values;
}

/// CV_32FC2: d/dx and d/dy.
cv::Mat gradient(const cv::Mat& luminance)
{
  const std::array<cv::Mat, 2> parts = {derivative(luminance, 1, 0), derivative(luminance, 0, 1)};
  cv::Mat merged;
  cv::merge(parts.data(), parts.size(), merged);
  return merged;
}

/// Bilinear, the border pixels going on beyond the border.
cv::Vec2f sample(const cv::Mat& gradients, float x, float y)
{
  x = std::clamp(x, 0.0F, static_cast<float>(gradients.cols - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(gradients.rows - 1));
  const int left = std::min(static_cast<int>(x), gradients.cols - 2);
  const int top = std::min(static_cast<int>(y), gradients.rows - 2);
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  const auto* const upper = gradients.ptr<cv::Vec2f>(top) + left;
  const auto* const lower = gradients.ptr<cv::Vec2f>(top + 1) + left;
  return (upper[0] * (1 - u) + upper[1] * u) * (1 - v) + (lower[0] * (1 - u) + lower[1] * u) * v;
}

/// The same for a view that stands in the row (column) of the reference, where two of the four weights are
/// zero.
cv::Vec2f sampleInRow(const cv::Mat& gradients, float x, int y)
{
  x = std::clamp(x, 0.0F, static_cast<float>(gradients.cols - 1));
  const int left = std::min(static_cast<int>(x), gradients.cols - 2);
  const float u = x - static_cast<float>(left);
  const auto* const row = gradients.ptr<cv::Vec2f>(y) + left;
  return row[0] * (1 - u) + row[1] * u;
}

cv::Vec2f sampleInColumn(const cv::Mat& gradients, int x, float y)
{
  y = std::clamp(y, 0.0F, static_cast<float>(gradients.rows - 1));
  const int top = std::min(static_cast<int>(y), gradients.rows - 2);
  const float v = y - static_cast<float>(top);
  return gradients.ptr<cv::Vec2f>(top)[x] * (1 - v) + gradients.ptr<cv::Vec2f>(top + 1)[x] * v;
}

/// What a view sees at the pixel (x, y) of the reference.
cv::Vec2f sampleView(const View& view, const cv::Mat& gradients, int x, int y, float disparity)
{
  const auto steps_x = static_cast<float>(view.steps.x);
  const auto steps_y = static_cast<float>(view.steps.y);
  const auto offset_x = static_cast<float>(view.offset_px.x);
  const auto offset_y = static_cast<float>(view.offset_px.y);
  const float at_x = static_cast<float>(x) - disparity * steps_x + offset_x;
  const float at_y = static_cast<float>(y) - disparity * steps_y + offset_y;
  if (steps_y == 0.0F && offset_y == 0.0F)
  {
    return sampleInRow(gradients, at_x, y);
  }
  if (steps_x == 0.0F && offset_x == 0.0F)
  {
    return sampleInColumn(gradients, x, at_y);
  }
  return sample(gradients, at_x, at_y);
}

/// The problem of one light field.
class Refinement
{
public:
  Refinement(const LightField& light_field, const std::vector<std::size_t>& view_indices,
             const VariationalOptions& options, ThreadPool& pool);

  cv::Mat run(const cv::Mat& disparity);

private:
  void addData(const cv::Mat& disparity, GridSystem& system, int first_row, int last_row) const;
  void addLinks(const cv::Mat& disparity, GridSystem& system) const;

  const VariationalOptions& options_;
  ThreadPool& pool_;
  std::vector<View> views_;         ///< the compared views
  std::vector<cv::Mat> gradients_;  ///< CV_32FC2, of the compared views
  cv::Mat reference_gradient_;      ///< CV_32FC2
  cv::Mat second_x_;                ///< CV_32FC2: gradient of d/dx
  cv::Mat second_y_;                ///< CV_32FC2: gradient of d/dy
  cv::Mat edge_weight_;             ///< CV_32FC1
};

Refinement::Refinement(const LightField& light_field, const std::vector<std::size_t>& view_indices,
                       const VariationalOptions& options, ThreadPool& pool)
    : options_(options), pool_(pool)
{
  for (const std::size_t i : view_indices)
  {
    if (i != light_field.reference_index)
    {
      views_.push_back(light_field.views[i]);
    }
  }
  gradients_.resize(views_.size());
  pool.parallelFor(0, static_cast<int>(views_.size()), 1,
                   [&](int view, int)
                   {
                     const auto i = static_cast<std::size_t>(view);
                     gradients_[i] = gradient(smoothedLuminance(views_[i].image, options.presmoothing_px));
                   });
  const cv::Mat luminance = smoothedLuminance(light_field.reference().image, options.presmoothing_px);
  reference_gradient_ = gradient(luminance);
  std::array<cv::Mat, 2> parts;
  cv::split(reference_gradient_, parts.data());
  second_x_ = gradient(parts[0]);
  second_y_ = gradient(parts[1]);
  cv::Mat magnitude;
  const cv::Mat sharp = gradient(smoothedLuminance(light_field.reference().image, 0.0));
  cv::split(sharp, parts.data());
  cv::magnitude(parts[0], parts[1], magnitude);
  cv::exp(magnitude * (-options.edge_kappa / 255.0), edge_weight_);
  edge_weight_ *= options.smoothness;
}

void Refinement::addData(const cv::Mat& disparity, GridSystem& system, int first_row, int last_row) const
{
  const float weight = static_cast<float>(options_.gradient_weight);
  const float share = 1.0F / static_cast<float>(views_.size());
  for (int y = first_row; y < last_row; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const float d = disparity.at<float>(y, x);
      const auto own = reference_gradient_.at<cv::Vec2f>(y, x);
      const auto of_x = second_x_.at<cv::Vec2f>(y, x);
      const auto of_y = second_y_.at<cv::Vec2f>(y, x);
      const float norm_x = weight / (of_x.dot(of_x) + NORMALIZATION_SQUARED);
      const float norm_y = weight / (of_y.dot(of_y) + NORMALIZATION_SQUARED);
      float data = 0.0F;
      float right_side = 0.0F;
      for (std::size_t k = 0; k < views_.size(); ++k)
      {
        const cv::Vec2f steps(static_cast<float>(views_[k].steps.x), static_cast<float>(views_[k].steps.y));
        const cv::Vec2f warped = sampleView(views_[k], gradients_[k], x, y, d);
        const cv::Vec2f residual = warped - own;
        const float slope_x = -of_x.dot(steps);
        const float slope_y = -of_y.dot(steps);
        const float psi =
            share * psiDerivative(norm_x * residual[0] * residual[0] + norm_y * residual[1] * residual[1]);
        data += psi * (norm_x * slope_x * slope_x + norm_y * slope_y * slope_y);
        right_side -= psi * (norm_x * slope_x * residual[0] + norm_y * slope_y * residual[1]);
      }
      system.data.at<float>(y, x) = data;
      system.right_side.at<float>(y, x) = right_side + data * d;
    }
  }
}

void Refinement::addLinks(const cv::Mat& disparity, GridSystem& system) const
{
  const cv::Mat slopes = gradient(disparity);
  cv::Mat local(disparity.size(), CV_32FC1);
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const auto& slope = slopes.at<cv::Vec2f>(y, x);
      local.at<float>(y, x) = psiDerivative(slope.dot(slope)) * edge_weight_.at<float>(y, x);
    }
  }
  for (int y = 0; y < disparity.rows; ++y)
  {
    for (int x = 0; x < disparity.cols; ++x)
    {
      const float own = local.at<float>(y, x);
      system.link_right.at<float>(y, x) =
          x + 1 < disparity.cols ? 0.5F * (own + local.at<float>(y, x + 1)) : 0.0F;
      system.link_below.at<float>(y, x) =
          y + 1 < disparity.rows ? 0.5F * (own + local.at<float>(y + 1, x)) : 0.0F;
    }
  }
}

cv::Mat Refinement::run(const cv::Mat& disparity)
{
  cv::Mat refined = disparity.clone();
  const auto zeros = [&] { return cv::Mat::zeros(disparity.size(), CV_32FC1); };
  GridSystem system{zeros(), zeros(), zeros(), zeros()};
  for (int warp = 0; warp < options_.warps && !views_.empty(); ++warp)
  {
    pool_.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                      [&](int first, int last) { addData(refined, system, first, last); });
    addLinks(refined, system);
    solveBySor(system, options_.sor_iterations, static_cast<float>(options_.sor_omega), refined, pool_);
  }
  return refined;
}

}  // namespace

cv::Mat refineDisparity(const LightField& light_field, const std::vector<std::size_t>& view_indices,
                        const cv::Mat& disparity, const VariationalOptions& options, ThreadPool& pool)
{
  return Refinement(light_field, view_indices, options, pool).run(disparity);
}

std::vector<std::size_t> refinementViews(const LightField& light_field,
                                         const std::vector<std::size_t>& view_indices, RefinementViews views)
{
  if (views == RefinementViews::All)
  {
    return view_indices;
  }
  // For each direction, in eighths of a turn, the nearest or furthest view.
  std::map<int, std::size_t> chosen;
  for (const std::size_t i : view_indices)
  {
    const cv::Point2d steps = light_field.views[i].steps;
    if (i == light_field.reference_index || cv::norm(steps) < 1e-9)
    {
      continue;
    }
    const int direction = (cvRound(std::atan2(steps.y, steps.x) / (CV_PI / 4)) + 8) % 8;
    const auto found = chosen.find(direction);
    if (found == chosen.end())
    {
      chosen[direction] = i;
      continue;
    }
    const double before = cv::norm(light_field.views[found->second].steps);
    const bool further = cv::norm(steps) > before;
    if (further == (views == RefinementViews::Outermost))
    {
      found->second = i;
    }
  }
  std::vector<std::size_t> result;
  result.reserve(chosen.size());
  for (const auto& entry : chosen)
  {
    result.push_back(entry.second);
  }
  return result;
}

std::string toString(RefinementViews views)
{
  return enumName(VIEWS_NAMES, views);
}

RefinementViews refinementViewsFromString(const std::string& name)
{
  return enumValue(VIEWS_NAMES, name, "choice of refinement views");
}

std::vector<std::string> validate(const VariationalOptions& options)
{
  std::vector<std::string> problems;
  const auto require_between = [&](double value, double least, double most, const std::string& name)
  {
    if (!(value >= least && value <= most))
    {
      problems.push_back(name + " is " + std::to_string(value) + "; it must be between " +
                         std::to_string(least) + " and " + std::to_string(most) + ".");
    }
  };
  require_between(options.smoothness, 0.0, 1e6, "variational_smoothness");
  require_between(options.gradient_weight, 0.0, 1e6, "variational_gradient_weight");
  require_between(options.edge_kappa, 0.0, 1000.0, "variational_edge_kappa");
  require_between(options.presmoothing_px, 0.0, 10.0, "variational_presmoothing_px");
  require_between(options.warps, 0, 100, "variational_warps");
  require_between(options.sor_iterations, 1, 1000, "variational_sor_iterations");
  require_between(options.sor_omega, 0.1, 1.99, "variational_sor_omega");
  return problems;
}

}  // namespace light_field_depth
