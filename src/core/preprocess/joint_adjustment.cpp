#include "core/preprocess/joint_adjustment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <opencv2/imgproc.hpp>

#include "core/preprocess/normal_equations.h"

namespace light_field_depth
{
namespace
{
/// Shift along x and y, roll, zoom.
constexpr int PER_VIEW = 4;
/// Of one task. Set by hand: sums over points are in this order whatever the number of threads.
constexpr int POINTS_PER_CHUNK = 64;
/// No step changes a disparity by more, in pixels of the farthest view.
constexpr float MAX_MOTION_PX = 1.0F;
/// Of Gauss and Newton, for one disparity.
constexpr int SETTLING_STEPS = 3;

/// Value and slopes of an image at a place, of pixels (value, slope along x, slope along y).
cv::Vec3f sampleAt(const cv::Mat& image, float x, float y)
{
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float u = x - static_cast<float>(left);
  const float v = y - static_cast<float>(top);
  const cv::Vec3f* const above = image.ptr<cv::Vec3f>(top) + left;
  const cv::Vec3f* const below = image.ptr<cv::Vec3f>(top + 1) + left;
  return (above[0] * (1 - u) + above[1] * u) * (1 - v) + (below[0] * (1 - u) + below[1] * u) * v;
}

/// Smoothed by 1 2 1, so that slopes hold over a pixel and noise counts less.
cv::Mat withSlopes(const cv::Mat& grey)
{
  const cv::Matx13f smooth(0.25F, 0.5F, 0.25F);
  const cv::Matx13f slope(-0.5F, 0.0F, 0.5F);
  const cv::Matx13f none(0.0F, 1.0F, 0.0F);
  std::array<cv::Mat, 3> planes;
  cv::sepFilter2D(grey, planes[0], CV_32F, smooth, smooth, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(planes[0], planes[1], CV_32F, slope, none);
  cv::sepFilter2D(planes[0], planes[2], CV_32F, none, slope);
  cv::Mat result;
  cv::merge(planes.data(), planes.size(), result);
  return result;
}

/// What the views say at one point.
struct PointView
{
  float weight = 0.0F;  ///< 0: does not see it
  float difference = 0.0F;
  float along = 0.0F;  ///< change of the difference with the disparity
  std::array<float, PER_VIEW> own = {};
  float ratio = 0.0F;  ///< change with the ratio of steps
};

/// The equation of a point's disparity without the other unknowns.
struct Alone
{
  float own = 1.0F;
  float side = 0.0F;
};

class Adjuster
{
public:
  Adjuster(const SlopedViews& views, double expected_px, ThreadPool& pool, Adjustment& adjustment)
      : field_(views.light_field), pool_(pool), adjustment_(adjustment), images_(views.images),
        middle_(0.5F * static_cast<float>(field_.size().width - 1),
                0.5F * static_cast<float>(field_.size().height - 1)),
        radius_(0.5F * std::hypot(static_cast<float>(field_.size().width),
                                  static_cast<float>(field_.size().height))),
        expected_px_(static_cast<float>(expected_px))
  {
    for (std::size_t i = 0; i < field_.views.size(); ++i)
    {
      if (i != field_.reference_index)
      {
        others_.push_back(i);
        widest_ = std::max(widest_,
                           static_cast<float>(std::hypot(field_.views[i].steps.x, field_.views[i].steps.y)));
      }
    }
    unknowns_ = PER_VIEW * static_cast<int>(others_.size()) + 1;
    stride_ = NormalEquations::strideOf(unknowns_);
    reference_ = others_.empty() ? cv::Mat() : images_[field_.reference_index];
  }

  void step()
  {
    const float scale = differenceScale();
    const int count = static_cast<int>(adjustment_.points.size());
    const int chunks = (count + POINTS_PER_CHUNK - 1) / POINTS_PER_CHUNK;
    std::vector<NormalEquations> parts(static_cast<std::size_t>(chunks), NormalEquations(unknowns_));
    couplings_.assign(static_cast<std::size_t>(count) * static_cast<std::size_t>(stride_), 0.0F);
    alone_.resize(static_cast<std::size_t>(count));
    pool_.parallelFor(0, count, POINTS_PER_CHUNK,
                      [&](int first, int last)
                      {
                        for (int i = first; i < last; ++i)
                        {
                          addPoint(i, scale, parts[static_cast<std::size_t>(first / POINTS_PER_CHUNK)]);
                        }
                      });
    apply(solve(parts, scale));
  }

  /// Lets each point take the disparity that fits it best. @return how badly the points fit then
  double settle(float scale)
  {
    const std::size_t count = adjustment_.points.size();
    const std::size_t chunks = (count + POINTS_PER_CHUNK - 1) / POINTS_PER_CHUNK;
    std::vector<double> sums(chunks, 0.0);
    pool_.parallelFor(0, static_cast<int>(count), POINTS_PER_CHUNK,
                      [&](int first, int last)
                      {
                        double& sum = sums[static_cast<std::size_t>(first / POINTS_PER_CHUNK)];
                        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last);
                             ++i)
                        {
                          sum += settlePoint(scale, adjustment_.points[i]);
                        }
                      });
    return std::accumulate(sums.begin(), sums.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(count, 1));
  }

