#include "kernel_data.h"
#include "kernels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/light_field/half_resolution_kernels.h"
#include "core/light_field/pixel_kernels.h"
#include "core/multiview/search/cost_kernels.h"
#include "core/multiview/search/path_kernels.h"
#include "core/multiview/search/sample_rows.h"
#include "core/multiview/search/visibility_kernels.h"

namespace light_field_depth::benchmark
{
namespace
{
using namespace multiview;

/// Rows of the reference and of four arms of four views.
struct ViewRows
{
  std::vector<std::uint8_t> reference = randomBytes(CHANNELS * STRIDE, 60);
  std::vector<std::uint8_t> samples = randomBytes(VIEWS * CHANNELS * STRIDE, 60);
  std::vector<std::uint8_t> surfaces = randomBytes(VIEWS * STRIDE, 60);
  std::vector<std::uint8_t> cost = std::vector<std::uint8_t>(STRIDE);
  std::array<Arm, 4> arms = {{{0, 4, 0}, {4, 8, 2}, {8, 12, 4}, {12, 16, 6}}};
  std::array<std::uint16_t, 4> arm_scales{};
  std::array<const std::uint8_t*, VIEWS> sample_rows{};
  std::array<const std::uint8_t*, VIEWS> surface_rows{};
  ArmCostRow arm_cost;
  VisibleCostRow visible_cost;

  ViewRows()
  {
    constexpr int fixed_point = 256;
    arm_scales.fill(static_cast<std::uint16_t>(FULL_COST * fixed_point / (4 * arm_cost.truncation)));
    for (std::size_t view = 0; view < VIEWS; ++view)
    {
      sample_rows[view] = &samples[view * CHANNELS * STRIDE];
      surface_rows[view] = &surfaces[view * STRIDE];
    }
    arm_cost.reference = visible_cost.reference = reference.data();
    arm_cost.reference_stride = visible_cost.reference_stride = STRIDE;
    arm_cost.samples = visible_cost.samples = sample_rows.data();
    arm_cost.sample_stride = visible_cost.sample_stride = STRIDE;
    arm_cost.width = visible_cost.width = WIDTH;
    arm_cost.arms = arms.data();
    arm_cost.arm_count = static_cast<int>(arms.size());
    arm_cost.best_arms = 2;
    arm_cost.arm_scales = arm_scales.data();
    visible_cost.surfaces = surface_rows.data();
    visible_cost.views = static_cast<int>(VIEWS);
    visible_cost.hidden_above = 40;
    visible_cost.unseen_penalty = 30;
  }
};

Kernel interpolation()
{
  const auto rows = std::make_shared<ViewRows>();
  const auto with = [&](auto kernel)
  {
    return calling(
        rows,
        [kernel](ViewRows& data)
        {
          const std::uint8_t* const first = data.reference.data();
          kernel({first, first + 1, first + 2, first + 3}, SUBPIXEL_PHASES / 4, WIDTH, data.cost.data());
        });
  };
  return {"sub-pixel row", "pixel", PIXELS, 2.0 * PIXELS, with(interpolateTaps), with(interpolateTapsPlain)};
}

Kernel armCost()
{
  const auto rows = std::make_shared<ViewRows>();
  const auto with = [&](auto kernel)
  { return calling(rows, [kernel](ViewRows& data) { kernel(data.arm_cost, data.cost.data()); }); };
  return {"cost of the best arms", "pixel x view",
          PIXELS * VIEWS,          PIXELS * (CHANNELS * (VIEWS + 1) + 1.0),
          with(armCostRow),        with(armCostRowPlain)};
}

Kernel visibleCost()
{
  const auto rows = std::make_shared<ViewRows>();
  const auto with = [&](auto kernel)
  { return calling(rows, [kernel](ViewRows& data) { kernel(data.visible_cost, data.cost.data()); }); };
  return {"cost of the seeing views",
          "pixel x view",
          PIXELS * VIEWS,
          PIXELS * (CHANNELS * (VIEWS + 1) + VIEWS + 1.0),
          with(visibleCostRow),
          with(visibleCostRowPlain)};
}

/// One tile of a cost volume, and the states of its paths.
struct PathData
{
  std::vector<std::uint8_t> cost = randomBytes(TILE_ENTRIES, FULL_COST);
  std::vector<std::uint8_t> transposed = std::vector<std::uint8_t>(TILE_ENTRIES);
  std::vector<std::uint16_t> sums = std::vector<std::uint16_t>(TILE_ENTRIES);
  std::vector<std::uint16_t> large_change_penalty = std::vector<std::uint16_t>(TILE_PX, 500);
  std::vector<std::uint16_t> state = std::vector<std::uint16_t>((LABELS + 2) * TILE_PX, NO_STATE);
  std::array<std::uint16_t, TILE_PX> minima{};
  std::vector<std::uint16_t> line = std::vector<std::uint16_t>(static_cast<std::size_t>(LABELS) * TILE_PX);
  std::array<float, static_cast<std::size_t>(TILE_PX) * TILE_PX> best{};
  PathTile tile;

