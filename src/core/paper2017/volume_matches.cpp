#include "core/paper2017/volume_matches.h"

#include <algorithm>
#include <map>

#include "core/paper2017/dense_flow.h"

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

/// The sparse matches of each pair spread to all pixels.
std::vector<SeedMatches> spreadAll(const LightField& light_field, const std::vector<MatchTask>& tasks,
                                   const std::vector<SeedMatches>& sparse,
                                   const std::optional<DisparityRange>& range,
                                   const PatchMatchOptions& options, RunContext& context)
{
  const StageTimer timer(context, "matching");
  std::vector<SeedMatches> matches(tasks.size());
  context.pool.parallelFor(
      0, static_cast<int>(tasks.size()), 1,
      [&](int task, int)
      {
        const auto i = static_cast<std::size_t>(task);
        const View& from = light_field.views[tasks[i].from];
        const View& to = light_field.views[tasks[i].to];
        const std::size_t opposite = i ^ 1U;
        matches[i] = spreadByEpicFlow(
            from, to,
            consistentMatches(sparse[i], sparse[opposite], pairOf(from, to), light_field.size(), options),
            options.grid_spacing_px, range);
      });
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
  if (options.initializer == FlowInitializer::EpicFlow)
  {
    return spreadAll(light_field, tasks,
                     matchByPatchMatch(light_field, volumes, tasks, range, options.patch_match, context),
                     range, options.patch_match, context);
  }
  const StageTimer timer(context, "matching");
  std::vector<SeedMatches> matches(tasks.size());
  context.pool.parallelFor(0, static_cast<int>(tasks.size()), 1,
                           [&](int i, int)
                           {
                             const MatchTask task = tasks[static_cast<std::size_t>(i)];
                             matches[static_cast<std::size_t>(i)] =
                                 matchByFlow(light_field.views[task.from], light_field.views[task.to],
                                             options.initializer, range);
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
