#include "io/image_period.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "light_field_depth/core/light_field.h"

namespace light_field_depth
{
namespace
{
/// Decoded Lytro images have 14 or 15 pixels under a lenslet; fewer than 5 views in a row, or lenslets in a
/// row than a view needs pixels, make no light field.
constexpr int MIN_LENSLET_PX = 5;
constexpr int MAX_LENSLET_PX = 20;
constexpr int MIN_LENSLETS = 16;
/// Change of brightness from one lenslet to the next over that inside of one; the blocks of a JPEG reach 1.3.
constexpr double MIN_LENSLET_EDGE = 1.5;
/// Difference of pixels whole lenslets apart over that of pixels half a lenslet more or less apart. It is 1
/// or more where nothing repeats; the dark rim of a lens' lenslets makes it 0.2 to 0.6, and hides the edges
/// between them.
constexpr double MAX_LENSLET_DIFFERENCE = 0.75;
constexpr int LENSLETS_APART = 3;  // the mean of three tells period from texture

/// Columns or rows of views in one image, and the least that makeLightField() takes of each.
constexpr int MAX_TILES = 32;
constexpr int MIN_TILE_PX = 16;
/// Difference of neighbouring tiles over that of parts of the image that are not whole tiles apart.
constexpr double MAX_TILE_DIFFERENCE = 0.75;
/// Change of brightness from one tile to the next over that inside of one.
constexpr double MIN_TILE_EDGE = 1.5;
constexpr double OFF_PERIOD = 0.37;  ///< of a tile: no multiple of a likely period
constexpr int SAMPLE_LINES = 128;    // about, evenly spread

cv::Mat greyLevels(const cv::Mat& image)
{
  cv::Mat grey;
  toGrey(image).convertTo(grey, CV_32F);
  return grey;
}

/// Some rows of an image, evenly spread.
std::vector<int> sampleLines(int count)
{
  std::vector<int> lines;
  const int step = std::max(1, count / SAMPLE_LINES);
  for (int line = step / 2; line < count; line += step)
  {
    lines.push_back(line);
  }
  return lines;
}

/// Mean absolute change along the rows from x to x + 1, for each x.
std::vector<double> changesAlongRows(const cv::Mat& grey)
{
  std::vector<double> changes(static_cast<std::size_t>(grey.cols - 1), 0.0);
  const std::vector<int> lines = sampleLines(grey.rows);
  for (const int y : lines)
  {
    const auto* const row = grey.ptr<float>(y);
    for (std::size_t x = 0; x < changes.size(); ++x)
    {
      changes[x] += std::abs(row[x + 1] - row[x]) / static_cast<double>(lines.size());
    }
  }
  return changes;
}

double shiftDifference(const cv::Mat& grey, int shift)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const int y : sampleLines(grey.rows))
  {
    const auto* const row = grey.ptr<float>(y);
    for (int x = 0; x + shift < grey.cols; ++x)
    {
      sum += std::abs(row[x + shift] - row[x]);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// Mean change at the borders of parts of so many pixels over the mean change elsewhere.
double borderChange(const std::vector<double>& changes, int period)
{
  double at_border = 0.0;
  double elsewhere = 0.0;
  std::size_t borders = 0;
  for (std::size_t x = 0; x < changes.size(); ++x)
  {
    const bool is_border = (x + 1) % static_cast<std::size_t>(period) == 0;
    (is_border ? at_border : elsewhere) += changes[x];
    borders += is_border ? 1 : 0;
  }
  const std::size_t others = changes.size() - borders;
  if (borders == 0 || others == 0 || elsewhere <= 0.0)
  {
    return 0.0;
  }
  return at_border / static_cast<double>(borders) / (elsewhere / static_cast<double>(others));
}

/// The largest of the differences of pixels one to three parts apart, each over that of pixels half a part
/// more or less apart.
double repeatedDifference(const cv::Mat& grey, int period)
{
  double largest = 0.0;
  for (int apart = 1; apart <= LENSLETS_APART; ++apart)
  {
    const int half = period / 2;
    const double other =
        0.5 * (shiftDifference(grey, apart * period - half) + shiftDifference(grey, apart * period + half));
    largest = std::max(largest, other > 0.0 ? shiftDifference(grey, apart * period) / other : 1.0);
  }
  return largest;
}

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The same with medians: only a border between all parts counts, not one between a few of them.
double usualBorderChange(const std::vector<double>& changes, int period)
{
  std::vector<double> at_border;
  std::vector<double> elsewhere;
  for (std::size_t x = 0; x < changes.size(); ++x)
  {
    ((x + 1) % static_cast<std::size_t>(period) == 0 ? at_border : elsewhere).push_back(changes[x]);
  }
  const double usual = at_border.empty() || elsewhere.empty() ? 0.0 : median(elsewhere);
  return usual > 0.0 ? median(at_border) / usual : 0.0;
}

/// How many tiles lie beside each other; 1 if there is no period.
int tilesAlongRows(const cv::Mat& grey)
{
  const std::vector<double> changes = changesAlongRows(grey);
  for (int count = std::min(MAX_TILES, grey.cols / MIN_TILE_PX); count >= 2; --count)
  {
    if (grey.cols % count != 0)
    {
      continue;
    }
    const int width = grey.cols / count;
    const int off = std::max(2, static_cast<int>(std::lround(OFF_PERIOD * width)));
    double other = shiftDifference(grey, width - off);
    if (width + off < grey.cols)
    {
      other = 0.5 * (other + shiftDifference(grey, width + off));
    }
    if (shiftDifference(grey, width) < MAX_TILE_DIFFERENCE * other &&
        borderChange(changes, width) > MIN_TILE_EDGE)
    {
      return count;
    }
  }
  return 1;
}

}  // namespace

cv::Mat extractPart(const cv::Mat& image, const ViewPart& part)
{
  if (part.kind == ViewPart::Kind::Whole)
  {
    return image;
  }
  const int width = image.cols / part.grid.width;
  const int height = image.rows / part.grid.height;
  if (part.kind == ViewPart::Kind::Tile)
  {
    return image(cv::Rect(part.cell.column * width, part.cell.row * height, width, height)).clone();
  }
  cv::Mat view(height, width, image.type());
  const std::size_t pixel = image.elemSize();
  for (int y = 0; y < height; ++y)
  {
    const auto* const from = image.ptr(y * part.grid.height + part.cell.row);
    auto* const to = view.ptr(y);
    for (int x = 0; x < width; ++x)
    {
      const int column = x * part.grid.width + part.cell.column;
      std::copy_n(from + static_cast<std::size_t>(column) * pixel, pixel,
                  to + static_cast<std::size_t>(x) * pixel);
    }
  }
  return view;
}

std::optional<cv::Size> findLenslets(const cv::Mat& image)
{
  const cv::Mat grey = greyLevels(image);
  const cv::Mat turned = grey.t();
  const std::vector<double> along_rows = changesAlongRows(grey);
  const std::vector<double> along_columns = changesAlongRows(turned);
  std::optional<cv::Size> best;
  double best_edge = MIN_LENSLET_EDGE;
  for (int side = MIN_LENSLET_PX; side <= MAX_LENSLET_PX; ++side)
  {
    if (image.cols % side != 0 || image.rows % side != 0 || image.cols < side * MIN_LENSLETS ||
        image.rows < side * MIN_LENSLETS)
    {
      continue;
    }
    if (std::max(repeatedDifference(grey, side), repeatedDifference(turned, side)) < MAX_LENSLET_DIFFERENCE)
    {
      return cv::Size(side, side);  // what repeats after 7 pixels does so after 14 as well
    }
    const double edge = std::min(usualBorderChange(along_rows, side), usualBorderChange(along_columns, side));
    if (edge > best_edge)
    {
      best_edge = edge;
      best = cv::Size(side, side);
    }
  }
  return best;
}

std::optional<cv::Size> findTiles(const cv::Mat& image)
{
  const cv::Mat grey = greyLevels(image);
  const cv::Size tiles(tilesAlongRows(grey), tilesAlongRows(grey.t()));
  return tiles.area() > 1 ? std::make_optional(tiles) : std::nullopt;
}

}  // namespace light_field_depth
