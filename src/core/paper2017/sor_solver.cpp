#include "core/paper2017/sor_solver.h"

#include <algorithm>
#include <array>

namespace light_field_depth
{
namespace
{
/// Rows of one task. Set by hand: enough tasks for every thread; results do not depend on it.
constexpr int ROWS_PER_CHUNK = 64;
/// Keeps a pixel without data and without links from dividing by zero.
constexpr float TINY = 1e-12F;

/// Columns of margin, so that the neighbours of border pixels can be read.
constexpr int MARGIN = 1;

/// The pixels of one colour of a chequerboard, packed: element i of row y is pixel x = 2 i + (y + colour)
/// % 2. Neighbours in the other colour are then contiguous, and half sweeps run at full vector width.
class HalfGrid
{
public:
  HalfGrid() = default;
  HalfGrid(const cv::Size& size, int colour)
      : colour_(colour),
        values_(cv::Mat::zeros(size.height + 2 * MARGIN, (size.width + 1) / 2 + 2 * MARGIN, CV_32FC1))
  {
  }

  int parity(int y) const { return (y + colour_) & 1; }
  float* row(int y) { return values_.ptr<float>(y + MARGIN) + MARGIN; }
  const float* row(int y) const { return values_.ptr<float>(y + MARGIN) + MARGIN; }

  void read(const cv::Mat& full)
  {
    for (int y = 0; y < full.rows; ++y)
    {
      const auto* const in = full.ptr<float>(y);
      float* out = row(y);
      for (int x = parity(y); x < full.cols; x += 2)
      {
        *out++ = in[x];
      }
    }
  }

  void write(cv::Mat& full) const
  {
    for (int y = 0; y < full.rows; ++y)
    {
      auto* const out = full.ptr<float>(y);
      const float* in = row(y);
      for (int x = parity(y); x < full.cols; x += 2)
      {
        out[x] = *in++;
      }
    }
  }

private:
  int colour_ = 0;
  cv::Mat values_;
};

/// Everything that a half sweep reads of its own colour.
struct HalfSystem
{
  HalfGrid left, right, above, below, right_side, inverse_diagonal;
};

/// The link of each pixel to its neighbour at (-dx, -dy), 0 beyond the border.
cv::Mat linkFrom(const cv::Mat& link, int dx, int dy)
{
  cv::Mat result = cv::Mat::zeros(link.size(), CV_32FC1);
  const cv::Size inner(link.cols - dx, link.rows - dy);
  link(cv::Rect({0, 0}, inner)).copyTo(result(cv::Rect({dx, dy}, inner)));
  return result;
}

cv::Mat linkTo(const cv::Mat& link, int dx, int dy)
{
  cv::Mat result = cv::Mat::zeros(link.size(), CV_32FC1);
  const cv::Rect inner(0, 0, link.cols - dx, link.rows - dy);
  link(inner).copyTo(result(inner));
  return result;
}

std::array<HalfSystem, 2> split(const GridSystem& system)
{
  const cv::Mat left = linkFrom(system.link_right, 1, 0);
  const cv::Mat right = linkTo(system.link_right, 1, 0);
  const cv::Mat above = linkFrom(system.link_below, 0, 1);
  const cv::Mat below = linkTo(system.link_below, 0, 1);
  const cv::Mat diagonal = system.data + left + right + above + below + static_cast<double>(TINY);
  const cv::Mat inverse = 1.0 / diagonal;
  std::array<HalfSystem, 2> halves;
  for (int colour = 0; colour < 2; ++colour)
  {
    const auto half = [&](const cv::Mat& full)
    {
      HalfGrid grid(full.size(), colour);
      grid.read(full);
      return grid;
    };
    halves[static_cast<std::size_t>(colour)] = {
        half(left), half(right), half(above), half(below), half(system.right_side), half(inverse)};
  }
  return halves;
}

/// One row of one colour. @param shift index of the left neighbour relative to the own index, -1 or 0
void relaxRow(const HalfSystem& half, const HalfGrid& other, int y, int count, int shift, float omega,
              float* own)
{
  const float* const left = half.left.row(y);
  const float* const right = half.right.row(y);
  const float* const above = half.above.row(y);
  const float* const below = half.below.row(y);
  const float* const side = half.right_side.row(y);
  const float* const inverse = half.inverse_diagonal.row(y);
  const float* const at_left = other.row(y) + shift;
  const float* const at_right = at_left + 1;
  const float* const at_above = other.row(y - 1);
  const float* const at_below = other.row(y + 1);
  for (int i = 0; i < count; ++i)
  {
    const float solved = (side[i] + left[i] * at_left[i] + right[i] * at_right[i] + above[i] * at_above[i] +
                          below[i] * at_below[i]) *
                         inverse[i];
    own[i] += omega * (solved - own[i]);
  }
}

}  // namespace

void solveBySor(const GridSystem& system, int iterations, float omega, cv::Mat& values, ThreadPool& pool)
{
  const std::array<HalfSystem, 2> halves = split(system);
  std::array<HalfGrid, 2> unknowns = {HalfGrid(values.size(), 0), HalfGrid(values.size(), 1)};
  unknowns[0].read(values);
  unknowns[1].read(values);
  for (int half_sweep = 0; half_sweep < 2 * iterations; ++half_sweep)
  {
    const auto colour = static_cast<std::size_t>(half_sweep % 2);
    HalfGrid& own = unknowns[colour];
    const HalfGrid& other = unknowns[1 - colour];
    pool.parallelFor(0, values.rows, ROWS_PER_CHUNK,
                     [&](int first, int last)
                     {
                       for (int y = first; y < last; ++y)
                       {
                         const int parity = own.parity(y);
                         const int count = (values.cols - parity + 1) / 2;
                         relaxRow(halves[colour], other, y, count, parity - 1, omega, own.row(y));
                       }
                     });
  }
  unknowns[0].write(values);
  unknowns[1].write(values);
}

}  // namespace light_field_depth
