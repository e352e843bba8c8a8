#include "core/cloud/surface_fusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/cloud/cloud_kernels.h"

namespace light_field_depth::cloud
{
namespace
{
/// Candidates within this part of depth are one surface.
constexpr float SAME_SURFACE = 0.015F;
/// A map that shows something this much farther sees through the point.
constexpr float SEES_THROUGH = 0.02F;
/// Weight of a candidate: (LEAST_WEIGHT + confidence) / (1 + WEIGHT_FALL * distance of the views in steps).
/// The steeper the fall, the more a view's pixels are its nearest map's own: accuracy within 0.25 % of depth
/// is 71.1 % with a fall of 0.1, 74.1 % with 1, on the demo.
constexpr float LEAST_WEIGHT = 0.05F;
constexpr float WEIGHT_FALL = 1.0F;
constexpr int MIN_CANDIDATES = 2;
constexpr int MIN_VOTES = 2;
/// Sum of the weights that a point needs, for each unit of min_confidence: on the demo 0.09 % of the points
/// are more than 2 % off with it, 0.13 % with 3. Also where all maps agree: at edges they do so a pixel
/// beside the surface, each unsure.
constexpr float MIN_WEIGHT_PER_CONFIDENCE = 5.0F;
/// Maps that are less sure than this do not contradict.
constexpr float MIN_CONTRADICTING_CONFIDENCE = 0.3F;
/// Outlines of solved maps stand so far beside the true ones, so that what one map shows beside an edge may
/// be hidden in the others: that is kept if they show its surface so near. Antinous keeps 90.6 instead
/// of 90.1 % of its reference with it.
constexpr int BESIDE_PX = 2;

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

/// Whether all candidates outside of a cluster are nearer, and there are some: they hide its surface from the
/// maps that do not have it.
bool isBehindTheOthers(const Candidate* begin, const Candidate* end, const Cluster& cluster,
                       const Tolerance& tolerance)
{
  const float front = cluster.disparity + tolerance.gap(cluster.disparity, SAME_SURFACE);
  return end - begin > cluster.votes &&
         std::all_of(begin, end,
                     [&](const Candidate& candidate)
                     { return (cluster.members >> candidate.map & 1U) != 0 || candidate.disparity > front; });
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

  /// Whether a map that is not of a cluster has its surface beside where the point would stand in it.
  bool passBeside(int x, int y, const Cluster& cluster) const
  {
    for (std::size_t i = 0; i < maps_.size(); ++i)
    {
      if ((cluster.members >> i & 1U) == 0 && showsBeside(i, x, y, cluster.disparity))
      {
        return true;
      }
    }
    return false;
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
  /// Where a point of the view stands in a map; nothing where that is outside.
  std::optional<cv::Point> placeIn(std::size_t i, int x, int y, float disparity) const
  {
    const cv::Mat& map = maps_[i].disparity;
    const float at_x = static_cast<float>(x) - offsets_[i].x + disparity * steps_[i].x + 0.5F;
    const float at_y = static_cast<float>(y) - offsets_[i].y + disparity * steps_[i].y + 0.5F;
    const bool inside = at_x >= 0.0F && at_y >= 0.0F && at_x < static_cast<float>(map.cols) &&
                        at_y < static_cast<float>(map.rows);
    return inside ? std::make_optional<cv::Point>(static_cast<int>(at_x), static_cast<int>(at_y))
                  : std::nullopt;
  }

  bool seesThrough(std::size_t i, int x, int y, float disparity) const
  {
    const SurfaceMap& map = maps_[i];
    const std::optional<cv::Point> place = placeIn(i, x, y, disparity);
    return place && map.confidence.at<float>(*place) >= MIN_CONTRADICTING_CONFIDENCE &&
           disparity - map.disparity.at<float>(*place) > tolerance_.gap(disparity, SEES_THROUGH);
  }

  bool showsBeside(std::size_t i, int x, int y, float disparity) const
  {
    const SurfaceMap& map = maps_[i];
    const std::optional<cv::Point> place = placeIn(i, x, y, disparity);
    if (!place)
    {
      return false;
    }
    const float gap = tolerance_.gap(disparity, SAME_SURFACE);
    const cv::Rect about =
        cv::Rect(place->x - BESIDE_PX, place->y - BESIDE_PX, 2 * BESIDE_PX + 1, 2 * BESIDE_PX + 1) &
        cv::Rect({}, map.disparity.size());
    for (int v = about.y; v < about.y + about.height; ++v)
    {
      for (int u = about.x; u < about.x + about.width; ++u)
      {
        if (map.confidence.ptr<float>(v)[u] >= 0.0F &&
            std::abs(map.disparity.ptr<float>(v)[u] - disparity) <= gap)
        {
          return true;
        }
      }
    }
    return false;
  }

  const std::vector<SurfaceMap>& maps_;
  const Tolerance& tolerance_;
  std::vector<cv::Point2f> steps_;
  std::vector<cv::Point2f> offsets_;
};

void setWidth(std::size_t width, FusedRow& row)
{
  for (std::vector<float>* const values : {&row.disparity, &row.confidence, &row.slope_x, &row.slope_y})
  {
    values->resize(width);
  }
  row.votes.resize(width);
  row.by_first.resize(width);
}

/// Writes what the candidates of each pixel agree on.
class ViewFusion
{
public:
  ViewFusion(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance,
             float min_confidence, FusionScratch& scratch)
      : sight_lines_(maps, view, tolerance), tolerance_(tolerance), min_confidence_(min_confidence),
        warps_(scratch.warps), row_(scratch.row), all_(maps.size()), width_(maps.front().disparity.cols)
  {
    warps_.resize(all_);
    setWidth(static_cast<std::size_t>(width_), row_);
    done_.resize(row_.votes.size());
    for (std::size_t i = 0; i < all_; ++i)
    {
      const cv::Point2f steps = view.steps - maps[i].steps;
      warps_[i].begin(maps[i], view, tolerance);
      MapOfRow& map = maps_[i];
      map.confidence = maps[i].confidence.ptr<float>();
      map.slope_x = maps[i].slope_x.ptr<float>();
      map.slope_y = maps[i].slope_y.ptr<float>();
      map.steps_x = steps.x;
      map.steps_y = steps.y;
      map.nearness = 1.0F / (1.0F + WEIGHT_FALL * std::hypot(steps.x, steps.y));
      nearest_ = std::max(nearest_, map.nearness);
      if (steps == cv::Point2f() && !maps[i].held.empty())
      {
        own_ = &maps[i];
        own_index_ = static_cast<std::uint32_t>(i);
      }
    }
  }

  /// Rows in their order.
  const FusedRow& fuseRow(int y)
  {
    for (std::size_t i = 0; i < all_; ++i)
    {
      const WarpedRow warped = warps_[i].nextRow();
      maps_[i].source = warped.source;
      maps_[i].disparity = warped.disparity;
    }
    agree();
    const auto end = done_.end();
    for (auto left = std::find(done_.begin(), end, 0); left != end; left = std::find(left + 1, end, 0))
    {
      fusePixel(static_cast<int>(left - done_.begin()), y);
    }
    if (own_ != nullptr)
    {
      takeHeld(y);
    }
    return row_;
  }

private:
  /// What planes hold is no new information for other views: they would only repeat it.
  void takeHeld(int y)
  {
    const auto* const held = own_->held.ptr<float>(y);
    const auto* const disparity = own_->disparity.ptr<float>(y);
    for (int x = 0; x < width_; ++x)
    {
      if (held[x] >= min_confidence_ && held[x] > 0.0F &&
          std::isnan(row_.disparity[static_cast<std::size_t>(x)]))
      {
        Cluster cluster;
        cluster.disparity = disparity[x];
        cluster.members = 1U << own_index_;
        if (sight_lines_.areBlocked(x, y, cluster))
        {
          const std::int32_t source = y * width_ + x;
          write(x, disparity[x], held[x], {disparity[x], held[x], 1.0F, source, own_index_}, 1,
                cluster.members);
        }
      }
    }
  }

  /// What all maps show on one surface, which is nearly everything.
  void agree()
  {
    AgreedRow row;
    row.maps = maps_.data();
    row.count = static_cast<int>(all_);
    row.width = width_;
    row.offset_px = tolerance_.offset_px;
    row.floor_px = tolerance_.floor_px;
    row.same_surface = SAME_SURFACE;
    row.least_weight = LEAST_WEIGHT;
    row.min_weight =
        all_ == 1 ? std::numeric_limits<float>::infinity() : MIN_WEIGHT_PER_CONFIDENCE * min_confidence_;
    row.min_confidence = min_confidence_;
    row.nearest = nearest_;
    row.disparity = row_.disparity.data();
    row.confidence = row_.confidence.data();
    row.slope_x = row_.slope_x.data();
    row.slope_y = row_.slope_y.data();
    row.done = done_.data();
    agreeInRow(row);
    std::fill(row_.votes.begin(), row_.votes.end(), static_cast<std::uint8_t>(all_));
    std::fill(row_.by_first.begin(), row_.by_first.end(), std::uint8_t{1});
  }

  void fusePixel(int x, int y)
  {
    Candidate* end = candidates_.data();
    for (std::size_t i = 0; i < all_; ++i)
    {
      const MapOfRow& map = maps_[i];
      const std::int32_t source = map.source[x];
      if (source >= 0)
      {
        const float confidence = map.confidence[source];
        *end++ = {map.disparity[x], confidence, (LEAST_WEIGHT + confidence) * map.nearness, source,
                  static_cast<std::uint32_t>(i)};
      }
    }
    if (end - candidates_.data() < MIN_CANDIDATES)
    {
      return;
    }
    const Cluster cluster = bestCluster(candidates_.data(), end, tolerance_);
    if (isSupported(x, y, cluster, end) &&
        (cluster.votes == static_cast<int>(all_) || sight_lines_.areBlocked(x, y, cluster)))
    {
      write(x, cluster.disparity, cluster.confidence, *cluster.heaviest, cluster.votes, cluster.members);
    }
  }

  /// Whether the maps that agree are enough and sure enough: the sum of their weights tells, or the
  /// confidence of the map that is nearest to the view. One heavy map is enough beside an edge.
  bool isSupported(int x, int y, const Cluster& cluster, const Candidate* end) const
  {
    const bool heavy = cluster.weight >= MIN_WEIGHT_PER_CONFIDENCE * min_confidence_;
    if (cluster.votes < MIN_VOTES)
    {
      return heavy && isBehindTheOthers(candidates_.data(), end, cluster, tolerance_) &&
             sight_lines_.passBeside(x, y, cluster);
    }
    return heavy || std::any_of(candidates_.data(), end,
                                [&](const Candidate& candidate)
                                {
                                  return maps_[candidate.map].nearness >= nearest_ &&
                                         (cluster.members >> candidate.map & 1U) != 0 &&
                                         candidate.confidence >= min_confidence_;
                                });
  }

  void write(int x, float disparity, float confidence, const Candidate& from, int votes,
             std::uint32_t members)
  {
    const MapOfRow& map = maps_[from.map];
    const float slope_x = map.slope_x[from.source];
    const float slope_y = map.slope_y[from.source];
    const float squeeze = compression(slope_x, slope_y, map.steps_x, map.steps_y);
    const float stretch = squeeze > MIN_COMPRESSION ? 1.0F / squeeze : 1.0F;
    const auto at = static_cast<std::size_t>(x);
    row_.disparity[at] = disparity;
    row_.confidence[at] = confidence;
    row_.slope_x[at] = slope_x * stretch;
    row_.slope_y[at] = slope_y * stretch;
    row_.votes[at] = static_cast<std::uint8_t>(votes);
    row_.by_first[at] = static_cast<std::uint8_t>(members & 1U);
  }

  SightLines sight_lines_;
  const Tolerance& tolerance_;
  float min_confidence_;
  std::vector<SurfaceWarp>& warps_;
  FusedRow& row_;
  std::size_t all_;
  int width_;
  std::array<MapOfRow, MAX_FUSED_MAPS> maps_{};
  float nearest_ = 0.0F;             ///< the greatest nearness
  const SurfaceMap* own_ = nullptr;  ///< of this very view, if planes hold some of it
  std::uint32_t own_index_ = 0;
  std::array<Candidate, MAX_FUSED_MAPS> candidates_{};
  std::vector<std::uint8_t> done_;  ///< of a row: where nothing is left to decide
};

}  // namespace

void fuseView(const std::vector<SurfaceMap>& maps, const View& view, const Tolerance& tolerance,
              float min_confidence, FusionScratch& scratch, const FusedRowSink& sink)
{
  CV_Assert(!maps.empty() && maps.size() <= MAX_FUSED_MAPS);
  ViewFusion fusion(maps, view, tolerance, min_confidence, scratch);
  for (int y = 0; y < maps.front().disparity.rows; ++y)
  {
    sink(y, fusion.fuseRow(y));
  }
}

}  // namespace light_field_depth::cloud
