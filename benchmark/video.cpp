#include "video.h"

#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "contestant.h"
#include "layered_scene.h"
#include "light_field_depth/core/pipeline.h"
#include "timing.h"

namespace light_field_depth::benchmark
{
namespace
{
constexpr int SIDE_PX = 512;
constexpr int FRAMES = 50;
constexpr int FRAMES_AFTER_CUT = 5;
/// The frames at the end of the scene whose accuracy is compared.
constexpr int SCORED_FRAMES = 10;

const std::vector<Variant>& variants()
{
  static const std::vector<Variant> all = {
      {"balanced", {}},
      {"balanced, temporal", {"multiview_temporal=true"}},
      {"realtime", {"multiview_preset=realtime"}},
      {"realtime, temporal", {"multiview_preset=realtime", "multiview_temporal=true"}},
      {"fast", {"multiview_preset=fast"}},
      {"fast, temporal", {"multiview_preset=fast", "multiview_temporal=true"}},
  };
  return all;
}

/// What one variant did with the frames so far.
struct Run
{
  Contestant contestant;
  Timing timing;
  std::vector<Evaluation> evaluations;

  void show(const LightField& frame, const cv::Mat& truth)
  {
    Answer answer;
    timing.milliseconds.push_back(millisecondsOf([&] { answer = contestant.run(frame); }));
    evaluations.push_back(evaluate(answer.disparity, truth));
  }

  /// Of the frames after the first, up to the cut.
  Timing steadyTiming() const
  {
    return {{timing.milliseconds.begin() + 1, timing.milliseconds.begin() + FRAMES}};
  }
};

/// Means over some frames: "0.274 / 1.20".
std::string accuracyText(const std::vector<Evaluation>& evaluations, int first, int last)
{
  double mse_100 = 0.0;
  double badpix_007 = 0.0;
  for (int i = first; i < last; ++i)
  {
    mse_100 += evaluations[static_cast<std::size_t>(i)].mse_100 / (last - first);
    badpix_007 += evaluations[static_cast<std::size_t>(i)].badpix_007 / (last - first);
  }
  return fixed(mse_100, 3) + " / " + fixed(badpix_007, 2);
}

std::vector<Run> runsOfAllVariants(const Settings& settings)
{
  std::vector<Run> runs;
  runs.reserve(variants().size());
  for (const Variant& variant : variants())
  {
    runs.push_back({makeContestant(variant, std::make_shared<Pipeline>(settings.threads)), {}, {}});
  }
  return runs;
}

void showAll(const LayeredScene& scene, int frames, std::vector<Run>& runs)
{
  const std::vector<GridPosition> positions = crossOf(9);
  for (int i = 0; i < frames; ++i)
  {
    const LightField frame = scene.views(positions, i);
    const cv::Mat truth = scene.truth(i);
    for (Run& run : runs)
    {
      run.show(frame, truth);
    }
  }
}

}  // namespace

void measureVideo(const Settings& settings)
{
  std::vector<Run> runs = runsOfAllVariants(settings);
  const cv::Size size(SIDE_PX, SIDE_PX);
  showAll(LayeredScene(size, 1), FRAMES, runs);
  showAll(LayeredScene(size, 2), FRAMES_AFTER_CUT, runs);

  Table table;
  table.header = {"preset", "time, median (min..max) ms",
                  "MSE x 100 / BadPix 0.07 %, last " + std::to_string(SCORED_FRAMES) + " of " +
                      std::to_string(FRAMES) + " frames",
                  "first frame after a cut", "second"};
  nlohmann::json json = describeMachine(settings);
  for (const Run& run : runs)
  {
    table.rows.push_back({run.contestant.name, toText(run.steadyTiming()),
                          accuracyText(run.evaluations, FRAMES - SCORED_FRAMES, FRAMES),
                          accuracyText(run.evaluations, FRAMES, FRAMES + 1),
                          accuracyText(run.evaluations, FRAMES + 1, FRAMES + 2)});
    nlohmann::json row;
    row["method"] = run.contestant.name;
    row["time"] = toJson(run.timing);
    for (const Evaluation& evaluation : run.evaluations)
    {
      row["mse_100"].push_back(evaluation.mse_100);
      row["badpix_007"].push_back(evaluation.badpix_007);
    }
    json["rows"].push_back(row);
  }
  table.note = "A wall and discs that move, each in its own direction, and swing in depth; 17 views of " +
               std::to_string(SIDE_PX) + " x " + std::to_string(SIDE_PX) +
               " pixels. All presets see every "
               "frame in turn.";
  publish(settings, "video", table, json);
}

}  // namespace light_field_depth::benchmark
