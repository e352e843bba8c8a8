#include "conditions.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <opencv2/core.hpp>

#include "accuracy_table.h"
#include "camera_model.h"
#include "contestant.h"
#include "light_field_depth/core/pipeline.h"
#include "scene.h"

namespace light_field_depth::benchmark
{
namespace
{
/// Makes another light field of one, or nothing if it has not the views for that.
using Change = std::function<std::optional<LightField>(const LightField&)>;

struct Condition
{
  std::string name;
  Change change;
};

/// Changes the pixels of every view, each with random numbers of its own that are the same in every run.
Change toEveryView(const std::function<void(cv::Mat&, cv::RNG&)>& change)
{
  return [change](const LightField& light_field)
  {
    LightField changed = light_field;
    std::uint64_t seed = 1;
    for (View& view : changed.views)
    {
      cv::RNG random(seed++);
      cv::Mat image = view.image.clone();
      change(image, random);
      view.image = image;
    }
    return std::optional<LightField>(changed);
  };
}

/// Gaussian, in units of 8-bit views; rounded and cut off as a camera does.
Change noise(double sigma)
{
  return toEveryView(
      [sigma](cv::Mat& image, cv::RNG& random)
      {
        cv::Mat values;
        image.convertTo(values, CV_32F);
        cv::Mat added(values.size(), values.type());
        random.fill(added, cv::RNG::NORMAL, 0.0, sigma);
        values += added;
        values.convertTo(image, image.depth());
      });
}

/// A gain and an offset for each view.
Change exposureDifferences(double gain_percent, double offset_levels)
{
  return toEveryView(
      [=](cv::Mat& image, cv::RNG& random)
      {
        const double gain = 1.0 + random.uniform(-gain_percent, gain_percent) / 100.0;
        image.convertTo(image, -1, gain, random.uniform(-offset_levels, offset_levels));
      });
}

Change grey()
{
  return toEveryView([](cv::Mat& image, cv::RNG& /*random*/) { image = toGrey(image); });
}

Change cameras(const CameraModel& model)
{
  return [model](const LightField& light_field)
  { return std::optional<LightField>(photograph(light_field, model)); };
}

/// Cameras that stand as exactly as rendered views do.
CameraModel inPlace()
{
  CameraModel model;
  model.shift_px = 0.0;
  model.roll_degrees = 0.0;
  return model;
}

/// The reference and the views at these positions beside it, all of which must be there.
Change only(const std::vector<GridPosition>& from_reference)
{
  return [from_reference](const LightField& light_field)
  {
    const GridPosition centre = light_field.reference().grid;
    std::vector<View> kept = {light_field.reference()};
    for (const View& view : light_field.views)
    {
      const GridPosition offset{view.grid.row - centre.row, view.grid.column - centre.column};
      if (std::find(from_reference.begin(), from_reference.end(), offset) != from_reference.end())
      {
        kept.push_back(view);
      }
    }
    return kept.size() == from_reference.size() + 1
               ? std::optional<LightField>(makeLightField(std::move(kept), centre))
               : std::nullopt;
  };
}

/// The neighbours in a block of 3 x 3 views that stand `step` apart.
std::vector<GridPosition> block(int step)
{
  std::vector<GridPosition> positions;
  for (int row = -step; row <= step; row += step)
  {
    for (int column = -step; column <= step; column += step)
    {
      if (row != 0 || column != 0)
      {
        positions.push_back({row, column});
      }
    }
  }
  return positions;
}

/// Another condition joins with one line.
const std::vector<Condition>& conditions()
{
  static const std::vector<Condition> all = {
      {"as it is", [](const LightField& light_field) { return std::optional<LightField>(light_field); }},
      {"noise, sigma 3", noise(3.0)},
      {"noise, sigma 5", noise(5.0)},
      {"noise, sigma 8", noise(8.0)},
      {"grey", grey()},
      {"gains of 10 % and offsets of 8 levels", exposureDifferences(10.0, 8.0)},
      {"camera model", cameras({})},
      {"camera model, without shifts and rolls", cameras(inPlace())},
      {"one row, 9 views", only({{0, -4}, {0, -3}, {0, -2}, {0, -1}, {0, 1}, {0, 2}, {0, 3}, {0, 4}})},
      {"one row, 3 views", only({{0, -1}, {0, 1}})},
      {"two views, four steps apart", only({{0, 4}})},
      {"3 x 3 views", only(block(1))},
      {"3 x 3 views, four steps apart", only(block(4))},
  };
  return all;
}

std::vector<std::string> namesOf(const std::vector<Condition>& all)
{
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Condition& condition : all)
  {
    names.push_back(condition.name);
  }
  return names;
}

}  // namespace

void measureConditions(const Settings& settings)
{
  AccuracyTable table(settings, "condition", namesOf(conditions()));
  const auto pipeline = std::make_shared<Pipeline>(settings.threads);
  for (const std::string& input : settings.inputs)
  {
    const Scene scene = readScene(input, settings.threads);
    std::vector<Contestant> contestants;
    for (const Condition& condition : conditions())
    {
      const std::optional<LightField> changed = condition.change(scene.light_field);
      if (changed)
      {
        const auto run = makeContestant({condition.name, {}}, pipeline).run;
        contestants.push_back(
            {condition.name, [run, changed](const LightField& /*unchanged*/) { return run(*changed); }});
      }
    }
    table.add(scene.name, measure(scene, contestants, settings.runs));
  }
  table.publish("conditions");
}

}  // namespace light_field_depth::benchmark
