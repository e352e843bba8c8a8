#include "light_field_depth/io/report.h"

#include <cmath>
#include <fstream>
#include <variant>

#include <nlohmann/json.hpp>

#include "light_field_depth/io/pipeline_options_io.h"

namespace light_field_depth
{
namespace
{
using Json = nlohmann::json;

constexpr double BYTES_PER_KIB = 1024.0;
constexpr double BYTES_PER_MB = 1e6;

/// Times are read by people.
double rounded(double value)
{
  return std::round(value * 1000.0) / 1000.0;
}

Json optionsJson(const PipelineOptions& options)
{
  Json json;
  for (const NamedOption& option : listOptions(options))
  {
    std::visit([&](const auto& value) { json[option.name] = value; }, option.value);
  }
  return json;
}

Json timingsJson(const RunReport& report)
{
  Json json;
  json["decode"] = rounded(report.decode_ms);
  for (const StageTime& time : report.stage_times)
  {
    json[time.stage] = rounded(time.milliseconds);
  }
  json["total"] = rounded(report.total_ms);
  json["write"] = rounded(report.write_ms);
  return json;
}

Json calibrationJson(const Calibration& calibration)
{
  return {{"focal_length_px", calibration.focal_length_px},
          {"principal_point_px", {calibration.principal_point_px.x, calibration.principal_point_px.y}},
          {"baseline_m", calibration.baseline_m},
          {"disparity_offset_px", calibration.disparity_offset_px}};
}

Json verdictJson(const Verdict& verdict)
{
  Json json;
  json["doubtful"] = verdict.isDoubtful();
  json["findings"] = Json::array();
  for (const Finding& finding : verdict.findings)
  {
    json["findings"].push_back({{"name", finding.name},
                                {"severity", toString(finding.severity)},
                                {"value", rounded(finding.value)},
                                {"sentence", finding.sentence}});
  }
  return json;
}

template <class Value>
Json orNull(const std::optional<Value>& value)
{
  return value ? Json(*value) : Json();
}

}  // namespace

std::string toString(RangeSource source)
{
  switch (source)
  {
    case RangeSource::Given:
      return "given";
    case RangeSource::Dataset:
      return "dataset";
    case RangeSource::Found:
      break;
  }
  return "found";
}

std::string toJson(const RunReport& report)
{
  Json json;
  json["method"] = toString(report.options.method);
  json["options"] = optionsJson(report.options);
  json["input"] = report.input;
  json["format"] = report.format;
  json["order"] = report.order;
  json["flip"] = report.flip;
  json["layout_source"] = report.layout_source;
  json["notes"] = report.notes;
  json["views_found"] = report.views_found;
  json["views_used"] = report.views_used;
  json["reference"] = {
      {"row", report.reference.row}, {"column", report.reference.column}, {"file", report.reference_file}};
  json["size"] = {{"width", report.size.width}, {"height", report.size.height}};
  json["calibration"] = report.calibration ? calibrationJson(*report.calibration) : Json();
  json["disparity_range"] = {rounded(report.disparity_range.min), rounded(report.disparity_range.max)};
  json["disparity_range_source"] = toString(report.range_source);
  json["threads"] = report.threads;
  json["timings_ms"] = timingsJson(report);
  json["peak_memory_mb"] = rounded(report.peak_memory_mb);
  json["photometric_error"] = orNull(report.photometric_error);
  json["photometric_error_of_medians"] = orNull(report.photometric_error_of_medians);
  if (report.disparity_png16)
  {
    json["disparity_png16"] = {{"scale", report.disparity_png16->scale},
                               {"offset", report.disparity_png16->offset}};
  }
  json["verdict"] = verdictJson(report.verdict);
  json["files"] = report.files;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double peakMemoryMb()
{
  std::ifstream status("/proc/self/status");
  std::string field;
  while (status >> field)
  {
    if (field == "VmHWM:")
    {
      double kib = 0.0;
      status >> kib;
      return kib * BYTES_PER_KIB / BYTES_PER_MB;
    }
  }
  return 0.0;
}

}  // namespace light_field_depth
