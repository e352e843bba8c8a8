#include "kernels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>

#include "light_field_depth/core/multiview/background_kernels.h"
#include "light_field_depth/core/multiview/confidence_kernels.h"
#include "light_field_depth/core/multiview/cost_kernels.h"
#include "light_field_depth/core/multiview/half_resolution.h"
#include "light_field_depth/core/multiview/linearize_kernels.h"
#include "light_field_depth/core/multiview/median.h"
#include "light_field_depth/core/multiview/path_kernels.h"
#include "light_field_depth/core/multiview/pixel_kernels.h"
#include "light_field_depth/core/multiview/sample_rows.h"
#include "light_field_depth/core/multiview/smoothing_kernels.h"
#include "light_field_depth/core/multiview/visibility_kernels.h"

namespace light_field_depth::benchmark
{
namespace
{
using namespace multiview;

constexpr int WIDTH = 512;
constexpr std::size_t PIXELS = WIDTH;
constexpr std::size_t STRIDE = WIDTH + 2 * VECTOR_OVERRUN;  // between the channels of a row
constexpr std::size_t CHANNELS = 3;
constexpr std::size_t VIEWS = 16;
constexpr int LABELS = 32;
constexpr std::size_t ENTRIES = PIXELS * LABELS;
constexpr std::size_t TILE_ENTRIES = static_cast<std::size_t>(TILE_PX) * TILE_PX * LABELS;

std::vector<std::uint8_t> randomBytes(std::size_t count, int limit)
{
  std::mt19937 engine(static_cast<std::uint32_t>(count));
  std::uniform_int_distribution<int> distribution(0, limit);
  std::vector<std::uint8_t> values(count);
  for (auto& value : values)
  {
    value = static_cast<std::uint8_t>(distribution(engine));
  }
  return values;
}

/// One call of a kernel on data that the call keeps alive.
template <class Data, class Call>
std::function<void()> calling(std::shared_ptr<Data> data, const Call& call)
{
  return [data = std::move(data), call] { call(*data); };
}

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
  std::vector<std::uint16_t> p2 = std::vector<std::uint16_t>(TILE_PX, 500);
  std::vector<std::uint16_t> state = std::vector<std::uint16_t>((LABELS + 2) * TILE_PX, NO_STATE);
  std::array<std::uint16_t, TILE_PX> minima{};
  std::array<float, TILE_PX> best{};
  PathTile tile;

  PathData()
  {
    std::fill(state.begin() + TILE_PX, state.end() - TILE_PX, std::uint16_t{0});
    tile.cost = cost.data();
    tile.sums = sums.data();
    tile.labels = LABELS;
    tile.p1 = 30;
    tile.p2 = p2.data();
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
  { return calling(paths, [kernel](PathData& data) { kernel(data.tile); }); };
  // Cost, sums written, states read and written.
  return {"paths through a tile", "entry x path",      TILE_ENTRIES,
          7.0 * TILE_ENTRIES,     with(aggregateTile), with(aggregateTilePlain)};
}

Kernel labelSelection()
{
  constexpr std::size_t entries = static_cast<std::size_t>(TILE_PX) * LABELS;
  const auto paths = std::make_shared<PathData>();
  const auto with = [&](auto kernel)
  {
    return calling(paths,
                   [kernel](PathData& data) { kernel(data.sums.data(), LABELS, 0, data.best.data()); });
  };
  return {"best label", "entry", entries, 2.0 * entries, with(selectLabels), with(selectLabelsPlain)};
}

/// One tile of a row, with views on a cross.
struct LinearizeData
{
  static constexpr int HEIGHT = 32;
  static constexpr std::size_t PAD = VECTOR_ROOM;
  static constexpr std::size_t PITCH = PIXELS + 2 * PAD;
  static constexpr std::size_t VIEW_BYTES = HEIGHT * CHANNELS * PITCH;
  static constexpr std::size_t SPOKES = 4;

  std::vector<std::uint8_t> pixels = randomBytes(VIEWS * VIEW_BYTES, 60);
  std::vector<std::uint8_t> reference = randomBytes(CHANNELS * STRIDE, 60);
  std::vector<float> disparity = std::vector<float>(STRIDE);
  std::vector<float> weights = std::vector<float>(SPOKES * TILE_PIXELS);
  std::vector<float> refocused = std::vector<float>(CHANNELS * STRIDE);
  std::vector<float> moments = std::vector<float>(SPOKES * SPOKE_MOMENTS * STRIDE);
  std::array<SampledView, VIEWS> views{};
  std::array<Spoke, SPOKES> spokes = {{{0, 4}, {4, 8}, {8, 12}, {12, 16}}};
  LinearizeTile tile;

