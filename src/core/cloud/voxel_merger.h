#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light_field_depth/core/point_cloud.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// The cube of a cubic grid that a point lies in. Where the grid ends, its outermost cubes go on for ever.
struct VoxelKey
{
  std::int32_t x;
  std::int32_t y;
  std::int32_t z;

  bool operator==(const VoxelKey& other) const { return x == other.x && y == other.y && z == other.z; }
};

/// The points of one voxel so far: as many as fit into a cloud, so their levels need more than 32 bits.
struct VoxelSum
{
  VoxelKey key;
  std::uint32_t count;
  double x;
  double y;
  double z;
  std::uint64_t b;
  std::uint64_t g;
  std::uint64_t r;
};

/// Sums by key, in the order in which the keys came.
class VoxelTable
{
public:
  VoxelTable();

  /// Keeps the memory.
  void clear();

  /// The sum of a voxel; of no points when the voxel is new. Valid until the next call.
  VoxelSum& at(const VoxelKey& key);
  const std::vector<VoxelSum>& sums() const { return sums_; }

private:
  std::size_t find(const VoxelKey& key) const;
  void grow();

  std::vector<std::uint32_t> slots_;  ///< open addresses: indices of sums_; a power of two of them
  std::vector<VoxelSum> sums_;
};

/// Merges the points of each voxel into their mean, in two steps: first the points of each part of the cloud,
/// the parts side by side, then voxels that several parts have met. The result depends on the points, their
/// order and their division into parts alone.
class VoxelMerger
{
public:
  /// @param parts that the cloud is made of
  /// @param voxel_size_m edge of the cubes, > 0
  VoxelMerger(std::size_t parts, float voxel_size_m);

  /// The voxels of one part, on one thread; at most one at a time in each thread.
  class Table;

  /// Once every part has been stored: one point a voxel.
  void merge(ThreadPool& pool, const PointAllocator& room) const;

private:
  /// Shares of the space, by a hash of the key, that are merged independently of each other.
  static constexpr std::size_t SHARES = 16;

  /// The voxels of a part, those of one share beside each other.
  struct Part
  {
    std::vector<VoxelSum> sums;
    std::array<std::size_t, SHARES + 1> begins;
  };

  VoxelTable mergedShare(std::size_t share) const;

  double voxels_per_metre_;
  std::vector<Part> parts_;
};

class VoxelMerger::Table
{
public:
  explicit Table(VoxelMerger& merger);

  void add(const ColoredPoint* begin, const ColoredPoint* end);

  /// What has been added is one part.
  void store(std::size_t part) const;

private:
  VoxelMerger& merger_;
  VoxelTable& voxels_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H
