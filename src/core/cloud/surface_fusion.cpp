#include "core/cloud/surface_fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace light_field_depth::cloud
{
namespace
{
constexpr float NaN = std::numeric_limits<float>::quiet_NaN();
/// Candidates within this part of depth are one surface.
constexpr float SAME_SURFACE = 0.015F;
/// A map that shows something this much farther sees through the point.
constexpr float SEES_THROUGH = 0.02F;
/// Weight of a candidate: (LEAST_WEIGHT + confidence) / (1 + WEIGHT_FALL * distance of the views in steps).
/// The steeper the fall, the more a view's pixels are its nearest map's own: accuracy within 0.25 % of depth
/// is 71.1 % with a fall of 0.1, 74.1 % with 1, on the demo.
constexpr float LEAST_WEIGHT = 0.05F;
constexpr float WEIGHT_FALL = 1.0F;
constexpr int MIN_VOTES = 2;
/// Sum of the weights that a point needs, for each unit of min_confidence: where not all maps agree on it,
/// and where they do. On the demo 0.66 % of the points are more than 2 % off if agreement alone is enough,
/// 0.10 % with this.
constexpr float MIN_WEIGHT_PER_CONFIDENCE = 5.0F;
constexpr float MIN_WEIGHT_OF_AGREED_PER_CONFIDENCE = 1.5F;
/// Maps that are less sure than this do not contradict.
constexpr float MIN_CONTRADICTING_CONFIDENCE = 0.3F;

struct Candidate
{
  float disparity;
  float confidence;
  float weight;
  std::int32_t source;
  std::uint32_t map;
};

/// A surface that some of the candidates share.
struct Cluster
{
  float disparity = 0.0F;
  float confidence = 0.0F;
  float weight = 0.0F;
  std::uint32_t members = 0;  ///< a bit for each map
  int votes = 0;
  const Candidate* heaviest = nullptr;
};

Cluster clusterAbout(const Candidate* begin, const Candidate* end, float centre, const Tolerance& tolerance)
{
  Cluster cluster;
  const float reach = tolerance.gap(centre, SAME_SURFACE);
  float heaviest = -1.0F;
  for (const Candidate* candidate = begin; candidate != end; ++candidate)
  {
    const float gap = candidate->disparity - centre;
    if (gap > reach || gap < -reach)
    {
      continue;
    }
    cluster.disparity += candidate->weight * gap;
    cluster.confidence += candidate->weight * candidate->confidence;
    cluster.weight += candidate->weight;
    cluster.members |= 1U << candidate->map;
    ++cluster.votes;
    if (candidate->weight > heaviest)
    {
      heaviest = candidate->weight;
      cluster.heaviest = candidate;
    }
  }
  cluster.disparity = centre + cluster.disparity / cluster.weight;
  cluster.confidence /= cluster.weight;
  return cluster;
}

/// The cluster about one of the candidates that has the greatest weight; of equal ones the nearest.
Cluster bestCluster(const Candidate* begin, const Candidate* end, const Tolerance& tolerance)
{
  Cluster best;
  for (const Candidate* centre = begin; centre != end; ++centre)
  {
    const Cluster cluster = clusterAbout(begin, end, centre->disparity, tolerance);
    const bool better =
        cluster.weight > best.weight || (cluster.weight == best.weight && cluster.disparity > best.disparity);
    if (better)
    {
      best = cluster;
    }
    if (cluster.votes == static_cast<int>(end - begin))
    {
      return cluster;
    }
  }
  return best;
}

/// Whether the maps that agree are enough and sure enough.
bool isSupported(const Cluster& cluster, int maps, float min_confidence)
{
  if (maps == 1)
  {
    return cluster.confidence >= min_confidence;
  }
  const float factor =
      cluster.votes == maps ? MIN_WEIGHT_OF_AGREED_PER_CONFIDENCE : MIN_WEIGHT_PER_CONFIDENCE;
  return cluster.votes >= MIN_VOTES && cluster.weight >= factor * min_confidence;
}

/// Tells whether a map looks through a point of a view at something behind it.
class SightLines
{
public:
  SightLines(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance)
      : maps_(maps), tolerance_(tolerance)
  {
    for (const SurfaceMap& map : maps)
    {
      steps_.emplace_back(view.steps - map.steps);
      offsets_.emplace_back(view.offset_px - map.offset_px);
    }
  }

  bool areBlocked(int x, int y, const Cluster& cluster) const
  {
    for (std::size_t i = 0; i < maps_.size(); ++i)
    {
      if ((cluster.members >> i & 1U) == 0 && seesThrough(i, x, y, cluster.disparity))
      {
        return false;
      }
    }
    return true;
  }

private:
  bool seesThrough(std::size_t i, int x, int y, float disparity) const
  {
    const SurfaceMap& map = maps_[i];
    const float at_x = static_cast<float>(x) - offsets_[i].x + disparity * steps_[i].x + 0.5F;
    const float at_y = static_cast<float>(y) - offsets_[i].y + disparity * steps_[i].y + 0.5F;
    if (!(at_x >= 0.0F && at_y >= 0.0F && at_x < static_cast<float>(map.disparity.cols) &&
          at_y < static_cast<float>(map.disparity.rows)))
    {
      return false;
    }
    const int column = static_cast<int>(at_x);
    const int row = static_cast<int>(at_y);
    return map.confidence.ptr<float>(row)[column] >= MIN_CONTRADICTING_CONFIDENCE &&
           disparity - map.disparity.ptr<float>(row)[column] > tolerance_.gap(disparity, SEES_THROUGH);
  }

  const std::vector<SurfaceMap>& maps_;
  const Tolerance& tolerance_;
  std::vector<cv::Point2f> steps_;
  std::vector<cv::Point2f> offsets_;
};

void createMaps(const cv::Size& size, FusedView& fused)
{
  for (cv::Mat* const map : {&fused.disparity, &fused.confidence, &fused.slope_x, &fused.slope_y})
  {
    map->create(size, CV_32FC1);
  }
  fused.votes.create(size, CV_8UC1);
  fused.by_first.create(size, CV_8UC1);
}

}  // namespace

void fuseView(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance,
              float min_confidence, FusionScratch& scratch, FusedView& fused)
{
  CV_Assert(!maps.empty() && maps.size() <= MAX_FUSED_MAPS);
  const cv::Size size = maps.front().disparity.size();
  createMaps(size, fused);
  scratch.warped.resize(maps.size());
  std::array<float, MAX_FUSED_MAPS> nearness{};
  std::array<cv::Point2f, MAX_FUSED_MAPS> steps;
  for (std::size_t i = 0; i < maps.size(); ++i)
  {
    warpSurface(maps[i], view, tolerance, scratch.warped[i]);
    steps[i] = view.steps - maps[i].steps;
    nearness[i] = 1.0F / (1.0F + WEIGHT_FALL * std::hypot(steps[i].x, steps[i].y));
  }
  const SightLines sight_lines(maps, view, tolerance);
  const int all = static_cast<int>(maps.size());
  const int min_votes = std::min(MIN_VOTES, all);
  std::array<Candidate, MAX_FUSED_MAPS> candidates{};
  for (int y = 0; y < size.height; ++y)
  {
    for (int x = 0; x < size.width; ++x)
    {
      Candidate* end = candidates.data();
      for (std::size_t i = 0; i < maps.size(); ++i)
      {
        const std::int32_t source = scratch.warped[i].source.ptr<std::int32_t>(y)[x];
        if (source >= 0)
        {
          const float confidence = maps[i].confidence.ptr<float>()[source];
          *end++ = {scratch.warped[i].disparity.ptr<float>(y)[x], confidence,
                    (LEAST_WEIGHT + confidence) * nearness[i], source, static_cast<std::uint32_t>(i)};
        }
      }
      float& disparity = fused.disparity.ptr<float>(y)[x];
      disparity = NaN;
      if (end - candidates.data() < min_votes)
      {
        continue;
      }
      const Cluster cluster = bestCluster(candidates.data(), end, tolerance);
      const bool agreed = isSupported(cluster, all, min_confidence);
      if (!agreed || (cluster.votes < all && !sight_lines.areBlocked(x, y, cluster)))
      {
        continue;
      }
      disparity = cluster.disparity;
      const SurfaceMap& map = maps[cluster.heaviest->map];
      const float slope_x = map.slope_x.ptr<float>()[cluster.heaviest->source];
      const float slope_y = map.slope_y.ptr<float>()[cluster.heaviest->source];
      const float squeeze = compression(slope_x, slope_y, steps[cluster.heaviest->map]);
      const float stretch = squeeze > MIN_COMPRESSION ? 1.0F / squeeze : 1.0F;
      fused.confidence.ptr<float>(y)[x] = cluster.confidence;
      fused.slope_x.ptr<float>(y)[x] = slope_x * stretch;
      fused.slope_y.ptr<float>(y)[x] = slope_y * stretch;
      fused.votes.ptr<std::uint8_t>(y)[x] = static_cast<std::uint8_t>(cluster.votes);
      fused.by_first.ptr<std::uint8_t>(y)[x] = static_cast<std::uint8_t>(cluster.members & 1U);
    }
  }
}

}  // namespace light_field_depth::cloud
