#include "light_field_depth/core/multiview/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "light_field_depth/core/multiview/linearize_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 64;
constexpr int DIRECTION_PAIRS = 4;
constexpr int RESIDUAL_RADIUS = 2;
/// Added to residuals (three channels, averaged over views and pixels) before arms are compared.
constexpr float RESIDUAL_FLOOR = 3.0F;
constexpr float TINY = 1e-6F;

std::size_t roundUp(int value, int multiple)
{
  const int rounded = (value + multiple - 1) / multiple * multiple;
  return static_cast<std::size_t>(rounded);
}

/// out[x] = sum of in over `radius` pixels left and right, the ends repeated.
void boxRow(const float* in, int width, int radius, float* out)
{
  const auto clamped = [&](int x)
  {
    float sum = 0.0F;
    for (int dx = -radius; dx <= radius; ++dx)
    {
      sum += in[std::clamp(x + dx, 0, width - 1)];
    }
    return sum;
  };
  for (int x = 0; x < radius; ++x)
  {
    out[x] = clamped(x);
    out[width - 1 - x] = clamped(width - 1 - x);
  }
  for (int x = radius; x < width - radius; ++x)
  {
    float sum = 0.0F;
    for (int dx = -radius; dx <= radius; ++dx)
    {
      sum += in[x + dx];
    }
    out[x] = sum;
  }
}

}  // namespace

/// Memory of one band of rows at work.
struct Linearizer::Scratch
{
  std::vector<float> arm_rows;   // ring [row][arm][moment][x]
  std::vector<float> pair_rows;  // ring [row][pair][moment][x]
  std::vector<float> disparity;  // of one row, padded
  std::vector<float> columns;    // sums over the rows of a window
  std::vector<float> boxes;      // sums over the window
};

Linearizer::Linearizer() = default;
Linearizer::~Linearizer() = default;

std::unique_ptr<Linearizer::Scratch> Linearizer::takeScratch()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_scratch_.empty())
  {
    return std::make_unique<Scratch>();
  }
  auto scratch = std::move(free_scratch_.back());
  free_scratch_.pop_back();
  return scratch;
}

void Linearizer::giveBack(std::unique_ptr<Scratch> scratch)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  free_scratch_.push_back(std::move(scratch));
}

/// Rows first..last of the result, computed from top to bottom with rings of intermediate rows.
class Linearizer::Band
{
public:
  Band(const ViewSet& views, const cv::Mat& disparity, const LinearizationSettings& settings,
       Scratch& scratch, Linearization& result)
      : views_(views), disparity_(disparity), settings_(settings), scratch_(scratch), result_(result),
        width_(views.width()), height_(views.height()), arms_(views.arms.size()),
        stride_(roundUp(width_, MOMENT_MULTIPLE)), arm_stride_(MOMENTS * stride_),
        arm_ring_(2 * RESIDUAL_RADIUS + 1), pair_ring_(2 * settings.window_radius + 1)
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
    scratch_.arm_rows.resize(static_cast<std::size_t>(arm_ring_) * arms_ * arm_stride_);
    scratch_.pair_rows.resize(static_cast<std::size_t>(pair_ring_) * DIRECTION_PAIRS * arm_stride_);
    scratch_.disparity.assign(stride_, 0.0F);
    scratch_.columns.resize(arm_stride_);
    scratch_.boxes.resize(std::max<std::size_t>(DIRECTION_PAIRS, arms_) * arm_stride_);
  }

  void run(int first, int last)
  {
    first_ = first;
    last_ = last;
    int arm_row = std::max(0, first - settings_.window_radius - RESIDUAL_RADIUS);
    int pair_row = std::max(0, first - settings_.window_radius);
    for (int y = first; y < last; ++y)
    {
      const int last_pair_row = std::min(height_ - 1, y + settings_.window_radius);
      for (; pair_row <= last_pair_row; ++pair_row)
      {
        const int last_arm_row = std::min(height_ - 1, pair_row + RESIDUAL_RADIUS);
        for (; arm_row <= last_arm_row; ++arm_row)
        {
          accumulateViews(arm_row);
        }
        weighArms(pair_row);
      }
      solve(y);
    }
  }

