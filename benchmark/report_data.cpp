// What `./run report` shows besides the results of estimate: the views on the reference's row and column as
// images, where they stand, and the disparity that OpenCV alone gives.

#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>

#include "light_field_depth/io/dataset.h"
#include "light_field_depth/io/files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "opencv_baselines.h"
#include "timing.h"
#include "tools/tool_main.h"

namespace light_field_depth::benchmark
{
namespace
{
namespace fs = std::filesystem;

struct Arguments
{
  std::string input;
  std::string output;
  DisparityRange range;
};

/// Images view_NUMBER.png, and of each its place.
nlohmann::json writeViews(const LightField& cross, const fs::path& folder)
{
  nlohmann::json views = nlohmann::json::array();
  for (std::size_t i = 0; i < cross.views.size(); ++i)
  {
    const View& view = cross.views[i];
    const std::string name = "view_" + std::to_string(i) + ".png";
    writeImage(folder / name, view.image);
    views.push_back({{"file", name},
                     {"row", view.grid.row},
                     {"column", view.grid.column},
                     {"steps", {view.steps.x, view.steps.y}},
                     {"offset_px", {view.offset_px.x, view.offset_px.y}}});
  }
  return views;
}

/// Writes NAME.pfm. @return its time in milliseconds, or why there is none
nlohmann::json solve(const fs::path& file, const std::function<cv::Mat()>& method)
{
  try
  {
    cv::Mat disparity;
    const double milliseconds = millisecondsOf([&] { disparity = method(); });
    writePfm(file, disparity);
    return {{"file", file.filename().string()}, {"ms", milliseconds}};
  }
  catch (const std::exception& error)
  {
    return {{"left_out", error.what()}};
  }
}

void writeReportData(const Arguments& arguments)
{
  const Dataset dataset = readDataset(arguments.input);
  const LightField cross = toEightBit(selectViews(dataset.light_field, ViewSelection::Cross));
  const fs::path folder = arguments.output;
  makeFolder(folder);
  nlohmann::json data;
  data["views"] = writeViews(cross, folder);
  data["reference"] = cross.reference_index;
  data["opencv"]["OpenCV DIS, median"] = solve(folder / "opencv_dis.pfm", [&] { return disMedian(cross); });
  data["opencv"]["OpenCV SGBM, widest pair"] =
      solve(folder / "opencv_sgbm.pfm", [&] { return semiGlobalWidestPair(cross, arguments.range); });
  writeFile(folder / "report_data.json", data.dump());
}

}  // namespace
}  // namespace light_field_depth::benchmark

int main(int argc, char** argv)
{
  using namespace light_field_depth;
  CLI::App app("Views and OpenCV's maps of a light field, for the page of ./run report.", "report_data");
  benchmark::Arguments arguments;
  app.add_option("--input", arguments.input, "folder of the light field")->required();
  app.add_option("--output", arguments.output, "folder of the results")->required();
  app.add_option("--range-min", arguments.range.min, "lowest disparity, pixels per step")->required();
  app.add_option("--range-max", arguments.range.max, "highest disparity")->required();
  return runTool(app, argc, argv, [&] { benchmark::writeReportData(arguments); });
}
