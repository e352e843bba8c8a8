#include "core/multiview/search/label_search.h"

#include <algorithm>

#include "core/multiview/search/thin_structures.h"

namespace light_field_depth::multiview
{
namespace
{
/// A later search tries the labels that the one before found within so many pixels of a tile, and so many
/// more.
constexpr int BAND_REACH_PX = 4;
constexpr float BAND_MARGIN_LABELS = 3.0F;
/// The same for the first search of a frame that follows another one, whose objects may have moved.
constexpr int FOLLOWED_REACH_PX = 12;
constexpr float FOLLOWED_MARGIN_LABELS = 2.0F;
/// Distance of the labels that SearchSettings::paths is meant for.
constexpr float UNIT_LABEL_STEP_PX = 0.125F;
/// Of a penalty: the sum over four paths, each FULL_COST and a penalty at the most, stays in 16 bits.
constexpr int MAX_STEP = 12000;
/// A difference of grey values compared with the sum of the differences of three channels.
constexpr float GREY_SHARE = 0.4F;

CostSettings costFor(const ViewSet& views, CostSettings cost)
{
  if (views.reference.channels() == 1)
  {
    cost.truncation = std::max(1, cvRound(GREY_SHARE * static_cast<float>(cost.truncation)));
    cost.unseen_penalty = cvRound(GREY_SHARE * static_cast<float>(cost.unseen_penalty));
  }
  cost.min_seeing_views = std::min(cost.min_seeing_views, static_cast<int>(views.views.size()));
  return cost;
}

/// @param small_share, large_share what is asked of P1 and P2
PathSettings pathsFor(const LabelSpace& labels, PathSettings paths, float small_share = 1.0F,
                      float large_share = 1.0F)
{
  paths.small_change_penalty = cvRound(small_share * static_cast<float>(paths.small_change_penalty) *
                                       labels.step_px / UNIT_LABEL_STEP_PX);
  paths.large_change_penalty = cvRound(large_share * static_cast<float>(paths.large_change_penalty));
  return paths;
}

/// The same range in labels farther apart, unless no later search follows that would try those between.
LabelSpace firstLabels(const LabelSpace& labels, const SearchSettings& settings)
{
  if (settings.visibility_passes == 0)
  {
    return labels;
  }
  return makeLabelSpace(labels.range(), labels.step_px * settings.first_label_step_share, labels.count);
}

}  // namespace

bool LabelSearch::run(const SearchInput& input, const SearchSettings& settings, const cv::Mat& around,
                      RunContext& context, SearchMaps& maps)
{
  const CostSettings cost = costFor(input.views, settings.cost);
  const LabelSpace first_labels = firstLabels(input.labels, settings);
  if (!findFirstMap({input.views, input.guide, first_labels}, settings, cost, around, context, maps.last))
  {
    return false;
  }
  maps.last.copyTo(maps.first);
  context.save("multiview_first_search", maps.first);
  for (int pass = 1; pass <= settings.visibility_passes; ++pass)
  {
    computeVisibleCosts(input, settings, cost, maps.last, context);
    if (pass == settings.visibility_passes)
    {
      setPaths(input,
               pathsFor(input.labels, settings.paths, settings.last_small_change_share,
                        settings.last_large_change_share),
               context);
    }
    else if (pass == 1)
    {
      setPaths(input, pathsFor(input.labels, settings.paths), context);
    }
    aggregate(input, settings, context, maps.last);
  }
  return true;
}

/// Before it is known which view sees what.
bool LabelSearch::findFirstMap(const SearchInput& input, const SearchSettings& settings,
                               const CostSettings& cost, const cv::Mat& around, RunContext& context,
                               cv::Mat& disparity)
{
  if (!computeFirstCosts(input, settings, cost, around, context))
  {
    return false;
  }
  setPaths(input, pathsFor(input.labels, settings.paths), context);
  aggregate(input, settings, context, disparity);
  if (settings.detect_changes && !acceptFirstMap(input, around.empty(), disparity, context))
  {
    return false;
  }
  if (settings.fuse_background)
  {
    fuseBackground(input, settings, context, disparity);
  }
  return true;
}

bool LabelSearch::computeFirstCosts(const SearchInput& input, const SearchSettings& settings,
                                    const CostSettings& cost, const cv::Mat& around, RunContext& context)
{
  const StageTimer timer(context, "cost");
  const ViewSet& views = input.views;
  if (around.empty())
  {
    bands_.setAll(views.width(), views.height(), input.labels.count);
  }
  else
  {
    bands_.setAround(around, input.labels, FOLLOWED_REACH_PX, FOLLOWED_MARGIN_LABELS, context.pool);
  }
  if (!settings.detect_changes)
  {
    cost_builder_.buildFromArms(views, input.labels, bands_, cost, context.pool, volume_);
    return true;
  }
  changes_.begin(bands_);
  cost_builder_.buildObserved(views, input.labels, bands_, cost, changes_, context.pool, volume_);
  if (around.empty())
  {
    changes_.acceptFull();
    return true;
  }
  if (!changes_.acceptNear(bands_, changed_tiles_))
  {
    return false;
  }
  if (std::any_of(changed_tiles_.begin(), changed_tiles_.end(), [](std::uint8_t tile) { return tile != 0; }))
  {
    cost_builder_.rebuildTiles(views, input.labels, bands_, changed_tiles_, cost, context.pool, volume_);
  }
  return true;
}

bool LabelSearch::acceptFirstMap(const SearchInput& input, bool all_labels, const cv::Mat& disparity,
                                 RunContext& context)
{
  const StageTimer timer(context, "cost");
  if (all_labels)
  {
    changes_.acceptFullMap(disparity, input.labels);
    return true;
  }
  return changes_.acceptNearMap(disparity, input.labels);
}

void LabelSearch::setPaths(const SearchInput& input, const PathSettings& paths, RunContext& context)
{
  const StageTimer timer(context, "aggregate");
  paths_ = paths;
  // Sixteen bits hold the sums of the paths.
  paths_.small_change_penalty = std::clamp(paths_.small_change_penalty, 1, MAX_STEP);
  paths_.large_change_penalty = std::clamp(paths_.large_change_penalty, 1, MAX_STEP);
  aggregator_.setGuide(input.guide, paths_, context.pool);
}

void LabelSearch::aggregate(const SearchInput& input, const SearchSettings& settings, RunContext& context,
                            cv::Mat& disparity)
{
  {
    const StageTimer timer(context, "aggregate");
    aggregator_.aggregate(volume_, paths_, context.pool, label_);
  }
  const StageTimer timer(context, "median");
  median_.run(label_, input.labels, context.pool, disparity);
  if (settings.keep_thin_structures)
  {
    label_.convertTo(before_median_, CV_32F, input.labels.step_px, input.labels.first_px);
    keepThinStructures(input.guide, before_median_, context.pool, disparity);
  }
}

void LabelSearch::fuseBackground(const SearchInput& input, const SearchSettings& settings,
                                 RunContext& context, cv::Mat& disparity)
{
  {
    const StageTimer timer(context, "background");
    background_.prepare(input.labels, disparity, context.pool, volume_);
  }
  aggregate(input, settings, context, with_charges_);
  context.save("multiview_background", with_charges_);
  const StageTimer timer(context, "background");
  background_.fuse(volume_, aggregator_, paths_, with_charges_, context.pool, disparity);
}

void LabelSearch::computeVisibleCosts(const SearchInput& input, const SearchSettings& settings,
                                      const CostSettings& cost, const cv::Mat& disparity, RunContext& context)
{
  {
    const StageTimer timer(context, "visibility");
    bands_.setAround(disparity, input.labels, BAND_REACH_PX, BAND_MARGIN_LABELS, context.pool);
    surfaces_.warp(disparity, input.views, input.labels, context.pool);
  }
  const StageTimer timer(context, "visible_cost");
  cost_builder_.buildFromVisible(input.views, input.labels, bands_, surfaces_, cost, context.pool, volume_);
  if (settings.fuse_background)
  {
    background_.chargeMoved(input.labels, context.pool, volume_);
  }
}

}  // namespace light_field_depth::multiview