  /// The robust scale of the differences, from some of the points.
  float differenceScale() const
  {
    std::vector<float> differences;
    const std::size_t stride = 1 + adjustment_.points.size() / 256;
    for (std::size_t i = 0; i < adjustment_.points.size(); i += stride)
    {
      for (const std::size_t view : others_)
      {
        const PointView seen = look(adjustment_.points[i], view, 1e6F);
        if (seen.weight > 0.0F)
        {
          differences.push_back(std::abs(seen.difference));
        }
      }
    }
    if (differences.empty())
    {
      return 1.0F;
    }
    const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
    std::nth_element(differences.begin(), middle, differences.end());
    // Of a normal distribution: its standard deviation over the median of its magnitude.
    constexpr float deviations_of_median = 1.4826F;
    // What rounding to whole levels adds: sqrt(1 / 12), the deviation of a number that is uniform over one.
    constexpr float rounding = 0.3F;
    return deviations_of_median * *middle + rounding;
  }

private:
  /// @return the mean over the views that see the point
  double settlePoint(float scale, AdjustedPoint& point) const
  {
    const float most = MAX_MOTION_PX / widest_;
    for (int step = 0; step < SETTLING_STEPS; ++step)
    {
      float own = 1e-3F * scale * scale;
      float side = 0.0F;
      for (const std::size_t view : others_)
      {
        const PointView seen = look(point, view, scale);
        own += seen.weight * seen.along * seen.along;
        side += seen.weight * seen.along * seen.difference;
      }
      point.disparity -= std::clamp(side / own, -most, most);
    }
    double sum = 0.0;
    int views = 0;
    for (const std::size_t view : others_)
    {
      const PointView seen = look(point, view, scale);
      if (seen.weight > 0.0F)
      {
        sum -= std::log(seen.weight);
        ++views;
      }
    }
    return views > 0 ? sum / views : 0.0;
  }

