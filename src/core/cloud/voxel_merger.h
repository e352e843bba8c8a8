#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "light_field_depth/core/point_cloud.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth::cloud
{
/// The cube of a cubic grid that a point lies in. Where the grid ends, its outermost cubes go on for ever.
struct VoxelKey
{
  std::int32_t x;
  std::int32_t y;
  std::int32_t z;

  bool operator==(const VoxelKey& other) const { return x == other.x && y == other.y && z == other.z; }
};

/// The points of one voxel so far, weighted.
struct VoxelSum
{
  VoxelKey key;
  std::uint32_t parts = 0;  ///< that have a point here
  double weight = 0.0;
  std::array<double, 3> position{};
  std::array<float, 3> normal{};
  std::array<float, 3> colour{};  ///< b, g, r
  float confidence = 0.0F;
  std::uint8_t votes = 0;  ///< the most of any point
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

/// Merges the points of each voxel into their weighted mean. Each view's points are a part; parts are summed
/// up side by side, then added in their order. The result depends on the points, their order and their
/// division into parts alone.
class VoxelMerger
{
public:
  /// @param voxel_size_m edge of the cubes, > 0
  explicit VoxelMerger(float voxel_size_m);

  /// Shares of the space, by a hash of the key, that are merged independently of each other.
  static constexpr std::size_t SHARES = 16;

  /// The voxels of a part, those of one share beside each other.
  struct Part
  {
    std::vector<VoxelSum> sums;
    std::array<std::size_t, SHARES + 1> begins{};
  };

  /// Thread safe. @param part memory that it brings is used again
  void sumUp(const std::vector<DensePoint>& points, Part& part) const;

  /// Adds parts one after the other, the shares in parallel.
  void add(const std::vector<Part>& parts, std::size_t count, ThreadPool& pool);

  /// One point for each voxel that has points of at least min_parts parts.
  void emit(std::uint32_t min_parts, const DensePointSink& sink) const;

private:
  double voxels_per_metre_;
  std::array<VoxelTable, SHARES> merged_;
};

}  // namespace light_field_depth::cloud

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_CLOUD_VOXEL_MERGER_H