  LinearizeData()
  {
    for (std::size_t x = 0; x < PIXELS; ++x)
    {
      disparity[x] = static_cast<float>(x % 100) / 100.0F;
    }
    for (std::size_t i = 0; i < VIEWS; ++i)
    {
      const auto distance = static_cast<float>(i % 4 + 1);
      views[i].pixels = &pixels[i * VIEW_BYTES + PAD];
      views[i].channel_stride = PITCH;
      views[i].row_stride = CHANNELS * PITCH;
      views[i].pad_before = PAD;
      views[i].pad_after = PAD;
      views[i].position = i < VIEWS / 2 ? distance : -distance;
      (i / 4 % 2 == 0 ? views[i].step_x : views[i].step_y) = views[i].position;
    }
    tile.views = views.data();
    tile.spokes = spokes.data();
    tile.spoke_count = static_cast<int>(SPOKES);
    tile.width = WIDTH;
    tile.height = HEIGHT;
    tile.reference = reference.data();
    tile.reference_stride = STRIDE;
    tile.disparity = disparity.data();
    tile.first = TILE_PIXELS;
    tile.y = HEIGHT / 2;
    tile.weights = weights.data();
    tile.refocused = refocused.data();
    tile.refocused_stride = STRIDE;
    tile.moments = moments.data();
    tile.stride = STRIDE;
  }
};

Kernel linearization()
{
  const auto data = std::make_shared<LinearizeData>();
  const auto with = [&](auto kernel)
  { return calling(data, [kernel](LinearizeData& held) { kernel(held.tile); }); };
  constexpr double taps = 4.0;
  constexpr double bytes_per_view = taps * CHANNELS;
  constexpr double bytes_per_pixel = VIEWS * bytes_per_view + CHANNELS +
                                     sizeof(float) * (1.0 + CHANNELS + LinearizeData::SPOKES * SPOKE_MOMENTS);
  return {"linearize all views",         "pixel x view",      TILE_PIXELS * static_cast<double>(VIEWS),
          bytes_per_pixel * TILE_PIXELS, with(linearizeTile), with(linearizeTilePlain)};
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

Kernel evidence()
{
  struct Maps
  {
    std::vector<float> values = std::vector<float>(PIXELS, 0.1F);
    std::vector<float> against = std::vector<float>(PIXELS);
    EvidenceRow row;

    Maps()
    {
      for (const float** map :
           {&row.disparity, &row.searched, &row.first_search, &row.target, &row.weight, &row.disagreement,
            &row.residual, &row.low, &row.high, &row.wide_low, &row.wide_high})
      {
        *map = values.data();
      }
      row.width = WIDTH;
    }
  };
  const auto maps = std::make_shared<Maps>();
  const auto with = [&](auto kernel)
  { return calling(maps, [kernel](Maps& data) { kernel(data.row, data.against.data()); }); };
  constexpr double maps_per_pixel = 12.0;
  return {"evidence of the confidence",
          "pixel",
          PIXELS,
          PIXELS * maps_per_pixel * sizeof(float),
          with(weighEvidence),
          with(weighEvidencePlain)};
}

Kernel medians()
{
  struct Labels
  {
    std::vector<std::uint8_t> bytes = randomBytes(MEDIAN_SIZE * STRIDE, 26);
    std::vector<float> labels = std::vector<float>(bytes.begin(), bytes.end());
    std::vector<float> scratch = std::vector<float>(medianScratch(WIDTH));
    std::vector<float> medians = std::vector<float>(PIXELS);
    MedianRow row;

    Labels()
    {
      for (std::size_t i = 0; i < row.rows.size(); ++i)
      {
        row.rows[i] = &labels[i * STRIDE];
      }
      row.width = WIDTH;
      row.sorted_columns = scratch.data();
      row.medians = medians.data();
    }
  };
  const auto labels = std::make_shared<Labels>();
  const auto with = [&](auto kernel)
  { return calling(labels, [kernel](Labels& data) { kernel(data.row); }); };
  return {"median of 5 x 5",   "pixel", PIXELS, PIXELS * (MEDIAN_SIZE + 1.0) * sizeof(float), with(medianRow),
          with(medianRowPlain)};
}

/// A row of pixels whose labels change a few times in each tile.
struct SupportData
{
  std::vector<std::uint8_t> costs = randomBytes(3 * static_cast<std::size_t>(TILE_PX) * LABELS, 200);
  std::vector<std::int16_t> labels = std::vector<std::int16_t>(PIXELS);
  std::vector<std::int16_t> taken = labels;
  std::vector<int> counts = std::vector<int>(LABELS);
  SupportLine line;

  SupportData()
  {
    constexpr std::size_t run = 12;
    for (std::size_t x = 0; x < PIXELS; ++x)
    {
      labels[x] = static_cast<std::int16_t>(x / run % LABELS);
    }
    for (std::size_t i = 0; i < line.here.size(); ++i)
    {
      line.here[i] = {&costs[i * TILE_PX * LABELS], {0, LABELS}};
    }
    line.left = line.right = line.here;
    line.distance = 2;
  }
};

Kernel support()
{
  const auto data = std::make_shared<SupportData>();
  const auto with = [&](auto kernel)
  {
    return calling(data,
                   [kernel](SupportData& held)
                   {
                     held.taken = held.labels;
                     for (std::size_t x = 0; x < PIXELS; x += TILE_PX)
                     {
                       kernel(held.line, &held.taken[x], held.counts.data());
                     }
                   });
  };
  constexpr double costs_per_pixel = 27.0;
  return {"support of the labels",
          "pixel",
          PIXELS,
          PIXELS * (costs_per_pixel + sizeof(std::int16_t)),
          with(countSupported),
          with(countSupportedPlain)};
}

/// Rows of a system, two above each other that are not solved between those that are.
struct SmoothingData
{
  static constexpr std::size_t ROWS = 2 * ROWS_AT_ONCE + 1;
  std::vector<float> weight = std::vector<float>(ROWS * STRIDE, 20.0F);
  std::vector<float> target = std::vector<float>(ROWS * STRIDE, 1.0F);
  std::vector<float> left = std::vector<float>(ROWS * STRIDE, 30.0F);
  std::vector<float> up = std::vector<float>(ROWS * STRIDE, 40.0F);
  std::vector<float> values = std::vector<float>(ROWS * STRIDE, 1.5F);
  std::vector<float> scratch = std::vector<float>(rowScratch(WIDTH));
  std::array<SystemRow, ROWS_AT_ONCE> rows;
  ColumnStep step;

  SmoothingData()
  {
    for (std::size_t r = 0; r < rows.size(); ++r)
    {
      const std::size_t y = (2 * r + 1) * STRIDE;
      left[y] = left[y + PIXELS] = 0.0F;
      rows[r] = {&weight[y],          &target[y],          &left[y],  &up[y], &up[y + STRIDE],
                 &values[y - STRIDE], &values[y + STRIDE], &values[y]};
    }
    step.weight = weight.data();
    step.target = target.data();
    step.left = left.data();
    step.up = step.down = up.data();
    step.disparity = values.data();
    step.last = step.width = WIDTH;
    step.factor_above = step.value_above = values.data() + STRIDE;
    step.factor = scratch.data();
    step.value = scratch.data() + PIXELS;
  }
};

Kernel rowSolution()
{
  const auto data = std::make_shared<SmoothingData>();
  const auto with = [&](auto kernel)
  {
    return calling(data, [kernel](SmoothingData& held)
                   { kernel(held.rows.data(), ROWS_AT_ONCE, WIDTH, held.scratch.data()); });
  };
  constexpr double floats_per_pixel = 8.0;
  return {"rows solved",
          "pixel",
          PIXELS * static_cast<double>(ROWS_AT_ONCE),
          PIXELS * ROWS_AT_ONCE * floats_per_pixel * sizeof(float),
          with(solveRows),
          with(solveRowsPlain)};
}

Kernel columnElimination()
{
  const auto data = std::make_shared<SmoothingData>();
  const auto with = [&](auto kernel)
  { return calling(data, [kernel](SmoothingData& held) { kernel(held.step); }); };
  constexpr double floats_per_pixel = 10.0;
  return {"columns eliminated",
          "pixel",
          PIXELS,
          PIXELS * floats_per_pixel * sizeof(float),
          with(eliminateColumns),
          with(eliminateColumnsPlain)};
}

}  // namespace

std::vector<Kernel> kernels()
{
  return {interpolation(),  armCost(),       visibleCost(), transposition(), tilePaths(),
          labelSelection(), linearization(), warping(),     halving(),       pixelSplitting(),
          medians(),        evidence(),      support(),     rowSolution(),   columnElimination()};
}

}  // namespace light_field_depth::benchmark