  PathData()
  {
    std::fill(state.begin() + TILE_PX, state.end() - TILE_PX, std::uint16_t{0});
    tile.cost = cost.data();
    tile.labels = LABELS;
    tile.small_change_penalty = 30;
    tile.large_change_penalty = large_change_penalty.data();
    tile.state = state.data() + TILE_PX;
    tile.minima = minima.data();
  }
};

Kernel transposition()
{
  const auto paths = std::make_shared<PathData>();
  const auto with = [&](auto kernel)
  {
    return calling(paths,
                   [kernel](PathData& data) { kernel(data.cost.data(), LABELS, data.transposed.data()); });
  };
  using Kernel8 = void (*)(const std::uint8_t*, int, std::uint8_t*);
  return {"tile turned over",
          "entry",
          TILE_ENTRIES,
          2.0 * TILE_ENTRIES,
          with(static_cast<Kernel8>(transposeTile)),
          with(static_cast<Kernel8>(transposeTilePlain))};
}

Kernel tilePaths()
{
  const auto paths = std::make_shared<PathData>();
  const auto with = [&](auto kernel)
  { return calling(paths, [kernel](PathData& data) { kernel(data.tile, data.sums.data()); }); };
  // Cost, sums written, states read and written.
  return {"paths through a tile", "entry x path", TILE_ENTRIES,
          7.0 * TILE_ENTRIES,     with(walkTile), with(walkTilePlain)};
}

Kernel labelSelection()
{
  const auto paths = std::make_shared<PathData>();
  const auto with = [&](auto kernel)
  {
    return calling(
        paths, [kernel](PathData& data)
        { kernel(data.tile, data.sums.data(), data.cost.data(), 0, data.line.data(), data.best.data()); });
  };
  // Cost, sums, states read and written.
  return {"last paths and best labels", "entry x path",       TILE_ENTRIES,
          8.0 * TILE_ENTRIES,           with(selectFromTile), with(selectFromTilePlain)};
}

Kernel warping()
{
  struct Map
  {
    std::vector<float> disparity = std::vector<float>(STRIDE);
    std::vector<std::int32_t> targets = std::vector<std::int32_t>(STRIDE);
    WarpRow row;

    Map()
    {
      for (std::size_t x = 0; x < PIXELS; ++x)
      {
        disparity[x] = static_cast<float>(x % 100) / 100.0F;
      }
      row.disparity = disparity.data();
      row.width = WIDTH;
      row.height = WIDTH;
      row.step_x = 2.0F;
      row.base_x = 0.5F;
      row.base_y = static_cast<float>(WIDTH) / 2.0F;
      row.pitch = WIDTH;
    }
  };
  const auto map = std::make_shared<Map>();
  const auto with = [&](auto kernel)
  { return calling(map, [kernel](Map& data) { kernel(data.row, data.targets.data()); }); };
  return {"where a view sees the surface",
          "pixel",
          PIXELS,
          PIXELS * (sizeof(float) + sizeof(std::int32_t)),
          with(warpTargets),
          with(warpTargetsPlain)};
}

Kernel halving()
{
  struct Rows
  {
    std::vector<std::uint8_t> upper = randomBytes(2 * CHANNELS * STRIDE, 255);
    std::vector<std::uint8_t> lower = randomBytes(2 * CHANNELS * STRIDE, 255);
    std::vector<std::uint8_t> half = std::vector<std::uint8_t>(STRIDE);
  };
  const auto rows = std::make_shared<Rows>();
  const auto with = [&](auto kernel)
  {
    return calling(rows,
                   [kernel](Rows& data) {
                     kernel(data.upper.data(), data.lower.data(), static_cast<int>(CHANNELS), WIDTH,
                            data.half.data());
                   });
  };
  return {"half resolution in grey",       "reduced pixel", PIXELS,
          PIXELS * (4.0 * CHANNELS + 1.0), with(halveRow),  with(halveRowPlain)};
}

Kernel pixelSplitting()
{
  struct Rows
  {
    std::vector<std::uint8_t> pixels = randomBytes(CHANNELS * STRIDE, 255);
    std::vector<std::uint8_t> planes = std::vector<std::uint8_t>(CHANNELS * STRIDE);
  };
  const auto rows = std::make_shared<Rows>();
  const auto with = [&](auto kernel)
  {
    return calling(rows,
                   [kernel](Rows& data)
                   {
                     std::uint8_t* const plane = data.planes.data();
                     kernel({data.pixels.data(), WIDTH, {plane, plane + STRIDE, plane + 2 * STRIDE}});
                   });
  };
  return {"pixels to planes",    "pixel", PIXELS, PIXELS * (3.0 * CHANNELS + 1.0), with(splitPixels),
          with(splitPixelsPlain)};
}

}  // namespace

std::vector<Kernel> searchKernels()
{
  return {interpolation(),  armCost(), visibleCost(), transposition(), tilePaths(),
          labelSelection(), warping(), halving(),     pixelSplitting()};
}

}  // namespace light_field_depth::benchmark
