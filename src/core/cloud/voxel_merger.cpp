#include "core/cloud/voxel_merger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace light_field_depth::cloud
{
namespace
{
constexpr std::uint32_t NONE = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t MIN_SLOTS = 1024;
/// What a point of confidence 0 weighs, beside 1 of a sure one. As in the fusion of maps.
constexpr float LEAST_WEIGHT = 0.05F;

std::uint64_t hashOf(const VoxelKey& key)
{
  std::uint64_t mixed = static_cast<std::uint32_t>(key.x) * 0x9E3779B97F4A7C15ULL;
  mixed = (mixed ^ static_cast<std::uint32_t>(key.y)) * 0xC2B2AE3D27D4EB4FULL;
  mixed = (mixed ^ static_cast<std::uint32_t>(key.z)) * 0x165667B19E3779F9ULL;
  return mixed ^ (mixed >> 32);
}

/// Upper bits, because the table uses the lower ones.
std::size_t shareOf(const VoxelKey& key, std::size_t shares)
{
  return static_cast<std::size_t>(hashOf(key) >> 48) % shares;
}

void addPoint(const DensePoint& point, VoxelSum& sum)
{
  const float weight = LEAST_WEIGHT + point.confidence;
  const auto precise = static_cast<double>(weight);
  sum.parts = 1;
  sum.weight += precise;
  sum.position[0] += precise * point.x;
  sum.position[1] += precise * point.y;
  sum.position[2] += precise * point.z;
  sum.normal[0] += weight * point.normal_x;
  sum.normal[1] += weight * point.normal_y;
  sum.normal[2] += weight * point.normal_z;
  sum.colour[0] += weight * static_cast<float>(point.b);
  sum.colour[1] += weight * static_cast<float>(point.g);
  sum.colour[2] += weight * static_cast<float>(point.r);
  sum.confidence += weight * point.confidence;
  sum.votes = std::max(sum.votes, point.views);
}

void addSum(const VoxelSum& more, VoxelSum& sum)
{
  sum.parts += more.parts;
  sum.weight += more.weight;
  for (std::size_t i = 0; i < 3; ++i)
  {
    sum.position[i] += more.position[i];
    sum.normal[i] += more.normal[i];
    sum.colour[i] += more.colour[i];
  }
  sum.confidence += more.confidence;
  sum.votes = std::max(sum.votes, more.votes);
}

DensePoint meanOf(const VoxelSum& sum)
{
  const auto weight = static_cast<float>(sum.weight);
  const auto level = [weight](float total)
  { return static_cast<std::uint8_t>(std::clamp(total / weight + 0.5F, 0.0F, 255.0F)); };
  const float length = std::sqrt(sum.normal[0] * sum.normal[0] + sum.normal[1] * sum.normal[1] +
                                 sum.normal[2] * sum.normal[2]);
  const float scale = length > 0.0F ? 1.0F / length : 0.0F;
  return {static_cast<float>(sum.position[0] / sum.weight),
          static_cast<float>(sum.position[1] / sum.weight),
          static_cast<float>(sum.position[2] / sum.weight),
          scale * sum.normal[0],
          scale * sum.normal[1],
          scale * sum.normal[2],
          level(sum.colour[2]),
          level(sum.colour[1]),
          level(sum.colour[0]),
          sum.votes,
          sum.confidence / weight};
}

std::int32_t cellOf(double position)
{
  constexpr double FIRST = std::numeric_limits<std::int32_t>::min();
  constexpr double LAST = std::numeric_limits<std::int32_t>::max();
  const double inside = std::clamp(position, FIRST, LAST);
  const auto truncated = static_cast<std::int32_t>(inside);
  return truncated - static_cast<std::int32_t>(inside < truncated);
}

/// Memory that parts and frames share.
VoxelTable& tableOfThisThread()
{
  thread_local VoxelTable table;
  return table;
}

}  // namespace

VoxelTable::VoxelTable() : slots_(MIN_SLOTS, NONE) {}

void VoxelTable::clear()
{
  std::fill(slots_.begin(), slots_.end(), NONE);
  sums_.clear();
}

/// Where the key is, or the free slot where it belongs.
inline std::size_t VoxelTable::find(const VoxelKey& key) const
{
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hashOf(key) & mask;
  while (slots_[slot] != NONE && !(sums_[slots_[slot]].key == key))
  {
    slot = (slot + 1) & mask;
  }
  return slot;
}

inline VoxelSum& VoxelTable::at(const VoxelKey& key)
{
  std::size_t slot = find(key);
  if (slots_[slot] == NONE)
  {
    if (2 * sums_.size() >= slots_.size())
    {
      grow();
      slot = find(key);
    }
    slots_[slot] = static_cast<std::uint32_t>(sums_.size());
    sums_.emplace_back();
    sums_.back().key = key;
  }
  return sums_[slots_[slot]];
}

void VoxelTable::grow()
{
  slots_.assign(2 * slots_.size(), NONE);
  for (std::size_t i = 0; i < sums_.size(); ++i)
  {
    slots_[find(sums_[i].key)] = static_cast<std::uint32_t>(i);
  }
}

VoxelMerger::VoxelMerger(float voxel_size_m) : voxels_per_metre_(1.0 / voxel_size_m) {}

void VoxelMerger::sumUp(const std::vector<DensePoint>& points, Part& part) const
{
  VoxelTable& table = tableOfThisThread();
  table.clear();
  for (const DensePoint& point : points)
  {
    addPoint(point, table.at({cellOf(point.x * voxels_per_metre_), cellOf(point.y * voxels_per_metre_),
                              cellOf(point.z * voxels_per_metre_)}));
  }
  part.begins.fill(0);
  for (const VoxelSum& sum : table.sums())
  {
    ++part.begins[shareOf(sum.key, SHARES) + 1];
  }
  std::partial_sum(part.begins.begin(), part.begins.end(), part.begins.begin());
  std::array<std::size_t, SHARES + 1> next = part.begins;
  part.sums.resize(table.sums().size());
  for (const VoxelSum& sum : table.sums())
  {
    part.sums[next[shareOf(sum.key, SHARES)]++] = sum;
  }
}

void VoxelMerger::add(const std::vector<Part>& parts, std::size_t count, ThreadPool& pool)
{
  pool.parallelFor(0, static_cast<int>(SHARES), 1,
                   [&](int first, int last)
                   {
                     for (auto share = static_cast<std::size_t>(first);
                          share < static_cast<std::size_t>(last); ++share)
                     {
                       for (std::size_t i = 0; i < count; ++i)
                       {
                         const Part& part = parts[i];
                         for (std::size_t k = part.begins[share]; k < part.begins[share + 1]; ++k)
                         {
                           addSum(part.sums[k], merged_[share].at(part.sums[k].key));
                         }
                       }
                     }
                   });
}

void VoxelMerger::emit(std::uint32_t min_parts, const DensePointSink& sink) const
{
  std::vector<DensePoint> points;
  for (const VoxelTable& table : merged_)
  {
    points.clear();
    for (const VoxelSum& sum : table.sums())
    {
      if (sum.parts >= min_parts)
      {
        points.push_back(meanOf(sum));
      }
    }
    if (!points.empty())
    {
      sink(points.data(), points.size());
    }
  }
}

}  // namespace light_field_depth::cloud
