#include "light_field_depth/core/multiview/cost_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "light_field_depth/core/multiview/cost_kernels.h"

namespace light_field_depth::multiview
{
namespace
{
constexpr int LABEL_MULTIPLE = 16;
constexpr int PIXEL_MULTIPLE = 64;
constexpr int ROWS_PER_CHUNK = 64;

int roundUp(int value, int multiple)
{
  return (value + multiple - 1) / multiple * multiple;
}

/// Half of the arms, as a number that the kernel can average.
int bestArms(std::size_t arms)
{
  constexpr std::size_t few = 2;
  constexpr std::size_t many = 7;
  if (arms <= few)
  {
    return 1;
  }
  return arms < many ? 2 : 4;
}

std::vector<std::uint16_t> armScales(const ViewSet& views, int truncation)
{
  constexpr double fixed_point = 256.0;
  std::vector<std::uint16_t> scales;
  for (const Arm& arm : views.arms)
  {
    const double full = static_cast<double>(truncation) * (arm.last - arm.first);
    scales.push_back(static_cast<std::uint16_t>(std::lround(FULL_COST * fixed_point / full)));
  }
  return scales;
}

}  // namespace

void CostVolume::create(int new_width, int new_height, int new_labels)
{
  width = new_width;
  height = new_height;
  labels = new_labels;
  pitch = roundUp(labels, LABEL_MULTIPLE);
  padded_width = roundUp(width, PIXEL_MULTIPLE);
  values.resize(rowOffset(height));
}

/// Memory of one chunk of rows at work.
struct CostVolumeBuilder::Scratch
{
  std::vector<SampleRows> samples;            // one a view
  std::vector<const std::uint8_t*> pointers;  // one a view, for one label
  std::vector<const std::uint8_t*> surfaces;
  std::vector<std::uint8_t> cost;  // [label][x] of one row
};

CostVolumeBuilder::CostVolumeBuilder() = default;
CostVolumeBuilder::~CostVolumeBuilder() = default;

std::unique_ptr<CostVolumeBuilder::Scratch> CostVolumeBuilder::takeScratch()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_scratch_.empty())
  {
    return std::make_unique<Scratch>();
  }
  auto scratch = std::move(free_scratch_.back());
  free_scratch_.pop_back();
  return scratch;
}

void CostVolumeBuilder::giveBack(std::unique_ptr<Scratch> scratch)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  free_scratch_.push_back(std::move(scratch));
}

void CostVolumeBuilder::buildFromArms(const ViewSet& views, const LabelSpace& labels,
                                      const CostSettings& settings, ThreadPool& pool, CostVolume& volume)
{
  build(views, labels, nullptr, settings, pool, volume);
}

void CostVolumeBuilder::buildFromVisible(const ViewSet& views, const LabelSpace& labels,
                                         const VisibleSurfaces& surfaces, const CostSettings& settings,
                                         ThreadPool& pool, CostVolume& volume)
{
  build(views, labels, &surfaces, settings, pool, volume);
}

/// The rows of one chunk.
struct CostVolumeBuilder::RowJob
{
  const ViewSet& views;
  const LabelSpace& labels;
  const VisibleSurfaces* surfaces;
  const CostSettings& settings;
  const std::vector<std::uint16_t>& arm_scales;
  Scratch& scratch;
  CostVolume& volume;

  void begin() const
  {
    const auto count = views.views.size();
    scratch.samples.resize(count);
    scratch.pointers.resize(count);
    scratch.surfaces.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      scratch.samples[i].reset(views.views[i], labels);
    }
    scratch.cost.assign(
        static_cast<std::size_t>(volume.pitch) * static_cast<std::size_t>(volume.padded_width), PADDING_COST);
  }

  void run(int y) const
  {
    const auto stride = static_cast<std::size_t>(volume.padded_width);
    for (int label = 0; label < labels.count; ++label)
    {
      for (std::size_t i = 0; i < scratch.samples.size(); ++i)
      {
        scratch.pointers[i] = scratch.samples[i].row(label, y);
      }
      std::uint8_t* const cost = scratch.cost.data() + static_cast<std::size_t>(label) * stride;
      if (surfaces == nullptr)
      {
        armCost(y, cost);
      }
      else
      {
        visibleCost(label, y, cost);
      }
    }
    transposeCosts(scratch.cost.data(), stride, volume.pitch, volume.padded_width,
                   volume.values.data() + volume.rowOffset(y));
  }

  void armCost(int y, std::uint8_t* cost) const
  {
    ArmCostRow row;
    row.reference = views.reference.row(y);
    row.reference_stride = views.reference.channelStride();
    row.samples = scratch.pointers.data();
    row.sample_stride = scratch.samples.front().channelStride();
    row.channels = views.reference.channels();
    row.width = views.width();
    row.truncation = settings.truncation;
    row.arms = views.arms.data();
    row.arm_count = static_cast<int>(views.arms.size());
    row.best_arms = bestArms(views.arms.size());
    row.arm_scales = arm_scales.data();
    armCostRow(row, cost);
  }

  void visibleCost(int label, int y, std::uint8_t* cost) const
  {
    for (std::size_t i = 0; i < scratch.samples.size(); ++i)
    {
      const PreparedView& view = views.views[i];
      const double disparity = labels.disparity(static_cast<float>(label));
      const auto dx = static_cast<int>(std::floor(view.offset_px.x - disparity * view.steps.x + 0.5));
      const auto dy = static_cast<int>(std::floor(view.offset_px.y - disparity * view.steps.y + 0.5));
      scratch.surfaces[i] = surfaces->row(static_cast<int>(i), y + dy) + dx;
    }
    VisibleCostRow row;
    row.reference = views.reference.row(y);
    row.reference_stride = views.reference.channelStride();
    row.samples = scratch.pointers.data();
    row.sample_stride = scratch.samples.front().channelStride();
    row.surfaces = scratch.surfaces.data();
    row.views = static_cast<int>(scratch.samples.size());
    row.channels = views.reference.channels();
    row.width = views.width();
    row.truncation = settings.truncation;
    row.hidden_above = std::min(label + 1 + settings.hidden_margin, OUT_OF_FRAME - 1);
    row.min_seeing_views = settings.min_seeing_views;
    row.unseen_penalty = settings.unseen_penalty;
    visibleCostRow(row, cost);
  }
};

void CostVolumeBuilder::build(const ViewSet& views, const LabelSpace& labels, const VisibleSurfaces* surfaces,
                              const CostSettings& settings, ThreadPool& pool, CostVolume& volume)
{
  volume.create(views.width(), views.height(), labels.count);
  const auto scales = armScales(views, settings.truncation);
  pool.parallelFor(0, volume.height, ROWS_PER_CHUNK,
                   [&](int first, int last)
                   {
                     auto scratch = takeScratch();
                     const RowJob job{views, labels, surfaces, settings, scales, *scratch, volume};
                     job.begin();
                     for (int y = first; y < last; ++y)
                     {
                       job.run(y);
                     }
                     giveBack(std::move(scratch));
                   });
}

}  // namespace light_field_depth::multiview
