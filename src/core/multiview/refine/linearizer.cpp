#include "core/multiview/refine/linearizer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/multiview/refine/linearize_kernels.h"
#include "core/multiview/refine/normal_equation_kernels.h"
#include "core/multiview/refine/view_rays.h"

namespace light_field_depth::multiview
{
namespace
{
/// A band computes some rows above and below it as well: a few for each thread are enough to share out.
constexpr int BANDS_PER_THREAD = 3;
constexpr int MIN_BAND_ROWS = 16;  // twice what a band computes besides
/// Opposite arms of eight directions.
constexpr int DIRECTION_PAIRS = 4;
constexpr int RESIDUAL_RADIUS = 2;  // of the window that compares arms, that of the normal equations
/// Added to residuals (three channels, averaged over views and pixels) before arms are compared.
constexpr float RESIDUAL_FLOOR = 3.0F;
/// Reach of the derivative of four pixels.
constexpr std::size_t GRADIENT_PAD = 2;
/// How much a view adds to the refocused mean, which it takes part in with a weight, against the reference.
constexpr float SHARE_OF_MEAN = 0.7F;

/// Views are rounded to whole levels: 1/12 of variance, which the derivative of four pixels makes 130/144 of.
constexpr float ROUNDING_SLOPE_VARIANCE = 130.0F / 144.0F / 12.0F;

std::size_t roundUp(int value, int multiple)
{
  const int rounded = (value + multiple - 1) / multiple * multiple;
  return static_cast<std::size_t>(rounded);
}

}  // namespace

namespace
{
/// Of those that are used.
std::size_t firstChannel(const PlanarImage& image, const LinearizationSettings& settings)
{
  return settings.one_channel && image.channels() > 1 ? 1 : 0;
}

}  // namespace

/// Memory of one band of rows at work.
struct Linearizer::Scratch
{
  std::vector<float> ray_rows;        // ring [row][ray][moment][x]
  std::vector<float> refocused_rows;  // ring [row][channel][GRADIENT_PAD + x]
  std::vector<float> pair_rows;       // ring [row][pair][moment][x]
  std::vector<float> gradients;       // of one row: [direction][channel][x]
  std::vector<float> weights;         // of one tile
  std::vector<float> disparity;       // of one row, padded
  std::vector<const float*> row_pointers;
  std::vector<float> sums;         // over the rows of a window
  std::vector<float> columns;      // rows of numbers about one row of the image
  std::vector<float> solutions;    // of one row
  std::vector<float> slope_noise;  // of one row
};

Linearizer::Linearizer() = default;
Linearizer::~Linearizer() = default;

/// Rows first..last of the result, computed from top to bottom with rings of intermediate rows.
class Linearizer::Band
{
public:
  Band(const ViewSet& views, const ViewRays& rays, const cv::Mat& disparity, const cv::Mat& slope_variance,
       const LinearizationSettings& settings, Scratch& scratch, Linearization& result)
      : views_(views), rays_(rays), disparity_(disparity), slope_variance_(slope_variance),
        settings_(settings), scratch_(scratch), result_(result), width_(views.width()),
        height_(views.height()), arms_(views.arms.size()),
        channels_(static_cast<std::size_t>(settings.one_channel ? 1 : views.reference.channels())),
        stride_(roundUp(width_, TILE_PIXELS)), moments_(momentCount(static_cast<int>(channels_))),
        pair_stride_(moments_ * stride_), masked_(views.hasMasks()), near_ring_(2 * RESIDUAL_RADIUS + 1),
        pair_ring_(2 * settings.window_radius + 1)
  {
    for (int pair = 0; pair < DIRECTION_PAIRS; ++pair)
    {
      const bool present =
          std::any_of(views.arms.begin(), views.arms.end(),
                      [pair](const Arm& arm) { return arm.direction % DIRECTION_PAIRS == pair; });
      if (present)
      {
        pairs_.push_back(pair);
      }
    }
    const auto near_ring = static_cast<std::size_t>(near_ring_);
    scratch_.ray_rows.resize(near_ring * rays_.rays.size() * RAY_MOMENTS * stride_);
    scratch_.refocused_rows.resize(near_ring * refocusedStride() + GRADIENT_PAD);
    scratch_.pair_rows.resize(static_cast<std::size_t>(pair_ring_) * DIRECTION_PAIRS * pair_stride_);
    scratch_.gradients.resize(2 * channels_ * stride_);
    scratch_.weights.resize(rays_.rays.size() * TILE_PIXELS);
    scratch_.disparity.assign(stride_, 0.0F);
    scratch_.sums.resize(pair_stride_);
    scratch_.solutions.resize(4 * stride_);
    scratch_.slope_noise.assign(stride_, 0.0F);
    scratch_.columns.resize(std::max(moments_, arms_ + 1) * stride_);
  }

