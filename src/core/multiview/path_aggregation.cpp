#include "light_field_depth/core/multiview/path_aggregation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "light_field_depth/core/multiview/path_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int ROWS_PER_CHUNK = 16;
constexpr int COLUMNS_PER_CHUNK = 32;
constexpr int COLOUR_DIFFERENCES = 3 * 255 + 1;

using StepTable = std::array<std::uint16_t, COLOUR_DIFFERENCES>;

StepTable makeStepTable(const PathSettings& settings)
{
  StepTable table{};
  const float floor = settings.large_step_floor * static_cast<float>(settings.small_step);
  for (std::size_t difference = 0; difference < table.size(); ++difference)
  {
    const float step = static_cast<float>(settings.large_step) / (1.0F + static_cast<float>(difference));
    table[difference] = static_cast<std::uint16_t>(std::lround(std::max(floor, step)));
  }
  return table;
}

/// Sum over three channels; a grey image counts three times.
int colourDifference(const std::uint8_t* a, const std::uint8_t* b, int channels, std::size_t stride)
{
  int sum = 0;
  for (int channel = 0; channel < channels; ++channel)
  {
    const std::size_t offset = static_cast<std::size_t>(channel) * stride;
    sum += std::abs(static_cast<int>(a[offset]) - static_cast<int>(b[offset]));
  }
  return channels == 1 ? 3 * sum : sum;
}

void fillGuards(std::vector<std::uint16_t>& states)
{
  std::fill(states.begin(), states.end(), STATE_GUARD_VALUE);
}

}  // namespace

void PathAggregator::aggregate(const CostVolume& volume, const PlanarImage& guide,
                               const PathSettings& settings, ThreadPool& pool, cv::Mat& label)
{
  label.create(volume.height, volume.width, CV_32FC1);
  sums_.resize(volume.rowOffset(volume.height));
  prepareSteps(guide, settings, pool);
  aggregateRows(volume, settings, pool);
  aggregateColumns(volume, settings, pool, label);
}

void PathAggregator::prepareSteps(const PlanarImage& guide, const PathSettings& settings, ThreadPool& pool)
{
  const auto width = static_cast<std::size_t>(guide.width());
  const std::size_t pixels = width * static_cast<std::size_t>(guide.height());
  width_ = guide.width();
  step_left_.resize(pixels);
  step_above_.resize(pixels);
  const StepTable table = makeStepTable(settings);
  const auto step = [&](const std::uint8_t* a, const std::uint8_t* b) {
    return table[static_cast<std::size_t>(colourDifference(a, b, guide.channels(), guide.channelStride()))];
  };
  pool.parallelFor(0, guide.height(), ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     for (int y = first; y < last; ++y)
                     {
                       const std::uint8_t* const row = guide.row(y);
                       const std::uint8_t* const above = guide.row(y - 1);
                       const std::size_t offset = static_cast<std::size_t>(y) * width;
                       for (std::size_t x = 0; x < width; ++x)
                       {
                         step_left_[offset + x] = step(row + x - (x > 0 ? 1 : 0), row + x);
                         step_above_[offset + x] = step(above + x, row + x);
                       }
                     }
                   });
}

void PathAggregator::aggregateRows(const CostVolume& volume, const PathSettings& settings, ThreadPool& pool)
{
  constexpr std::size_t states_per_chunk = 4;
  const std::size_t state_stride = static_cast<std::size_t>(volume.pitch) + 2 * STATE_GUARD;
  const auto chunks = static_cast<std::size_t>((volume.height + ROWS_PER_CHUNK - 1) / ROWS_PER_CHUNK);
  states_.resize(chunks * states_per_chunk * state_stride);
  fillGuards(states_);
  pool.parallelFor(0, volume.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     const auto chunk = static_cast<std::size_t>(first / ROWS_PER_CHUNK);
                     std::uint16_t* const states = states_.data() + chunk * states_per_chunk * state_stride;
                     PathRow row;
                     row.width = volume.width;
                     row.pitch = volume.pitch;
                     row.p1 = static_cast<std::uint16_t>(settings.small_step);
                     for (int y = first; y < last; ++y)
                     {
                       row.cost = volume.values.data() + volume.rowOffset(y);
                       row.sums = sums_.data() + volume.rowOffset(y);
                       row.p2 = step_left_.data() +
                                static_cast<std::size_t>(y) * static_cast<std::size_t>(volume.width);
                       aggregateRow(row, states);
                     }
                   });
}

void PathAggregator::aggregateColumns(const CostVolume& volume, const PathSettings& settings,
                                      ThreadPool& pool, cv::Mat& label)
{
  const std::size_t state_stride = static_cast<std::size_t>(volume.pitch) + 2 * STATE_GUARD;
  const auto width = static_cast<std::size_t>(volume.width);
  const std::size_t states = width * state_stride;
  states_.resize(2 * states);
  fillGuards(states_);
  minima_.resize(width);
  const auto column_block = [&](int first, int last)
  {
    const auto column = static_cast<std::size_t>(first);
    PathRow row;
    row.width = last - first;
    row.pitch = volume.pitch;
    row.p1 = static_cast<std::uint16_t>(settings.small_step);
    std::uint16_t* before = states_.data() + column * state_stride;
    std::uint16_t* after = before + states;
    for (int i = 0; i < 2 * volume.height; ++i)
    {
      const bool down = i < volume.height;
      const int y = down ? i : 2 * volume.height - 1 - i;
      const bool start = i == 0 || i == volume.height;
      const std::size_t offset = volume.rowOffset(y) + column * static_cast<std::size_t>(volume.pitch);
      const int step_row = down || start ? y : y + 1;
      row.cost = volume.values.data() + offset;
      row.sums = sums_.data() + offset;
      row.p2 = step_above_.data() + static_cast<std::size_t>(step_row) * width + column;
      aggregateStep(row, start, before, after, minima_.data() + column);
      std::swap(before, after);
      if (!down)
      {
        selectLabels(row.sums, row.width, volume.labels, volume.pitch, label.ptr<float>(y) + first);
      }
    }
  };
  pool.parallelFor(0, volume.width, COLUMNS_PER_CHUNK, column_block);
}

}  // namespace light_field_depth::multiview
