#include "core/cloud/voxel_merger.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace light_field_depth
{
namespace
{
constexpr std::uint32_t NONE = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t MIN_SLOTS = 1024;

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

void add(const VoxelSum& more, VoxelSum& sum)
{
  sum.count += more.count;
  sum.x += more.x;
  sum.y += more.y;
  sum.z += more.z;
  sum.b += more.b;
  sum.g += more.g;
  sum.r += more.r;
}

ColoredPoint meanOf(const VoxelSum& sum)
{
  const auto level = [&sum](std::uint64_t total)
  { return static_cast<std::uint8_t>((total + sum.count / 2) / sum.count); };
  return {static_cast<float>(sum.x / sum.count),
          static_cast<float>(sum.y / sum.count),
          static_cast<float>(sum.z / sum.count),
          level(sum.b),
          level(sum.g),
          level(sum.r),
          0};
}

std::int32_t cellOf(double position)
{
  constexpr double FIRST = std::numeric_limits<std::int32_t>::min();
  constexpr double LAST = std::numeric_limits<std::int32_t>::max();
  const double inside = std::clamp(position, FIRST, LAST);
  const auto truncated = static_cast<std::int32_t>(inside);
  return truncated - static_cast<std::int32_t>(inside < truncated);
}

VoxelKey keyOf(const ColoredPoint& point, double voxels_per_metre)
{
  return {cellOf(point.x * voxels_per_metre), cellOf(point.y * voxels_per_metre),
          cellOf(point.z * voxels_per_metre)};
}

/// Memory that parts and frames share.
VoxelTable& tableOfThisThread()
{
  thread_local VoxelTable table;
  return table;
}

}  // namespace

VoxelTable::VoxelTable() : slots_(MIN_SLOTS, NONE) {}

inline void VoxelTable::clear()
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
    sums_.push_back({key, 0, 0.0, 0.0, 0.0, 0, 0, 0});
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

VoxelMerger::VoxelMerger(std::size_t parts, float voxel_size_m)
    : voxels_per_metre_(1.0 / voxel_size_m), parts_(parts)
{
}

VoxelMerger::Table::Table(VoxelMerger& merger) : merger_(merger), voxels_(tableOfThisThread())
{
  voxels_.clear();
}

void VoxelMerger::Table::add(const ColoredPoint* begin, const ColoredPoint* end)
{
  for (const ColoredPoint* point = begin; point != end; ++point)
  {
    const VoxelKey key = keyOf(*point, merger_.voxels_per_metre_);
    light_field_depth::add({key, 1, point->x, point->y, point->z, point->b, point->g, point->r},
                           voxels_.at(key));
  }
}

void VoxelMerger::Table::store(std::size_t part) const
{
  const std::vector<VoxelSum>& found = voxels_.sums();
  auto& [sums, begins] = merger_.parts_[part];
  begins.fill(0);
  for (const VoxelSum& sum : found)
  {
    ++begins[shareOf(sum.key, SHARES) + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::array<std::size_t, SHARES + 1> next = begins;
  sums.resize(found.size());
  for (const VoxelSum& sum : found)
  {
    sums[next[shareOf(sum.key, SHARES)]++] = sum;
  }
}

VoxelTable VoxelMerger::mergedShare(std::size_t share) const
{
  VoxelTable table;
  for (const Part& part : parts_)
  {
    for (std::size_t i = part.begins[share]; i < part.begins[share + 1]; ++i)
    {
      add(part.sums[i], table.at(part.sums[i].key));
    }
  }
  return table;
}

void VoxelMerger::merge(ThreadPool& pool, const PointAllocator& room) const
{
  std::array<VoxelTable, SHARES> merged;
  std::array<std::size_t, SHARES + 1> begins{};
  pool.parallelFor(0, SHARES, 1,
                   [&](int first, int /*last*/)
                   {
                     const auto share = static_cast<std::size_t>(first);
                     merged[share] = mergedShare(share);
                   });
  for (std::size_t share = 0; share < SHARES; ++share)
  {
    begins[share + 1] = begins[share] + merged[share].sums().size();
  }
  ColoredPoint* const points = room(begins.back());
  if (points == nullptr)
  {
    return;
  }
  pool.parallelFor(0, SHARES, 1,
                   [&](int first, int /*last*/)
                   {
                     const auto share = static_cast<std::size_t>(first);
                     const std::vector<VoxelSum>& sums = merged[share].sums();
                     std::transform(sums.begin(), sums.end(), points + begins[share], meanOf);
                   });
}

}  // namespace light_field_depth