  PointView look(const AdjustedPoint& point, std::size_t index, float scale) const
  {
    const View& view = field_.views[index];
    const ViewMisfit& misfit = adjustment_.views[index];
    const auto step_x = static_cast<float>(view.steps.x);
    const auto step_y = static_cast<float>(view.steps.y * adjustment_.step_ratio);
    const float x = static_cast<float>(point.pixel.x + view.offset_px.x) - point.disparity * step_x;
    const float y = static_cast<float>(point.pixel.y + view.offset_px.y) - point.disparity * step_y;
    const float qx = x - middle_.x;
    const float qy = y - middle_.y;
    const auto roll = static_cast<float>(misfit.roll);
    const auto zoom = static_cast<float>(misfit.zoom);
    const float at_x = x + static_cast<float>(misfit.shift_px.x) + zoom * qx - roll * qy;
    const float at_y = y + static_cast<float>(misfit.shift_px.y) + roll * qx + zoom * qy;
    PointView seen;
    const cv::Mat& image = images_[index];
    constexpr float border = 1.0F;
    if (!(at_x >= border && at_y >= border && at_x < static_cast<float>(image.cols) - 1 - border &&
          at_y < static_cast<float>(image.rows) - 1 - border))
    {
      return seen;
    }
    const cv::Vec3f sample = sampleAt(image, at_x, at_y);
    seen.difference = sample[0] - reference_.at<cv::Vec3f>(point.pixel)[0];
    const float relative = seen.difference / (2.0F * scale);
    seen.weight = 1.0F / (1.0F + relative * relative);
    seen.along = -(sample[1] * step_x + sample[2] * step_y);
    // Roll and zoom in pixels at the corner, so that all unknowns are of one size.
    seen.own = {sample[1], sample[2], (sample[2] * qx - sample[1] * qy) / radius_,
                (sample[1] * qx + sample[2] * qy) / radius_};
    seen.ratio = -sample[2] * static_cast<float>(view.steps.y) * point.disparity;
    return seen;
  }

  /// Adds one point, its disparity eliminated.
  void addPoint(int index, float scale, NormalEquations& equations)
  {
    float* const coupling = couplings_.data() + static_cast<std::ptrdiff_t>(index) * stride_;
    const AdjustedPoint& point = adjustment_.points[static_cast<std::size_t>(index)];
    const int ratio = unknowns_ - 1;
    float own = 1e-3F * scale * scale;
    float side = 0.0F;
    for (std::size_t i = 0; i < others_.size(); ++i)
    {
      const PointView seen = look(point, others_[i], scale);
      if (seen.weight <= 0.0F)
      {
        continue;
      }
      own += seen.weight * seen.along * seen.along;
      side += seen.weight * seen.along * seen.difference;
      const int first = PER_VIEW * static_cast<int>(i);
      for (int a = 0; a < PER_VIEW; ++a)
      {
        const float weighted = seen.weight * seen.own[static_cast<std::size_t>(a)];
        const int unknown = first + a;
        float* const row = equations.row(unknown);
        for (int b = a; b < PER_VIEW; ++b)
        {
          row[first + b] += weighted * seen.own[static_cast<std::size_t>(b)];
        }
        row[ratio] += weighted * seen.ratio;
        equations.side(unknown) += weighted * seen.difference;
        coupling[unknown] = weighted * seen.along;
      }
      equations.row(ratio)[ratio] += seen.weight * seen.ratio * seen.ratio;
      equations.side(ratio) += seen.weight * seen.ratio * seen.difference;
      coupling[ratio] += seen.weight * seen.ratio * seen.along;
    }
    equations.eliminate(coupling, own, side);
    alone_[static_cast<std::size_t>(index)] = {own, side};
  }

  std::vector<double> solve(const std::vector<NormalEquations>& parts, float scale) const
  {
    cv::Mat matrix(unknowns_, unknowns_, CV_64FC1, cv::Scalar(0.0));
    cv::Mat side(unknowns_, 1, CV_64FC1, cv::Scalar(0.0));
    for (const NormalEquations& part : parts)
    {
      for (int a = 0; a < unknowns_; ++a)
      {
        for (int b = a; b < unknowns_; ++b)
        {
          matrix.at<double>(a, b) += part.row(a)[b];
        }
        side.at<double>(a) -= part.side(a);
      }
    }
    cv::completeSymm(matrix, false);
    // Neighbouring points repeat each other's errors: so many count as one.
    constexpr double dependent = 9.0;
    const double doubt = dependent * scale * scale / (expected_px_ * expected_px_);
    for (int a = 0; a < unknowns_; ++a)
    {
      matrix.at<double>(a, a) += doubt;
      if (a < unknowns_ - 1)
      {
        side.at<double>(a) -= doubt * current(a);
      }
    }
    if (adjustment_.steps_are_known)
    {
      const int ratio = unknowns_ - 1;
      matrix.row(ratio).setTo(0.0);
      matrix.col(ratio).setTo(0.0);
      matrix.at<double>(ratio, ratio) = 1.0;
      side.at<double>(ratio) = 0.0;
    }
    cv::Mat solution;
    if (!cv::solve(matrix, side, solution, cv::DECOMP_CHOLESKY))
    {
      solution = cv::Mat::zeros(unknowns_, 1, CV_64FC1);
    }
    return {solution.begin<double>(), solution.end<double>()};
  }

