#include "tools/estimate_arguments.h"

#include <limits>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/pipeline_options_io.h"
#include "tools/number_checks.h"

namespace light_field_depth
{
namespace
{
constexpr int MAX_THREADS = 1024;  // as the node has it

}  // namespace

void declare(CLI::App& app, EstimateArguments& arguments)
{
  app.add_option("--input", arguments.input, "folder with the views of a light field")->required();
  app.add_option("--output", arguments.output, "folder for the results; created if need be")->required();
  app.add_option("--method", arguments.method, "method: " + methodNames().front() + " by default");
  app.add_option(
      "--preset", arguments.preset,
      "of multiview: quality, balanced, realtime or fast; the same as --set multiview_preset=NAME");
  app.add_option("--temporal", arguments.temporal,
                 "of multiview, for video: true or false; the same as --set multiview_temporal=VALUE");
  app.add_option("--views", arguments.views,
                 "views to use: auto (the method's own choice), row, column, cross, star or all");
  app.add_option("--reference", arguments.reference,
                 "ROW,COL of the reference view, numbered as in the files")
      ->delimiter(',')
      ->expected(2);
  app.add_option("--range,--disparity-range", arguments.disparity_range,
                 "MIN,MAX in pixels between adjacent views; found from the images by default")
      ->delimiter(',')
      ->expected(2);
  app.add_flag("--stated-range", arguments.stated_range,
               "search the range that the dataset's description states")
      ->excludes("--range");
  app.add_option("--order", arguments.order,
                 "auto, row-major or column-major: which of a view's two numbers is the row")
      ->default_val("auto");
  app.add_option("--flip", arguments.flip,
                 "auto, none, rows, columns or both: what is numbered against the convention (rows down, "
                 "columns right)")
      ->default_val("auto");
  app.add_option("--grid", arguments.grid, "ROWSxCOLUMNS of views that are named by one number");
  app.add_option("--tiles", arguments.tiles, "ROWSxCOLUMNS of the views in one image");
  app.add_option("--frame", arguments.frame,
                 "number or folder of the frame of a sequence; the first by default");
  app.add_option(
         "--frames", arguments.frames,
         "FIRST:LAST frames of a sequence, or all; each has its results in a folder of its name, and helps "
         "the next one")
      ->excludes("--frame");
  app.add_flag(
      "--mask-black", arguments.mask_black,
      "what is black up to the border of a view (unfilled by rectification, beyond a lens) shows nothing");
  app.add_flag("--dense", arguments.dense, "also write the extra dense cloud of all views");
  app.add_flag("--view-maps", arguments.view_maps,
               "also write the map of every view to OUTPUT/view_maps: disparity, confidence, and what each "
               "pixel comes "
               "from (255 seen by the reference view, 128 solved in others, 0 filled)");
  app.add_option("--threads", arguments.threads, "threads to work with; 0 takes one per processor")
      ->check(CLI::Range(0, MAX_THREADS));
  app.add_option(
         "--max-memory", arguments.max_memory_mb,
         "MB that a run may need; more is refused before the views are read; what the machine has by default")
      ->check(POSITIVE);
  app.add_option("--max-views", arguments.limits.views, "views that a run may read; more are refused")
      ->check(CLI::Range(2, std::numeric_limits<int>::max()))
      ->capture_default_str();
  app.add_option("--max-megapixels", arguments.limits.megapixels,
                 "millions of pixels that an image may have; a larger one is refused before it is decoded")
      ->check(POSITIVE)
      ->capture_default_str();
  app.add_flag("--save-intermediate", arguments.save_intermediate,
               "also write the results of the single stages to OUTPUT/intermediate");
  declareOutput(app, arguments.output_files);
  app.add_option("--focal-length", arguments.camera.focal_length_px, "pixels, for depth in metres")
      ->check(POSITIVE);
  app.add_option("--baseline", arguments.baseline_m,
                 "metres between adjacent views, or X,Y: between columns and between rows")
      ->delimiter(',')
      ->expected(1, 2)
      ->check(POSITIVE);
  app.add_option("--principal-point", arguments.principal_point_px,
                 "X,Y in pixels; the image's middle by default")
      ->delimiter(',')
      ->expected(2)
      ->check(FINITE);
  app.add_option("--focus-distance", arguments.camera.focus_distance_m,
                 "metres to the plane of zero disparity; parallel cameras by default")
      ->check(POSITIVE);
  app.add_flag(
      "--strict", arguments.strict,
      "exit with 3 if the verdict on the result has a warning; the results are written all the same");
  app.add_option("--config", arguments.config, "YAML file of settings, as under 'options' in report.json");
  app.add_option("--set", arguments.settings, "NAME=VALUE of one setting; may be repeated");
}

PipelineOptions makeOptions(const EstimateArguments& arguments)
{
  PipelineOptions options;
  options.keep_filled = true;  // maps in files are dense
  options.dense_cloud.maps = DenseCloudOptions::MAPS_WITH_TIME;
  if (!arguments.config.empty())
  {
    readOptionsFile(arguments.config, options);
  }
  for (const std::string& setting : arguments.settings)
  {
    setOption(options, setting);
  }
  if (!arguments.method.empty())
  {
    options.method = methodFromString(arguments.method);
  }
  const auto set_of_multiview = [&](const char* name, const std::string& value)
  {
    if (value.empty())
    {
      return;
    }
    if (options.method != Method::Multiview)
    {
      throw InputError("--" + std::string(name) + " belongs to the method multiview, but the method is " +
                       toString(options.method) + "; leave one of them out.");
    }
    setOption(options, "multiview_" + std::string(name), value);
  };
  set_of_multiview("preset", arguments.preset);
  set_of_multiview("temporal", arguments.temporal);
  if (!arguments.views.empty())
  {
    options.views = viewSelectionFromString(arguments.views);
  }
  if (!arguments.disparity_range.empty())
  {
    options.disparity_range = DisparityRange{arguments.disparity_range[0], arguments.disparity_range[1]};
  }
  const std::vector<std::string> problems = validate(options);
  if (!problems.empty())
  {
    throw InputError(problems.front());
  }
  return options;
}

DatasetOptions makeDatasetOptions(const EstimateArguments& arguments)
{
  DatasetOptions options;
  options.threads = arguments.threads;
  options.mask_black = arguments.mask_black;
  options.max_megapixels = arguments.limits.megapixels;
  if (!arguments.reference.empty())
  {
    options.reference = GridPosition{arguments.reference[0], arguments.reference[1]};
  }
  options.camera = arguments.camera;
  if (!arguments.baseline_m.empty())
  {
    options.camera.baseline_m = cv::Point2d(arguments.baseline_m.front(), arguments.baseline_m.back());
  }
  if (!arguments.principal_point_px.empty())
  {
    options.camera.principal_point_px =
        cv::Point2d(arguments.principal_point_px[0], arguments.principal_point_px[1]);
  }
  options.order = orderOption(arguments.order);
  options.flip = flipOption(arguments.flip);
  if (!arguments.grid.empty())
  {
    options.grid = gridFromString("--grid", arguments.grid);
  }
  if (!arguments.tiles.empty())
  {
    options.tiles = gridFromString("--tiles", arguments.tiles);
  }
  if (!arguments.frame.empty())
  {
    options.frame = arguments.frame;
  }
  return options;
}

}  // namespace light_field_depth
