// Scores a disparity map against ground truth with the metrics of the HCI 4D Light Field Benchmark.

#include <iostream>
#include <string>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "light_field_depth/io/evaluation.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "tool_main.h"

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

}  // namespace

int main(int argc, char** argv)
{
  std::string result;
  std::string truth;
  std::string mask;
  int border_px = lfd::DEFAULT_EVALUATION_BORDER_PX;
  bool json = false;
  CLI::App app(
      "Scores a disparity map against ground truth: mean square error x 100, percentages of bad pixels, "
      "25th percentile of the error x 100, part of the pixels that have a value.",
      "evaluate");
  app.add_option("--result", result, "disparity map to score (PFM)")->required();
  app.add_option("--truth", truth, "true disparity map (PFM)")->required();
  app.add_option("--mask", mask, "image in the size of the truth; only pixels that are not black count");
  app.add_option("--border", border_px,
                 "pixels left out along each side of the truth (default " + std::to_string(border_px) + ")");
  app.add_flag("--json", json, "print a JSON object");
  return lfd::runTool(app, argc, argv,
                      [&]
                      {
                        const lfd::Evaluation evaluation =
                            lfd::evaluate(lfd::readPfm(result), lfd::readPfm(truth),
                                          mask.empty() ? cv::Mat() : readMask(mask), border_px);
                        std::cout << (json ? toJson(evaluation) : toText(evaluation)) << std::endl;
                      });
}
