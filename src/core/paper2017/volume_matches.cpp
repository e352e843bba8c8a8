#include "core/paper2017/volume_matches.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <opencv2/video/tracking.hpp>

namespace light_field_depth
{
namespace
{
/// One view matched with a neighbour.
struct MatchTask
{
  std::size_t from;  ///< index of the view
  std::size_t to;
};

/// Both directions of every consecutive pair, in order: there, back, there, back, ...
std::vector<MatchTask> tasksOf(const std::vector<AngularVolume>& volumes)
{
  std::vector<MatchTask> tasks;
  for (const AngularVolume& volume : volumes)
  {
    for (std::size_t i = 0; i + 1 < volume.view_indices.size(); ++i)
    {
      tasks.push_back({volume.view_indices[i], volume.view_indices[i + 1]});
      tasks.push_back({volume.view_indices[i + 1], volume.view_indices[i]});
    }
  }
  return tasks;
}

std::vector<std::size_t> viewsOf(const std::vector<AngularVolume>& volumes)
{
  std::vector<std::size_t> views;
  for (const AngularVolume& volume : volumes)
  {
    views.insert(views.end(), volume.view_indices.begin(), volume.view_indices.end());
  }
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

using Pyramids = std::vector<std::vector<DescriptorImage>>;

Pyramids describeViews(const LightField& light_field, const std::vector<AngularVolume>& volumes,
                       const PatchMatchOptions& options, RunContext& context)
{
  const StageTimer timer(context, "descriptors");
  const std::vector<std::size_t> views = viewsOf(volumes);
  const int levels = usablePyramidLevels(light_field.size(), options.levels, options.pyramid_ratio);
  Pyramids pyramids(light_field.views.size());
  context.pool.parallelFor(0, static_cast<int>(views.size()), 1,
                           [&](int i, int)
                           {
                             const std::size_t view = views[static_cast<std::size_t>(i)];
                             pyramids[view] = descriptorPyramid(light_field.views[view].image, levels,
                                                                options.pyramid_ratio);
                           });
  return pyramids;
}

std::vector<SeedMatches> matchByPatchMatch(const LightField& light_field,
                                           const std::vector<AngularVolume>& volumes,
                                           const std::vector<MatchTask>& tasks,
                                           const std::optional<DisparityRange>& range,
                                           const PatchMatchOptions& options, RunContext& context)
{
  const Pyramids pyramids = describeViews(light_field, volumes, options, context);
  const StageTimer timer(context, "matching");
  std::vector<SeedMatches> matches(tasks.size());
  context.pool.parallelFor(0, static_cast<int>(tasks.size()), 1,
                           [&](int i, int)
                           {
                             const MatchTask task = tasks[static_cast<std::size_t>(i)];
                             matches[static_cast<std::size_t>(i)] =
                                 matchPair(pyramids[task.from], pyramids[task.to],
                                           pairOf(light_field.views[task.from], light_field.views[task.to]),
                                           range, options);
                           });
  return matches;
}

/// A match for every pixel: the flow of OpenCV's DIS, projected on the epipolar line.
SeedMatches matchByDis(const View& from, const View& to, const std::optional<DisparityRange>& range)
{
  const cv::Size size = from.image.size();
  const ViewPair pair = pairOf(from, to);
  cv::Mat flow;
  cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM)
      ->calc(toGrey(from.image), toGrey(to.image), flow);
  SeedMatches matches;
  matches.columns_px.resize(static_cast<std::size_t>(size.width));
  matches.rows_px.resize(static_cast<std::size_t>(size.height));
  std::iota(matches.columns_px.begin(), matches.columns_px.end(), 0);
  std::iota(matches.rows_px.begin(), matches.rows_px.end(), 0);
  matches.cost = cv::Mat::zeros(size, CV_32FC1);
  matches.centre_share = cv::Mat::ones(size, CV_32FC1);
  matches.disparity.create(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      const auto& moved = flow.at<cv::Vec2f>(y, x);
      const cv::Point2d explained = cv::Point2d(moved[0], moved[1]) - pair.offset_px;
      const auto disparity = static_cast<float>(-explained.dot(pair.steps) / pair.steps.dot(pair.steps));
      matches.disparity.at<float>(y, x) = range ? std::clamp(disparity, range->min, range->max) : disparity;
    }
  }
  return matches;
}

std::vector<SeedMatches> matchAll(const LightField& light_field, const std::vector<AngularVolume>& volumes,
                                  const std::vector<MatchTask>& tasks,
                                  const std::optional<DisparityRange>& range, const Paper2017Options& options,
                                  RunContext& context)
{
  if (options.initializer == FlowInitializer::Cpm)
  {
    return matchByPatchMatch(light_field, volumes, tasks, range, options.patch_match, context);
  }
  const StageTimer timer(context, "matching");
  std::vector<SeedMatches> matches(tasks.size());
  context.pool.parallelFor(0, static_cast<int>(tasks.size()), 1,
                           [&](int i, int)
                           {
                             const MatchTask task = tasks[static_cast<std::size_t>(i)];
                             matches[static_cast<std::size_t>(i)] =
                                 matchByDis(light_field.views[task.from], light_field.views[task.to], range);
                           });
  return matches;
}

}  // namespace

std::vector<VolumeMatches> matchVolumes(const LightField& light_field,
                                        const std::vector<AngularVolume>& volumes,
                                        const std::optional<DisparityRange>& range,
                                        const Paper2017Options& options, RunContext& context)
{
  const std::vector<MatchTask> tasks = tasksOf(volumes);
  const std::vector<SeedMatches> matches = matchAll(light_field, volumes, tasks, range, options, context);
  PatchMatchOptions check = options.patch_match;
  check.grid_spacing_px = options.initializer == FlowInitializer::Cpm ? check.grid_spacing_px : 1;

  const StageTimer timer(context, "matching");
  std::vector<SparseDisparity> checked(tasks.size());
  context.pool.parallelFor(
      0, static_cast<int>(tasks.size()), 1,
      [&](int task, int)
      {
        const auto i = static_cast<std::size_t>(task);
        const ViewPair pair = pairOf(light_field.views[tasks[i].from], light_field.views[tasks[i].to]);
        const std::size_t opposite = i ^ 1U;
        checked[i] = consistentMatches(matches[i], matches[opposite], pair, light_field.size(), check);
      });
  std::vector<VolumeMatches> result;
  auto next = checked.begin();
  for (const AngularVolume& volume : volumes)
  {
    VolumeMatches of_volume;
    of_volume.forward.resize(volume.view_indices.size());
    of_volume.backward.resize(volume.view_indices.size());
    for (std::size_t i = 0; i + 1 < volume.view_indices.size(); ++i)
    {
      of_volume.forward[i] = *next++;
      of_volume.backward[i + 1] = *next++;
    }
    result.push_back(std::move(of_volume));
  }
  return result;
}

}  // namespace light_field_depth