  /// The present value of an unknown.
  double current(int unknown) const
  {
    const ViewMisfit& misfit = adjustment_.views[others_[static_cast<std::size_t>(unknown / PER_VIEW)]];
    const std::array<double, PER_VIEW> values = {misfit.shift_px.x, misfit.shift_px.y, misfit.roll * radius_,
                                                 misfit.zoom * radius_};
    return values[static_cast<std::size_t>(unknown % PER_VIEW)];
  }

  void apply(const std::vector<double>& change)
  {
    const float most = MAX_MOTION_PX / widest_;
    for (std::size_t i = 0; i < adjustment_.points.size(); ++i)
    {
      const float* const coupling = couplings_.data() + i * static_cast<std::size_t>(stride_);
      float sum = alone_[i].side;
      for (int a = 0; a < unknowns_; ++a)
      {
        sum += coupling[a] * static_cast<float>(change[static_cast<std::size_t>(a)]);
      }
      sum /= alone_[i].own;
      adjustment_.points[i].disparity -= std::clamp(sum, -most, most);
    }
    for (std::size_t i = 0; i < others_.size(); ++i)
    {
      const double* const values = change.data() + PER_VIEW * i;
      ViewMisfit& misfit = adjustment_.views[others_[i]];
      misfit.shift_px += cv::Point2d(values[0], values[1]);
      misfit.roll += values[2] / radius_;
      misfit.zoom += values[3] / radius_;
    }
    adjustment_.step_ratio += change.back();
  }

  const LightField& field_;
  ThreadPool& pool_;
  Adjustment& adjustment_;
  const std::vector<cv::Mat>& images_;
  cv::Mat reference_;
  std::vector<std::size_t> others_;
  cv::Point2f middle_;
  float radius_;
  float expected_px_;
  float widest_ = 0.0F;
  int unknowns_ = 0;
  int stride_ = 0;                ///< of couplings_
  std::vector<float> couplings_;  ///< of each point's disparity with the unknowns
  std::vector<Alone> alone_;      ///< of each point
};

}  // namespace

SlopedViews::SlopedViews(const LightField& grey, ThreadPool& pool)
    : light_field(grey), images(grey.views.size())
{
  pool.parallelFor(0, static_cast<int>(images.size()), 1,
                   [&](int first, int last)
                   {
                     for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
                     {
                       images[i] = withSlopes(light_field.views[i].image);
                     }
                   });
}

void adjustJointly(const SlopedViews& views, double expected_px, int steps, ThreadPool& pool,
                   Adjustment& adjustment)
{
  Adjuster adjuster(views, expected_px, pool, adjustment);
  for (int i = 0; i < steps && !adjustment.points.empty(); ++i)
  {
    adjuster.step();
  }
}

std::vector<double> compareFits(const SlopedViews& views, std::vector<Adjustment> adjustments,
                                ThreadPool& pool)
{
  std::vector<double> fits;
  float scale = 0.0F;
  for (Adjustment& adjustment : adjustments)
  {
    Adjuster adjuster(views, 1.0, pool, adjustment);
    scale = fits.empty() ? adjuster.differenceScale() : scale;
    fits.push_back(adjuster.settle(scale));
  }
  return fits;
}

}  // namespace light_field_depth