  void run(int first, int last)
  {
    first_ = first;
    last_ = last;
    int near_row = std::max(0, first - settings_.window_radius - RESIDUAL_RADIUS);
    int pair_row = std::max(0, first - settings_.window_radius);
    for (int y = first; y < last; ++y)
    {
      const int last_pair_row = std::min(height_ - 1, y + settings_.window_radius);
      for (; pair_row <= last_pair_row; ++pair_row)
      {
        const int last_near_row = std::min(height_ - 1, pair_row + RESIDUAL_RADIUS);
        for (; near_row <= last_near_row; ++near_row)
        {
          sampleViews(near_row);
        }
        weighArms(pair_row);
      }
      solve(y);
    }
  }

private:
  std::size_t refocusedStride() const { return channels_ * (stride_ + 2 * GRADIENT_PAD); }
  float* rayRow(int y, std::size_t ray) const
  {
    const std::size_t row = static_cast<std::size_t>(y % near_ring_) * rays_.rays.size() + ray;
    return scratch_.ray_rows.data() + row * RAY_MOMENTS * stride_;
  }
  /// Pixel 0 of channel 0; y is clamped into the image.
  float* refocusedRow(int y) const
  {
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, height_ - 1) % near_ring_);
    return scratch_.refocused_rows.data() + row * refocusedStride() + GRADIENT_PAD;
  }
  float* pairRow(int y, int pair) const
  {
    return scratch_.pair_rows.data() +
           static_cast<std::size_t>((y % pair_ring_) * DIRECTION_PAIRS + pair) * pair_stride_;
  }

  void sampleViews(int y) const
  {
    std::copy_n(disparity_.ptr<float>(y), width_, scratch_.disparity.begin());
    std::fill(scratch_.disparity.begin() + width_, scratch_.disparity.end(),
              scratch_.disparity[static_cast<std::size_t>(width_) - 1]);
    LinearizeTile tile;
    tile.views = rays_.views.data();
    tile.rays = rays_.rays.data();
    tile.ray_count = static_cast<int>(rays_.rays.size());
    tile.width = width_;
    tile.height = height_;
    tile.channels = static_cast<int>(channels_);
    tile.reference = views_.reference.row(y) +
                     firstChannel(views_.reference, settings_) * views_.reference.channelStride();
    tile.reference_stride = views_.reference.channelStride();
    tile.disparity = scratch_.disparity.data();
    tile.y = y;
    tile.match_scale = settings_.match_scale;
    tile.weights = scratch_.weights.data();
    tile.refocused = refocusedRow(y);
    tile.refocused_stride = stride_ + 2 * GRADIENT_PAD;
    tile.moments = rayRow(y, 0);
    tile.stride = stride_;
    if (views_.reference_margin.width() > 0)
    {
      tile.reference_masked = views_.reference_margin.row(y);
    }
    for (tile.first = 0; tile.first < width_; tile.first += TILE_PIXELS)
    {
      linearizeTile(tile);
      if (masked_)
      {
        linearizeMaskedPixels(tile);
      }
    }
    for (std::size_t c = 0; c < channels_; ++c)
    {
      float* const row = tile.refocused + c * tile.refocused_stride;
      std::fill(row - GRADIENT_PAD, row, row[0]);
      std::fill(row + width_, row + width_ + GRADIENT_PAD, row[width_ - 1]);
    }
  }

  void differentiateRefocused(int y) const
  {
    for (std::size_t c = 0; c < channels_; ++c)
    {
      DerivativeRow row;
      for (int dy = -2; dy <= 2; ++dy)
      {
        row.rows[dy + 2] = refocusedRow(y + dy) + c * (stride_ + 2 * GRADIENT_PAD);
      }
      row.width = width_;
      row.along_x = scratch_.gradients.data() + c * stride_;
      row.along_y = scratch_.gradients.data() + (channels_ + c) * stride_;
      differentiate(row);
    }
  }

  /// Adds up the arms of each pair of opposite directions, those that fit worse with less weight.
  void weighArms(int y) const
  {
    float* const lowest = scratch_.columns.data();
    float* const boxes = lowest + stride_;
    compareArms(y, lowest, boxes);
    if (y >= first_ && y < last_)
    {
      auto* const residual = result_.residual.ptr<float>(y);
      std::transform(lowest, lowest + width_, residual, [](float value) { return value - RESIDUAL_FLOOR; });
    }
    for (const int pair : pairs_)
    {
      std::fill(pairRow(y, pair), pairRow(y, pair) + pair_stride_, 0.0F);
    }
    differentiateRefocused(y);
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      float* const share = boxes + arm * stride_;
      shareOfArm(lowest, width_, share);
      for (int ray = rays_.of_arm[arm].first; ray < rays_.of_arm[arm].last; ++ray)
      {
        addRay(rayAt(y, static_cast<std::size_t>(ray), share),
               pairRow(y, views_.arms[arm].direction % DIRECTION_PAIRS));
      }
    }
  }

  /// The mean residual of each arm about the row's pixels, and that of the best arm.
  void compareArms(int y, float* lowest, float* boxes) const
  {
    std::fill(lowest, lowest + width_, std::numeric_limits<float>::max());
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      scratch_.row_pointers.clear();
      for (int dy = -RESIDUAL_RADIUS; dy <= RESIDUAL_RADIUS; ++dy)
      {
        for (int ray = rays_.of_arm[arm].first; ray < rays_.of_arm[arm].last; ++ray)
        {
          scratch_.row_pointers.push_back(
              rayRow(std::clamp(y + dy, 0, height_ - 1), static_cast<std::size_t>(ray)) +
              RAY_RESIDUAL * stride_);
        }
      }
      sumRows(scratch_.row_pointers.data(), static_cast<int>(scratch_.row_pointers.size()),
              static_cast<std::size_t>(width_), scratch_.sums.data());
      float* const box = boxes + arm * stride_;
      boxRow(scratch_.sums.data(), width_, RESIDUAL_RADIUS, box);
      constexpr float window = (2 * RESIDUAL_RADIUS + 1) * (2 * RESIDUAL_RADIUS + 1);
      const auto views = static_cast<float>(views_.arms[arm].last - views_.arms[arm].first);
      scaleAndLower(1.0F / (window * views), RESIDUAL_FLOOR, width_, box, lowest);
    }
  }

  RayRow rayAt(int y, std::size_t ray, const float* share) const
  {
    RayRow row;
    row.moments = rayRow(y, ray);
    row.share = share;
    row.along_x = scratch_.gradients.data();
    row.along_y = scratch_.gradients.data() + channels_ * stride_;
    row.direction_x = rays_.directions[ray].x;
    row.direction_y = rays_.directions[ray].y;
    row.channels = static_cast<int>(channels_);
    row.width = width_;
    row.stride = stride_;
    return row;
  }

  /// Sums the moments of a pair over the window.
  void sumWindow(int y, int pair) const
  {
    const int radius = settings_.window_radius;
    scratch_.row_pointers.clear();
    for (int dy = -radius; dy <= radius; ++dy)
    {
      scratch_.row_pointers.push_back(pairRow(std::clamp(y + dy, 0, height_ - 1), pair));
    }
    sumRows(scratch_.row_pointers.data(), 2 * radius + 1, pair_stride_, scratch_.sums.data());
    for (std::size_t moment = 0; moment < moments_; ++moment)
    {
      boxRow(scratch_.sums.data() + moment * stride_, width_, radius,
             scratch_.columns.data() + moment * stride_);
    }
  }

  /// The minimum of all pairs together.
  void solve(int y) const
  {
    float* const solutions = scratch_.solutions.data();
    std::fill(solutions, solutions + 4 * stride_, 0.0F);
    const SolutionRow solution{solutions, solutions + stride_, solutions + 2 * stride_,
                               solutions + 3 * stride_};
    for (const int pair : pairs_)
    {
      sumWindow(y, pair);
      PairRow row;
      row.moments = scratch_.columns.data();
      row.brightness_slope = settings_.brightness_slope;
      row.channels = static_cast<int>(channels_);
      row.width = width_;
      row.stride = stride_;
      addPair(row, solution);
    }
    FinalRow row;
    std::copy_n(disparity_.ptr<float>(y), width_, scratch_.disparity.data());
    row.disparity = scratch_.disparity.data();
    row.window = static_cast<float>((2 * settings_.window_radius + 1) * (2 * settings_.window_radius + 1));
    row.max_step_px = settings_.max_step_px;
    setSlopeNoise(y);
    row.slope_noise = scratch_.slope_noise.data();
    row.width = width_;
    solveRow(row, solution);
    std::copy_n(solution.curvature, width_, result_.weight.ptr<float>(y));
    std::copy_n(solution.gradient, width_, result_.target.ptr<float>(y));
    std::copy_n(solution.disagreement, width_, result_.disagreement.ptr<float>(y));
    std::copy_n(solution.positions, width_, result_.noise.ptr<float>(y));
  }

  /// The variance that noise gives the slopes of the refocused mean, sum over the channels.
  void setSlopeNoise(int y) const
  {
    if (slope_variance_.empty())
    {
      return;
    }
    const auto views = static_cast<float>(views_.views.size());
    const float factor = static_cast<float>(channels_) / (1.0F + SHARE_OF_MEAN * views);
    const auto* const row = slope_variance_.ptr<float>(y);
    std::transform(row, row + width_, scratch_.slope_noise.begin(),
                   [&](float value) { return factor * std::max(value, ROUNDING_SLOPE_VARIANCE); });
  }

  const ViewSet& views_;
  const ViewRays& rays_;
  const cv::Mat& disparity_;
  const cv::Mat& slope_variance_;
  const LinearizationSettings& settings_;
  Scratch& scratch_;
  Linearization& result_;
  int width_;
  int height_;
  std::size_t arms_;
  std::size_t channels_;
  std::size_t stride_;   ///< of one row of numbers
  std::size_t moments_;  ///< of a pair
  std::size_t pair_stride_;
  bool masked_;             ///< some view is, somewhere
  std::vector<int> pairs_;  ///< the directions, modulo their opposites, in which there are views
  int first_ = 0;
  int last_ = 0;
  int near_ring_;
  int pair_ring_;
};

void Linearizer::run(const ViewSet& views, const cv::Mat& disparity, const cv::Mat& slope_variance,
                     const LinearizationSettings& settings, ThreadPool& pool, Linearization& result)
{
  result.weight.create(disparity.size(), CV_32FC1);
  result.target.create(disparity.size(), CV_32FC1);
  result.residual.create(disparity.size(), CV_32FC1);
  result.disagreement.create(disparity.size(), CV_32FC1);
  result.noise.create(disparity.size(), CV_32FC1);
  ViewRays rays = findViewRays(views);
  for (SampledView& view : rays.views)
  {
    view.pixels += firstChannel(views.reference, settings) * view.channel_stride;
  }
  const int bands = BANDS_PER_THREAD * pool.threads();
  const int band_rows = std::max(MIN_BAND_ROWS, (disparity.rows + bands - 1) / bands);
  pool.parallelFor(
      0, disparity.rows, band_rows,
      [&](int first, int last)
      {
        scratch_.use(
            [&](Scratch& scratch)
            { Band(views, rays, disparity, slope_variance, settings, scratch, result).run(first, last); });
      });
}

}  // namespace light_field_depth::multiview
