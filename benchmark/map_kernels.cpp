#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/multiview/maps/confidence_kernels.h"
#include "core/multiview/refine/linearize_kernels.h"
#include "core/multiview/refine/smoothing_kernels.h"
#include "core/multiview/search/background_kernels.h"
#include "core/multiview/search/median_kernels.h"
#include "kernel_data.h"
#include "kernels.h"

namespace light_field_depth::benchmark
{
namespace
{
using namespace multiview;

/// One tile of a row, with views on a cross.
struct LinearizeData
{
  static constexpr int HEIGHT = 32;
  static constexpr std::size_t PAD = VECTOR_ROOM;
  static constexpr std::size_t PITCH = PIXELS + 2 * PAD;
  static constexpr std::size_t VIEW_BYTES = HEIGHT * CHANNELS * PITCH;
  static constexpr std::size_t RAYS = 4;

  std::vector<std::uint8_t> pixels = randomBytes(VIEWS * VIEW_BYTES, 60);
  std::vector<std::uint8_t> reference = randomBytes(CHANNELS * STRIDE, 60);
  std::vector<float> disparity = std::vector<float>(STRIDE);
  std::vector<float> weights = std::vector<float>(RAYS * TILE_PIXELS);
  std::vector<float> refocused = std::vector<float>(CHANNELS * STRIDE);
  std::vector<float> moments = std::vector<float>(RAYS * RAY_MOMENTS * STRIDE);
  std::array<SampledView, VIEWS> views{};
  std::array<ViewRay, RAYS> rays = {{{0, 4}, {4, 8}, {8, 12}, {12, 16}}};
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
    tile.rays = rays.data();
    tile.ray_count = static_cast<int>(RAYS);
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
                                     sizeof(float) * (1.0 + CHANNELS + LinearizeData::RAYS * RAY_MOMENTS);
  return {"linearize all views",         "pixel x view",      TILE_PIXELS * static_cast<double>(VIEWS),
          bytes_per_pixel * TILE_PIXELS, with(linearizeTile), with(linearizeTilePlain)};
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

std::vector<Kernel> mapKernels()
{
  return {linearization(), medians(), evidence(), support(), rowSolution(), columnElimination()};
}

}  // namespace light_field_depth::benchmark
