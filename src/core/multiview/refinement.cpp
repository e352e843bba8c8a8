#include "light_field_depth/core/multiview/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "light_field_depth/core/multiview/linearize_kernels.h"
#include "spokes.h"

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
/// Weights of the differences of the neighbours one and two pixels away.
constexpr float NEAR_TAP = 8.0F / 12.0F;
constexpr float FAR_TAP = 1.0F / 12.0F;
constexpr std::size_t GRADIENT_PAD = 2;

/// What is summed over the spokes of a pair of opposite arms, a row of numbers each: g is the derivative of
/// a view's brightness by the disparity, the rest is that of the spokes. KG and KR have one row a channel.
constexpr std::size_t MOMENT_GG = 0;
constexpr std::size_t MOMENT_GR = 1;
constexpr std::size_t MOMENT_KK = 2;
constexpr std::size_t MOMENT_KG = 3;
constexpr std::size_t MOMENT_KR = 6;
constexpr std::size_t MOMENTS = 9;

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
  std::vector<float> spoke_rows;      // ring [row][spoke][moment][x]
  std::vector<float> refocused_rows;  // ring [row][channel][GRADIENT_PAD + x]
  std::vector<float> pair_rows;       // ring [row][pair][moment][x]
  std::vector<float> gradients;       // of one row: [direction][channel][x]
  std::vector<float> samples;         // of one tile
  std::vector<float> disparity;       // of one row, padded
  std::vector<float> columns;         // sums over the rows of a window
  std::vector<float> boxes;           // sums over the window
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
  Band(const ViewSet& views, const Spokes& spokes, const cv::Mat& disparity,
       const LinearizationSettings& settings, Scratch& scratch, Linearization& result)
      : views_(views), spokes_(spokes), disparity_(disparity), settings_(settings), scratch_(scratch),
        result_(result), width_(views.width()), height_(views.height()), arms_(views.arms.size()),
        channels_(static_cast<std::size_t>(views.reference.channels())),
        stride_(roundUp(width_, TILE_PIXELS)), pair_stride_(MOMENTS * stride_),
        near_ring_(2 * RESIDUAL_RADIUS + 1), pair_ring_(2 * settings.window_radius + 1)
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
    scratch_.spoke_rows.resize(near_ring * spokes_.spokes.size() * SPOKE_MOMENTS * stride_);
    scratch_.refocused_rows.resize(near_ring * refocusedStride() + GRADIENT_PAD);
    scratch_.pair_rows.resize(static_cast<std::size_t>(pair_ring_) * DIRECTION_PAIRS * pair_stride_);
    scratch_.gradients.resize(2 * channels_ * stride_);
    scratch_.samples.resize(views.views.size() * channels_ * TILE_PIXELS);
    scratch_.disparity.assign(stride_, 0.0F);
    scratch_.columns.resize(std::max<std::size_t>(MOMENTS, arms_) * stride_);
    scratch_.boxes.resize(std::max<std::size_t>(MOMENTS, arms_) * stride_);
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
  float* spokeRow(int y, std::size_t spoke) const
  {
    const std::size_t row = static_cast<std::size_t>(y % near_ring_) * spokes_.spokes.size() + spoke;
    return scratch_.spoke_rows.data() + row * SPOKE_MOMENTS * stride_;
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
    std::copy_n(disparity_.ptr<float>(y), width_, scratch_.disparity.data());
    LinearizeTile tile;
    tile.views = spokes_.views.data();
    tile.view_count = static_cast<int>(spokes_.views.size());
    tile.spokes = spokes_.spokes.data();
    tile.spoke_count = static_cast<int>(spokes_.spokes.size());
    tile.width = width_;
    tile.height = height_;
    tile.channels = views_.reference.channels();
    tile.reference = views_.reference.row(y);
    tile.reference_stride = views_.reference.channelStride();
    tile.disparity = scratch_.disparity.data();
    tile.y = y;
    tile.match_scale = settings_.match_scale;
    tile.values = scratch_.samples.data();
    tile.refocused = refocusedRow(y);
    tile.refocused_stride = stride_ + 2 * GRADIENT_PAD;
    tile.moments = spokeRow(y, 0);
    tile.stride = stride_;
    for (tile.first = 0; tile.first < width_; tile.first += TILE_PIXELS)
    {
      linearizeTile(tile);
    }
    for (std::size_t c = 0; c < channels_; ++c)
    {
      float* const row = tile.refocused + c * tile.refocused_stride;
      std::fill(row - GRADIENT_PAD, row, row[0]);
      std::fill(row + width_, row + width_ + GRADIENT_PAD, row[width_ - 1]);
    }
  }

  /// The derivatives of the refocused mean by x and y, by differences of four pixels.
  void differentiate(int y) const
  {
    const std::size_t refocused_stride = stride_ + 2 * GRADIENT_PAD;
    for (std::size_t c = 0; c < channels_; ++c)
    {
      const auto row = [&](int dy) { return refocusedRow(y + dy) + c * refocused_stride; };
      const float* const here = row(0);
      const float* const above2 = row(-2);
      const float* const above = row(-1);
      const float* const below = row(1);
      const float* const below2 = row(2);
      float* const along_x = scratch_.gradients.data() + c * stride_;
      float* const along_y = scratch_.gradients.data() + (channels_ + c) * stride_;
      for (int x = 0; x < width_; ++x)
      {
        along_x[x] = NEAR_TAP * (here[x + 1] - here[x - 1]) - FAR_TAP * (here[x + 2] - here[x - 2]);
        along_y[x] = NEAR_TAP * (below[x] - above[x]) - FAR_TAP * (below2[x] - above2[x]);
      }
    }
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
      sumResiduals(y, arm, scratch_.columns.data());
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
      std::fill(pairRow(y, pair), pairRow(y, pair) + pair_stride_, 0.0F);
    }
    differentiate(y);
    for (std::size_t arm = 0; arm < arms_; ++arm)
    {
      float* const share = boxes + arm * width;
      for (std::size_t x = 0; x < width; ++x)
      {
        const float ratio = smallest[x] / share[x];
        share[x] = ratio * ratio * ratio * ratio;
      }
      for (int spoke = spokes_.of_arm[arm].first; spoke < spokes_.of_arm[arm].last; ++spoke)
      {
        addSpoke(y, static_cast<std::size_t>(spoke), share,
                 pairRow(y, views_.arms[arm].direction % DIRECTION_PAIRS));
      }
    }
  }

  /// Sums over the window's rows of the residuals of an arm.
  void sumResiduals(int y, std::size_t arm, float* sums) const
  {
    std::fill(sums, sums + stride_, 0.0F);
    for (int dy = -RESIDUAL_RADIUS; dy <= RESIDUAL_RADIUS; ++dy)
    {
      for (int spoke = spokes_.of_arm[arm].first; spoke < spokes_.of_arm[arm].last; ++spoke)
      {
        const float* const row =
            spokeRow(std::clamp(y + dy, 0, height_ - 1), static_cast<std::size_t>(spoke)) +
            SPOKE_RESIDUAL * stride_;
        for (std::size_t x = 0; x < stride_; ++x)
        {
          sums[x] += row[x];
        }
      }
    }
  }

  /// With the derivative g = -k D of a view's brightness, where D is that of the refocused mean along the
  /// spoke, adds the spoke to the normal equations.
  void addSpoke(int y, std::size_t spoke, const float* share, float* target) const
  {
    const float* const moments = spokeRow(y, spoke);
    const cv::Point2f direction = spokes_.directions[spoke];
    const auto pixels = static_cast<std::size_t>(width_);
    for (std::size_t x = 0; x < pixels; ++x)
    {
      target[MOMENT_KK * stride_ + x] += share[x] * moments[SPOKE_KK * stride_ + x];
    }
    for (std::size_t c = 0; c < channels_; ++c)
    {
      const float* const along_x = scratch_.gradients.data() + c * stride_;
      const float* const along_y = scratch_.gradients.data() + (channels_ + c) * stride_;
      const float* const moment_kr = moments + (SPOKE_KR + c) * stride_;
      for (std::size_t x = 0; x < pixels; ++x)
      {
        const float slope = direction.x * along_x[x] + direction.y * along_y[x];
        const float kk = share[x] * moments[SPOKE_KK * stride_ + x];
        const float kr = share[x] * moment_kr[x];
        target[MOMENT_GG * stride_ + x] += kk * slope * slope;
        target[MOMENT_GR * stride_ + x] -= kr * slope;
        target[(MOMENT_KG + c) * stride_ + x] -= kk * slope;
        target[(MOMENT_KR + c) * stride_ + x] += kr;
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
          y, settings_.window_radius, pair_stride_, [&](int row) { return pairRow(row, pair); },
          scratch_.columns.data());
      float* const box = scratch_.boxes.data();
      for (std::size_t moment = 0; moment < MOMENTS; ++moment)
      {
        boxRow(scratch_.columns.data() + moment * width, width_, settings_.window_radius,
               box + moment * width);
      }
      const float enabled = settings_.brightness_slope ? 1.0F : 0.0F;
      for (std::size_t x = 0; x < pixels; ++x)
      {
        const float inverse = enabled / (box[MOMENT_KK * width + x] + TINY);
        float curvature = box[MOMENT_GG * width + x];
        float gradient = -box[MOMENT_GR * width + x];
        for (std::size_t c = 0; c < channels_; ++c)
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
  const Spokes& spokes_;
  const cv::Mat& disparity_;
  const LinearizationSettings& settings_;
  Scratch& scratch_;
  Linearization& result_;
  int width_;
  int height_;
  std::size_t arms_;
  std::size_t channels_;
  std::size_t stride_;  ///< of one row of numbers
  std::size_t pair_stride_;
  std::vector<int> pairs_;  ///< the directions, modulo their opposites, in which there are views
  int first_ = 0;
  int last_ = 0;
  int near_ring_;
  int pair_ring_;
};

void Linearizer::run(const ViewSet& views, const cv::Mat& disparity, const LinearizationSettings& settings,
                     ThreadPool& pool, Linearization& result)
{
  result.weight.create(disparity.size(), CV_32FC1);
  result.target.create(disparity.size(), CV_32FC1);
  result.residual.create(disparity.size(), CV_32FC1);
  result.disagreement.create(disparity.size(), CV_32FC1);
  const Spokes spokes = findSpokes(views);
  pool.parallelFor(0, disparity.rows, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     auto scratch = takeScratch();
                     Band(views, spokes, disparity, settings, *scratch, result).run(first, last);
                     giveBack(std::move(scratch));
                   });
}

}  // namespace light_field_depth::multiview
