#include "pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "layered_scene.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/image_files.h"
#include "light_field_depth/io/pfm.h"
#include "opencv_baselines.h"
#include "scene.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr float UNKNOWN = std::numeric_limits<float>::quiet_NaN();

LightField pairOf(const cv::Mat& left, const cv::Mat& right)
{
  return makeLightField({gridView(0, 0, left), gridView(0, 1, right)}, GridPosition{0, 0});
}

/// Two views of a layered scene, far apart and shifted so that all of it lies before infinity: disparities of
/// 10 to 66 px.
Scene renderedPair()
{
  constexpr int width = 640;
  constexpr int height = 480;
  constexpr int shift_px = 38;
  // The scene's views stand four steps to a column here; the right one eight of those.
  const LayeredScene scene({width + shift_px, height}, 3);
  const LightField views = scene.views({{1, 3}, {1, 1}});
  const double steps = views.views[1 - views.reference_index].steps.x;
  const cv::Rect left_area(0, 0, width, height);
  const cv::Rect right_area(shift_px, 0, width, height);
  const cv::Mat right = views.views[1 - views.reference_index].image(right_area).clone();
  cv::Mat truth = scene.truth()(left_area) * steps;
  truth += static_cast<double>(shift_px);
  return {"rendered", pairOf(views.reference().image(left_area).clone(), right), truth};
}

Scene withNoise(const Scene& scene, double sigma)
{
  Scene noisy = scene;
  noisy.name += ", noise of " + fixed(sigma, 0);
  cv::RNG random(7);
  for (View& view : noisy.light_field.views)
  {
    cv::Mat noise(view.image.size(), CV_MAKETYPE(CV_32F, view.image.channels()));
    random.fill(noise, cv::RNG::NORMAL, 0.0, sigma);
    cv::Mat values;
    view.image.convertTo(values, CV_32F);
    values += noise;
    view.image = cv::Mat();
    values.convertTo(view.image, CV_8U);
  }
  return noisy;
}

/// The second view with another gain, tone curve and black level.
Scene withOtherExposure(const Scene& scene)
{
  constexpr double white = 255.0;
  constexpr double gain = 1.2;
  constexpr double gamma = 1.25;
  constexpr double offset = -4.0;
  cv::Mat levels(1, 256, CV_8UC1);
  for (int level = 0; level < levels.cols; ++level)
  {
    levels.at<std::uint8_t>(level) =
        cv::saturate_cast<std::uint8_t>(gain * white * std::pow(level / white, gamma) + offset);
  }
  Scene changed = scene;
  changed.name += ", other exposure";
  View& other = changed.light_field.views[1];
  cv::Mat image;
  cv::LUT(other.image, levels, image);
  other.image = image;
  return changed;
}

/// "LEFT,RIGHT,TRUTH[,LEVELS]": files; TRUTH a PFM, or an image with so many levels a pixel, where 0 and
/// infinity mean unknown.
Scene readPair(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
  {
    parts.push_back(part);
  }
  if (parts.size() < 3 || parts.size() > 4)
  {
    throw InputError("'" + text +
                     "' is no pair; give LEFT,RIGHT,TRUTH or LEFT,RIGHT,TRUTH,LEVELS_PER_PIXEL.");
  }
  const std::filesystem::path truth_file = parts[2];
  cv::Mat truth;
  if (truth_file.extension() == ".pfm")
  {
    truth = readPfm(truth_file);
  }
  else
  {
    const double levels = parts.size() == 4 ? std::stod(parts[3]) : 1.0;
    toGrey(readImage(truth_file)).convertTo(truth, CV_32F, 1.0 / levels);
  }
  for (int y = 0; y < truth.rows; ++y)
  {
    auto* const row = truth.ptr<float>(y);
    std::replace_if(
        row, row + truth.cols, [](float value) { return !(std::isfinite(value) && value > 0.0F); }, UNKNOWN);
  }
  return {truth_file.parent_path().filename().string(), pairOf(readImage(parts[0]), readImage(parts[1])),
          truth};
}

