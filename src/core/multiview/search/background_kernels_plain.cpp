#include <algorithm>
#include <cmath>

#include "core/multiview/search/background_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
/// The tile of the column x - 1 .. x + 1 of SupportLine, and the place in it.
const SupportLine::Lines& tileOf(const SupportLine& line, int x)
{
  return x < 0 ? line.left : x >= TILE_PX ? line.right : line.here;
}

bool isSupported(const SupportLine& line, int x, int label)
{
  int sum = 0;
  for (int at_x = x - 1; at_x <= x + 1; ++at_x)
  {
    const SupportLine::Lines& lines = tileOf(line, at_x);
    if (!lines[0].comparable(label, line.distance) || !lines[2].comparable(label, line.distance))
    {
      return false;
    }
    const int inside = (at_x + TILE_PX) % TILE_PX;
    for (const TileLine& row : lines)
    {
      sum += row.at(label - line.distance)[inside] + row.at(label + line.distance)[inside] -
             2 * row.at(label)[inside];
    }
  }
  return sum > line.threshold;
}

}  // namespace

void findLabelCostsPlain(const LabelCosts& costs)
{
  const LabelBand& band = costs.line.band;
  for (int x = 0; x < costs.count; ++x)
  {
    const float label = costs.label[x];
    costs.rounded[x] = static_cast<std::int16_t>(std::nearbyint(label));
    const float inside =
        std::clamp(label, static_cast<float>(band.first), static_cast<float>(band.end() - 1));
    const int below = std::max(band.first, std::min(static_cast<int>(inside), band.end() - 2));
    const float part = inside - static_cast<float>(below);
    const int above = std::min(below + 1, band.end() - 1);
    costs.cost[x] = static_cast<float>(costs.line.at(below)[x]) * (1.0F - part) +
                    static_cast<float>(costs.line.at(above)[x]) * part;
  }
}

void countSupportedPlain(const SupportLine& line, const std::int16_t* labels, int* counts)
{
  for (int x = 0; x < TILE_PX; ++x)
  {
    if (labels[x] != NO_LABEL && isSupported(line, x, labels[x]))
    {
      ++counts[labels[x]];
    }
  }
}

void addChargesPlain(const std::uint8_t* charge, int labels, std::uint8_t* costs)
{
  for (int label = 0; label < labels; ++label)
  {
    for (int i = 0; i < TILE_PX; ++i)
    {
      std::uint8_t& cost = costs[label * TILE_PX + i];
      cost = static_cast<std::uint8_t>(std::min(cost + charge[label], 255));
    }
  }
}

}  // namespace light_field_depth::multiview
