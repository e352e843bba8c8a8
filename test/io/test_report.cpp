#include "light_field_depth/io/report.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "light_field_depth/io/pipeline_options_io.h"

namespace light_field_depth
{
namespace
{
TEST(Report, HasAllThatIsToBeKnown)
{
  RunReport report;
  report.options.min_confidence = 0.1F;
  report.views_used = 17;
  report.size = {512, 384};
  report.disparity_range = {-1.5F, 2.0F};
  report.threads = 2;
  report.stage_times = {{"matching", 12.5}, {"fusion", 3.25}};
  report.decode_ms = 80.0;
  report.total_ms = 16.0;
  report.write_ms = 7.0;
  report.peak_memory_mb = peakMemoryMb();
  report.input = "a \"quoted\" \xFF name";
  report.photometric_error = std::numeric_limits<double>::quiet_NaN();
  const nlohmann::json json = nlohmann::json::parse(toJson(report));
  EXPECT_EQ(json["method"], toString(PipelineOptions().method));
  EXPECT_EQ(json["views_used"], 17);
  EXPECT_EQ(json["size"]["width"], 512);
  EXPECT_EQ(json["size"]["height"], 384);
  EXPECT_EQ(json["disparity_range"][0], -1.5);
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["timings_ms"]["decode"], 80.0);
  EXPECT_EQ(json["timings_ms"]["matching"], 12.5);
  EXPECT_EQ(json["timings_ms"]["total"], 16.0);
  EXPECT_EQ(json["timings_ms"]["write"], 7.0);
  EXPECT_GT(json["peak_memory_mb"], 1.0);
  EXPECT_EQ(json["options"]["min_confidence"], 0.1);
  EXPECT_EQ(json["options"].size(), listOptions(report.options).size());
  EXPECT_TRUE(json["calibration"].is_null());
  EXPECT_TRUE(json["photometric_error"].is_null());
}

}  // namespace
}  // namespace light_field_depth
