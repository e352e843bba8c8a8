#include "tools/estimate_input.h"

#include <cstddef>

#include "light_field_depth/core/error.h"
#include "tools/stopwatch.h"

namespace light_field_depth
{
EstimateInput readInput(const std::string& folder, DatasetOptions options, const PipelineOptions& settings,
                        bool all_views)
{
  const Stopwatch watch;
  options.selection = [&](const LightField& without_images)
  { return all_views ? ViewSelection::All : viewsToRead(without_images, settings); };
  EstimateInput input;
  input.dataset = readDataset(folder, options);
  input.decode_ms = watch.milliseconds();
  return input;
}

std::vector<std::string> wantedFrames(const std::string& text, const std::vector<std::string>& names)
{
  if (names.empty())
  {
    throw InputError("--frames is given, but the input is a single light field.");
  }
  if (text == "all")
  {
    return names;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
  {
    throw InputError("--frames is '" + text + "'; give FIRST:LAST, as in 0:99, or all.");
  }
  const std::size_t first = frameIndex(names, text.substr(0, colon));
  const std::size_t last = frameIndex(names, text.substr(colon + 1));
  if (first > last)
  {
    throw InputError("--frames is '" + text + "', but '" + names[first] + "' comes after '" + names[last] +
                     "'; give the first frame first.");
  }
  return {names.begin() + static_cast<std::ptrdiff_t>(first),
          names.begin() + static_cast<std::ptrdiff_t>(last) + 1};
}

void describeInput(const std::string& input, const Dataset& dataset, RunReport& report)
{
  const LightField& light_field = dataset.light_field;
  report.input = input;
  report.format = dataset.format;
  report.order = toString(dataset.order);
  report.flip = toString(dataset.flip);
  report.layout_source = toString(dataset.layout_source);
  report.notes = dataset.notes;
  report.views_found = dataset.views_found;
  report.reference = light_field.reference().grid;
  report.reference_file = dataset.files[light_field.reference_index].filename().string();
  report.size = light_field.size();
  report.calibration = light_field.calibration;
}

}  // namespace light_field_depth
