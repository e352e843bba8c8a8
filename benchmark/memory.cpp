#include "memory.h"

#include <malloc.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "layered_scene.h"
#include "light_field_depth/core/pipeline.h"
#include "light_field_depth/io/report.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr double BYTES_PER_MB = 1e6;
constexpr int FRAMES = 3;

struct Load
{
  Variant variant;
  int side_px = 512;
  int labels = 29;
};

/// From the smallest to the largest, so that no memory of an earlier one is left over.
const std::vector<Load>& loads()
{
  static const std::vector<Load> all = {{{"fast", {"multiview_preset=fast"}}, 512, 29},
                                        {{"realtime", {"multiview_preset=realtime"}}, 512, 29},
                                        {{"balanced", {}}, 512, 29},
                                        {{"quality", {"multiview_preset=quality"}}, 512, 29},
                                        {{"balanced", {}}, 1024, 29},
                                        {{"balanced", {}}, 1024, 100},
                                        {{"balanced", {}}, 2048, 100}};
  return all;
}

/// Forgets the peak so far.
void resetPeak()
{
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

double sizeMb(const LightField& light_field)
{
  double bytes = 0.0;
  for (const View& view : light_field.views)
  {
    bytes += static_cast<double>(view.image.total() * view.image.elemSize());
  }
  return bytes / BYTES_PER_MB;
}

double peakOf(const Load& load, const LightField& light_field, int threads)
{
  PipelineOptions options = optionsOf(load.variant);
  const float half_width =
      0.5F * static_cast<float>(load.labels - 1) * withPresetNumbers(options.multiview).label_step_px;
  options.disparity_range = DisparityRange{-half_width, half_width};
  resetPeak();
  Pipeline pipeline(threads);
  for (int frame = 0; frame < FRAMES; ++frame)
  {
    pipeline.run(light_field, options, {});
  }
  return peakMemoryMb();
}

}  // namespace

void measureMemory(const Settings& settings)
{
  Table table;
  table.header = {"preset", "pixels of a side", "labels", "light field, MB", "peak of the process, MB"};
  table.note = "17 views on a cross, " + std::to_string(settings.threads) + " threads, MB of 10^6 bytes.";
  nlohmann::json json = describeMachine(settings);
  for (const Load& load : loads())
  {
    const LightField light_field = LayeredScene({load.side_px, load.side_px}).views(crossOf(9));
    const double peak_mb = peakOf(load, light_field, settings.threads);
    table.rows.push_back({load.variant.name, std::to_string(load.side_px), std::to_string(load.labels),
                          fixed(sizeMb(light_field), 0), fixed(peak_mb, 0)});
    json["rows"].push_back({{"preset", load.variant.name},
                            {"side_px", load.side_px},
                            {"labels", load.labels},
                            {"light_field_mb", sizeMb(light_field)},
                            {"peak_mb", peak_mb}});
  }
  publish(settings, "memory", table, json);
}

}  // namespace light_field_depth::benchmark
