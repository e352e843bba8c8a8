// Scores a disparity map against ground truth with the metrics of the HCI 4D Light Field Benchmark.

#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "light_field_depth/evaluation/cloud_score.h"
#include "light_field_depth/evaluation/evaluation.h"
#include "light_field_depth/evaluation/sparsification.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "tools/cloud_truth.h"
#include "tools/tool_main.h"

namespace
{
namespace lfd = light_field_depth;

/// A pixel counts where any channel of the mask is not 0.
cv::Mat readMask(const std::string& path)
{
  cv::Mat mask = lfd::readImage(path);
  if (mask.channels() == 3)
  {
    std::vector<cv::Mat> channels;
    cv::split(mask, channels);
    mask = cv::max(cv::max(channels[0], channels[1]), channels[2]);
  }
  return mask != 0;
}

/// The command line as it was typed.
struct Arguments
{
  std::string result;
  std::string cloud;
  std::string truth;
  std::string confidence;
  std::string mask;
  int border_px = lfd::DEFAULT_EVALUATION_BORDER_PX;
  bool json = false;
};

void evaluateCloud(const Arguments& arguments)
{
  lfd::ThreadPool pool(0);
  const lfd::CloudScore score =
      lfd::scoreCloud(lfd::readPlyPositions(arguments.cloud), lfd::readCloudTruth(arguments.truth), pool);
  std::cout << (arguments.json ? toJson(score) : toText(score)) << std::endl;
}

void evaluate(const Arguments& arguments)
{
  if (!arguments.cloud.empty())
  {
    evaluateCloud(arguments);
    return;
  }
  const cv::Mat result = lfd::readPfm(arguments.result);
  const cv::Mat truth = lfd::readPfm(arguments.truth);
  if (result.size() != truth.size())
  {
    std::cerr << "Note: the result has " << result.cols << " x " << result.rows << " pixels, the truth "
              << truth.cols << " x " << truth.rows << "; it is taken as the middle of the truth.\n";
  }
  const cv::Mat mask = arguments.mask.empty() ? cv::Mat() : readMask(arguments.mask);
  const lfd::Evaluation evaluation = lfd::evaluate(result, truth, mask, arguments.border_px);
  std::string line = arguments.json ? toJson(evaluation) : toText(evaluation);
  if (!arguments.confidence.empty())
  {
    const lfd::Sparsification sparsification =
        lfd::sparsify(result, lfd::readPfm(arguments.confidence), truth, mask, arguments.border_px);
    if (arguments.json)
    {
      auto figures = nlohmann::json::parse(line);
      figures["sparsification"] = nlohmann::json::parse(toJson(sparsification));
      line = figures.dump();
    }
    else
    {
      line += "  " + toText(sparsification);
    }
  }
  std::cout << line << std::endl;
}

}  // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  CLI::App app(
      "Scores a disparity map against ground truth: mean square error x 100, percentages of bad pixels, "
      "25th percentile of the error x 100, part of the pixels that have a value. Or a cloud: accuracy and "
      "completeness within 0.25, 1 and 2 % of depth, points that hang between surfaces.",
      "evaluate");
  auto* const scored = app.add_option_group("scored", "what is scored");
  scored->add_option("--result", arguments.result, "disparity map to score (PFM)");
  scored->add_option("--cloud", arguments.cloud, "cloud to score (binary PLY in the optical frame)");
  scored->require_option(1);
  app.add_option(
         "--truth", arguments.truth,
         "true disparity map (PFM); for a cloud the folder of the light field, with truth and calibration")
      ->required();
  app.add_option("--confidence", arguments.confidence,
                 "confidence map of the result (PFM): also how the error falls as the least confident pixels "
                 "are dropped, as the area above the ideal curve (AUSE, parts of the whole error) and as the "
                 "error without the least confident tenth");
  app.add_option("--mask", arguments.mask,
                 "image in the size of the truth; only pixels that are not black count");
  app.add_option(
      "--border", arguments.border_px,
      "pixels left out along each side of the truth (default " + std::to_string(arguments.border_px) + ")");
  app.add_flag("--json", arguments.json, "print a JSON object");
  return lfd::runTool(app, argc, argv, [&] { evaluate(arguments); });
}