DisparityRange rangeOfKnown(const cv::Mat& truth)
{
  DisparityRange range = {std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
  for (int y = 0; y < truth.rows; ++y)
  {
    const auto* const row = truth.ptr<float>(y);
    for (int x = 0; x < truth.cols; ++x)
    {
      range.min = std::isnan(row[x]) ? range.min : std::min(range.min, row[x]);
      range.max = std::isnan(row[x]) ? range.max : std::max(range.max, row[x]);
    }
  }
  return range;
}

/// Percentage of the pixels with truth; no answer is bad.
double badPercentage(const cv::Mat& disparity, const cv::Mat& truth, float threshold_px)
{
  int known = 0;
  int good = 0;
  for (int y = 0; y < truth.rows; ++y)
  {
    for (int x = 0; x < truth.cols; ++x)
    {
      const float expected = truth.at<float>(y, x);
      known += std::isnan(expected) ? 0 : 1;
      good += std::abs(disparity.at<float>(y, x) - expected) <= threshold_px ? 1 : 0;
    }
  }
  return 100.0 * (known - good) / std::max(1, known);
}

/// Holes take the farther of the values at the ends of their run, as ours do.
cv::Mat withFilledHoles(const cv::Mat& disparity)
{
  cv::Mat filled = disparity.clone();
  for (int y = 0; y < filled.rows; ++y)
  {
    auto* const row = filled.ptr<float>(y);
    for (int x = 0; x < filled.cols; ++x)
    {
      if (!std::isnan(row[x]))
      {
        continue;
      }
      int end = x;
      while (end < filled.cols && std::isnan(row[end]))
      {
        ++end;
      }
      const float before = x > 0 ? row[x - 1] : UNKNOWN;
      const float after = end < filled.cols ? row[end] : UNKNOWN;
      std::fill(row + x, row + end, std::fmin(before, after));
      x = end;
    }
  }
  return filled;
}

std::vector<Contestant> contestants(const Scene& scene, int threads)
{
  std::vector<Contestant> all;
  for (const std::string preset : {"quality", "balanced", "realtime", "fast"})
  {
    all.push_back(
        makeContestant({preset, {"multiview_preset=" + preset}}, std::make_shared<Pipeline>(threads)));
  }
  const DisparityRange range = rangeOfKnown(scene.truth);
  all.push_back({"OpenCV SGBM", [range](const LightField& light_field) {
                   return Answer{semiGlobalWidestPair(light_field, range), {}};
                 }});
  all.push_back({"OpenCV SGBM, holes filled", [range](const LightField& light_field) {
                   return Answer{withFilledHoles(semiGlobalWidestPair(light_field, range)), {}};
                 }});
  return all;
}

void report(const Scene& scene, const Settings& settings, Table& table, nlohmann::json& rows)
{
  const std::vector<Contestant> methods = contestants(scene, settings.threads);
  std::vector<Answer> answers(methods.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < methods.size(); ++i)
  {
    tasks.emplace_back([&, i] { answers[i] = methods[i].run(scene.light_field); });
  }
  const std::vector<Timing> timings = timeInRounds(tasks, settings.runs);
  for (std::size_t i = 0; i < methods.size(); ++i)
  {
    const double bad4 = badPercentage(answers[i].disparity, scene.truth, 4.0F);
    const double bad1 = badPercentage(answers[i].disparity, scene.truth, 1.0F);
    table.rows.push_back({scene.name, methods[i].name, toText(timings[i]), fixed(bad4, 2), fixed(bad1, 2)});
    rows.push_back({{"pair", scene.name},
                    {"method", methods[i].name},
                    {"time", toJson(timings[i])},
                    {"bad_4px_percent", bad4},
                    {"bad_1px_percent", bad1}});
  }
}

}  // namespace

void comparePairs(const Settings& settings)
{
  const Scene rendered = renderedPair();
  std::vector<Scene> scenes = {rendered, withNoise(rendered, 5.0), withOtherExposure(rendered)};
  std::transform(settings.pairs.begin(), settings.pairs.end(), std::back_inserter(scenes), readPair);
  Table table;
  table.header = {"pair", "method", "time, median (min..max) ms", "off by > 4 px, %", "off by > 1 px, %"};
  table.note =
      "Of all pixels with truth, hidden ones among them; where a method has no answer it is off. OpenCV is "
      "told the true range, the others find it.";
  nlohmann::json json = describeMachine(settings);
  for (const Scene& scene : scenes)
  {
    report(scene, settings, table, json["rows"]);
  }
  publish(settings, "pairs", table, json);
}

}  // namespace light_field_depth::benchmark