private:
  float* armRow(int y, std::size_t arm) const
  {
    return scratch_.arm_rows.data() + (static_cast<std::size_t>(y % arm_ring_) * arms_ + arm) * arm_stride_;
  }
  float* pairRow(int y, int pair) const
  {
    return scratch_.pair_rows.data() +
           static_cast<std::size_t>((y % pair_ring_) * DIRECTION_PAIRS + pair) * arm_stride_;
  }

  void accumulateViews(int y) const
  {
    std::copy_n(disparity_.ptr<float>(y), width_, scratch_.disparity.data());
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      float* const moments = armRow(y, arm);
      std::fill(moments, moments + arm_stride_, 0.0F);
      for (int view = views_.arms[arm].first; view < views_.arms[arm].last; ++view)
      {
        linearizeRow(viewRow(views_.views[static_cast<std::size_t>(view)], y, moments));
      }
    }
  }

  LinearizeRow viewRow(const PreparedView& view, int y, float* moments) const
  {
    LinearizeRow row;
    row.pixels = view.pixels.ptr<std::uint8_t>();
    row.pixel_stride = static_cast<int>(view.pixels.elemSize());
    row.row_stride = static_cast<int>(view.pixels.step);
    row.width = width_;
    row.height = height_;
    row.channels = views_.reference.channels();
    row.reference = views_.reference.row(y);
    row.reference_stride = views_.reference.channelStride();
    row.disparity = scratch_.disparity.data();
    row.y = y;
    row.step_x = static_cast<float>(view.steps.x);
    row.step_y = static_cast<float>(view.steps.y);
    row.offset_x = static_cast<float>(view.offset_px.x);
    row.offset_y = static_cast<float>(view.offset_px.y);
    row.position = view.position;
    row.moments = moments;
    row.moment_stride = stride_;
    return row;
  }

  /// Sums over the rows y - radius .. y + radius, clamped into the image.
  template <typename RowAt>
  void sumRows(int y, int radius, std::size_t count, const RowAt& row_at, float* sums) const
  {
    for (int dy = -radius; dy <= radius; ++dy)
    {
      const float* const row = row_at(std::clamp(y + dy, 0, height_ - 1));
      for (std::size_t i = 0; i < count; ++i)
      {
        sums[i] = dy == -radius ? row[i] : sums[i] + row[i];
      }
    }
  }

  /// Adds up the arms of each pair of opposite directions, those that fit worse with less weight.
  void weighArms(int y) const
  {
    const std::size_t width = stride_;
    float* const boxes = scratch_.boxes.data();
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      sumRows(
          y, RESIDUAL_RADIUS, width, [&](int row) { return armRow(row, arm) + MOMENT_RESIDUAL * width; },
          scratch_.columns.data());
      boxRow(scratch_.columns.data(), width_, RESIDUAL_RADIUS, boxes + arm * width);
      constexpr float window = (2 * RESIDUAL_RADIUS + 1) * (2 * RESIDUAL_RADIUS + 1);
      const float scale =
          1.0F / (window * static_cast<float>(views_.arms[arm].last - views_.arms[arm].first));
      for (std::size_t x = 0; x < width; ++x)
      {
        boxes[arm * width + x] = boxes[arm * width + x] * scale + RESIDUAL_FLOOR;
      }
    }
    float* const smallest = scratch_.columns.data();
    std::copy(boxes, boxes + width, smallest);
    for (std::size_t i = width; i < arms_ * width; ++i)
    {
      smallest[i % width] = std::min(smallest[i % width], boxes[i]);
    }
    if (y >= first_ && y < last_)
    {
      auto* const residual = result_.residual.ptr<float>(y);
      for (int x = 0; x < width_; ++x)
      {
        residual[x] = smallest[x] - RESIDUAL_FLOOR;
      }
    }
    for (const int pair : pairs_)
    {
      std::fill(pairRow(y, pair), pairRow(y, pair) + arm_stride_, 0.0F);
    }
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      float* const target = pairRow(y, views_.arms[arm].direction % DIRECTION_PAIRS);
      const float* const moments = armRow(y, arm);
      for (std::size_t x = 0; x < width; ++x)
      {
        const float ratio = smallest[x] / boxes[arm * width + x];
        boxes[arm * width + x] = ratio * ratio * ratio * ratio;
      }
      for (std::size_t moment = 0; moment < MOMENTS; ++moment)
      {
        for (std::size_t x = 0; x < width; ++x)
        {
          target[moment * width + x] += boxes[arm * width + x] * moments[moment * width + x];
        }
      }
    }
  }

  /// Eliminates the slope of the brightness from the normal equations of each pair, and solves.
  void solve(int y) const
  {
    const std::size_t width = stride_;
    auto* const weight = result_.weight.ptr<float>(y);
    auto* const target = result_.target.ptr<float>(y);
    const auto* const disparity = disparity_.ptr<float>(y);
    const auto pixels = static_cast<std::size_t>(width_);
    std::fill(weight, weight + pixels, 0.0F);
    std::fill(target, target + pixels, 0.0F);
    auto* const disagreement = result_.disagreement.ptr<float>(y);
    std::fill(disagreement, disagreement + pixels, 0.0F);
    for (const int pair : pairs_)
    {
      sumRows(
          y, settings_.window_radius, arm_stride_, [&](int row) { return pairRow(row, pair); },
          scratch_.columns.data());
      float* const box = scratch_.boxes.data();
      for (std::size_t moment = 0; moment < MOMENTS; ++moment)
      {
        boxRow(scratch_.columns.data() + moment * width, width_, settings_.window_radius,
               box + moment * width);
      }
      const auto channels = static_cast<std::size_t>(views_.reference.channels());
      const float enabled = settings_.brightness_slope ? 1.0F : 0.0F;
      for (std::size_t x = 0; x < pixels; ++x)
      {
        const float inverse = enabled / (box[MOMENT_KK * width + x] + TINY);
        float curvature = box[MOMENT_GG * width + x];
        float gradient = -box[MOMENT_GR * width + x];
        for (std::size_t c = 0; c < channels; ++c)
        {
          const float kg = box[(MOMENT_KG + c) * width + x];
          const float kr = box[(MOMENT_KR + c) * width + x];
          curvature -= kg * kg * inverse;
          gradient += kg * kr * inverse;
        }
        curvature = std::max(0.0F, curvature);
        weight[x] += curvature;
        target[x] += gradient;
        disagreement[x] += gradient * gradient / (curvature + TINY);
      }
    }
    const float window =
        static_cast<float>((2 * settings_.window_radius + 1) * (2 * settings_.window_radius + 1));
    const float limit = settings_.max_step_px;
    for (std::size_t x = 0; x < pixels; ++x)
    {
      const float minimum = target[x] / (weight[x] + TINY);
      const float spread = disagreement[x] / (weight[x] + TINY) - minimum * minimum;
      disagreement[x] = std::sqrt(std::max(0.0F, spread));
      const float step = std::clamp(minimum, -limit, limit);
      target[x] = disparity[x] + step;
      weight[x] = std::min(weight[x] / window, settings_.max_weight);
    }
  }

  const ViewSet& views_;
  const cv::Mat& disparity_;
  const LinearizationSettings& settings_;
  Scratch& scratch_;
  Linearization& result_;
  int width_;
  int height_;
  std::size_t arms_;
  std::size_t stride_;  ///< of one row of numbers
  std::size_t arm_stride_;
  std::vector<int> pairs_;  ///< the directions, modulo their opposites, in which there are views
  int first_ = 0;
  int last_ = 0;
  int arm_ring_;
  int pair_ring_;
};

void Linearizer::run(const ViewSet& views, const cv::Mat& disparity, const LinearizationSettings& settings,
                     ThreadPool& pool, Linearization& result)
{
  result.weight.create(disparity.size(), CV_32FC1);
  result.target.create(disparity.size(), CV_32FC1);
  result.residual.create(disparity.size(), CV_32FC1);
  result.disagreement.create(disparity.size(), CV_32FC1);
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     auto scratch = takeScratch();
                     Band(views, disparity, settings, *scratch, result).run(first, last);
                     giveBack(std::move(scratch));
                   });
}

}  // namespace light_field_depth::multiview
