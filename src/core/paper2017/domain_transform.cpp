#include "core/paper2017/domain_transform.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace light_field_depth
{
namespace
{
/// Of the paper's colour difference; a grey image counts three times.
constexpr int COLOR_CHANNELS = 3;

int colorDifference(const std::uint8_t* a, const std::uint8_t* b, int channels)
{
  int sum = 0;
  for (int c = 0; c < channels; ++c)
  {
    sum += std::abs(static_cast<int>(a[c]) - static_cast<int>(b[c]));
  }
  return sum;
}

/// Rows that are filtered at once: each step along a row waits for the one before it, so a processor that has
/// several in hand waits less.
constexpr int ROWS_AT_ONCE = 4;

struct FilteredRow
{
  const float* feedback = nullptr;
  float* weighted = nullptr;
  float* weight = nullptr;
};

/// There and back along COUNT rows.
template <std::size_t COUNT>
void filterTogether(const std::array<FilteredRow, ROWS_AT_ONCE>& rows, int width)
{
  for (int x = 1; x < width; ++x)
  {
    for (std::size_t r = 0; r < COUNT; ++r)
    {
      const FilteredRow& row = rows[r];
      const float a = row.feedback[x];
      row.weighted[x] += a * (row.weighted[x - 1] - row.weighted[x]);
      row.weight[x] += a * (row.weight[x - 1] - row.weight[x]);
    }
  }
  for (int x = width - 2; x >= 0; --x)
  {
    for (std::size_t r = 0; r < COUNT; ++r)
    {
      const FilteredRow& row = rows[r];
      const float a = row.feedback[x + 1];
      row.weighted[x] += a * (row.weighted[x + 1] - row.weighted[x]);
      row.weight[x] += a * (row.weight[x + 1] - row.weight[x]);
    }
  }
}

void mixRows(const float* feedback, int width, const float* from, float* into)
{
  for (int x = 0; x < width; ++x)
  {
    into[x] += feedback[x] * (from[x] - into[x]);
  }
}

void rowFeedback(const cv::Mat& guide, const FeedbackTable& table, int y, float* feedback)
{
  const int channels = guide.channels();
  const std::uint8_t* color = guide.ptr<std::uint8_t>(y);
  for (int x = 1; x < guide.cols; ++x)
  {
    feedback[x] = table[colorDifference(color + x * channels, color + (x - 1) * channels, channels)];
  }
}

void filterRows(const cv::Mat& guide, const FeedbackTable& table, WeightedValues& values)
{
  const auto width = static_cast<std::size_t>(guide.cols);
  std::vector<float> feedback(ROWS_AT_ONCE * width);
  std::array<FilteredRow, ROWS_AT_ONCE> rows;
  const auto prepare = [&](int y, std::size_t slot)
  {
    float* const row = feedback.data() + slot * width;
    rowFeedback(guide, table, y, row);
    rows[slot] = {row, values.weighted.ptr<float>(y), values.weight.ptr<float>(y)};
  };
  int y = 0;
  for (; y + ROWS_AT_ONCE <= guide.rows; y += ROWS_AT_ONCE)
  {
    for (int r = 0; r < ROWS_AT_ONCE; ++r)
    {
      prepare(y + r, static_cast<std::size_t>(r));
    }
    filterTogether<ROWS_AT_ONCE>(rows, guide.cols);
  }
  for (; y < guide.rows; ++y)
  {
    prepare(y, 0);
    filterTogether<1>(rows, guide.cols);
  }
}

void filterColumns(const cv::Mat& guide, const FeedbackTable& table, WeightedValues& values)
{
  const int channels = guide.channels();
  cv::Mat feedback(guide.size(), CV_32FC1);
  for (int y = 1; y < guide.rows; ++y)
  {
    const std::uint8_t* color = guide.ptr<std::uint8_t>(y);
    const std::uint8_t* above = guide.ptr<std::uint8_t>(y - 1);
    float* out = feedback.ptr<float>(y);
    for (int x = 0; x < guide.cols; ++x)
    {
      out[x] = table[colorDifference(color + x * channels, above + x * channels, channels)];
    }
    mixRows(out, guide.cols, values.weighted.ptr<float>(y - 1), values.weighted.ptr<float>(y));
    mixRows(out, guide.cols, values.weight.ptr<float>(y - 1), values.weight.ptr<float>(y));
  }
  for (int y = guide.rows - 2; y >= 0; --y)
  {
    const float* a = feedback.ptr<float>(y + 1);
    mixRows(a, guide.cols, values.weighted.ptr<float>(y + 1), values.weighted.ptr<float>(y));
    mixRows(a, guide.cols, values.weight.ptr<float>(y + 1), values.weight.ptr<float>(y));
  }
}

}  // namespace

FeedbackTable::FeedbackTable(const DomainTransformScale& scale, int iteration, int iterations, int channels)
    : coefficients_(static_cast<std::size_t>(255 * channels + 1))
{
  const double deviation = scale.distance * std::sqrt(3.0) * std::exp2(iterations - 1 - iteration) /
                           std::sqrt(std::exp2(2 * iterations) - 1.0);
  // A grey image counts as a colour image with three equal channels.
  const double per_level = scale.distance / scale.range / 255.0 * COLOR_CHANNELS / channels;
  for (std::size_t difference = 0; difference < coefficients_.size(); ++difference)
  {
    const double distance = 1.0 + per_level * static_cast<double>(difference);
    coefficients_[difference] = static_cast<float>(std::exp(-std::sqrt(2.0) / deviation * distance));
  }
}

void filterSpatially(const cv::Mat& guide, const FeedbackTable& table, WeightedValues& values)
{
  filterRows(guide, table, values);
  filterColumns(guide, table, values);
}

}  // namespace light_field_depth
