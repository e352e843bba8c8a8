#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
struct ViewSynchronizerOptions
{
  /// How many views make a whole set; at least 1.
  std::size_t view_count = 0;

  /// Incomplete sets that are kept; the one begun first is dropped for a new one. Raise it when views of one
  /// stamp arrive many frames apart.
  std::size_t queue_size = 5;

  /// Largest difference between the stamps of one set, in nanoseconds; 0: all stamps are equal. Raise it for
  /// cameras that are triggered together but stamped apart; keep it below half the time between frames.
  std::int64_t tolerance_ns = 0;
};

/// What happened to the messages of one view.
struct ViewCounts
{
  std::uint64_t received = 0;
  std::uint64_t dropped = 0;       ///< received, but in no whole set
  std::uint64_t missing = 0;       ///< dropped sets that had no message of this view: who is to blame
  std::int64_t last_stamp_ns = 0;  ///< of the last message; only if received > 0
};

struct ViewSynchronizerStatistics
{
  std::vector<ViewCounts> views;
  std::uint64_t sets_complete = 0;
  std::uint64_t sets_dropped = 0;  ///< incomplete
  std::uint64_t time_jumps = 0;    ///< whole sets that were older than the one before them
};

/// Brings together the messages of N views that belong to one moment. N is known at run time.
///
/// The views may be ahead of or behind one another. A whole set drops the older sets begun before it. When
/// time jumps back (a bag that loops, a restarted simulation), every view delivers older stamps anew; these
/// make whole sets again without further ado, and the first of them drops what is left from before the jump.
/// A single late message, which finds no companions, is dropped as any incomplete set is.
///
/// Payload is a pointer, or as cheap to move; nothing is copied. Cost per message grows with queue_size, not
/// with N. Not thread safe.
template <class Payload>
class ViewSynchronizer
{
public:
  struct Set
  {
    std::int64_t stamp_ns = 0;      ///< the earliest of the set
    std::int64_t spread_ns = 0;     ///< latest minus earliest
    std::vector<Payload> payloads;  ///< one for each view, in the order of the views
  };

  /// @throw InputError if there are no views, no room for a set, or the tolerance is negative
  explicit ViewSynchronizer(const ViewSynchronizerOptions& options) : options_(options)
  {
    if (options.view_count < 1 || options.queue_size < 1 || options.tolerance_ns < 0)
    {
      throw InputError("The synchroniser cannot work with " + std::to_string(options.view_count) +
                       " view(s), a queue of " + std::to_string(options.queue_size) +
                       " set(s) and a tolerance of " + std::to_string(options.tolerance_ns) +
                       " ns; give at least one view, a queue of at least 1 and a tolerance of at least 0.");
    }
    statistics_.views.resize(options.view_count);
  }

  /// Adds a message; returns the set that it completes, if it does.
  /// @pre view < view_count
  std::optional<Set> add(std::size_t view, std::int64_t stamp_ns, Payload payload)
  {
    ViewCounts& counts = statistics_.views[view];
    ++counts.received;
    counts.last_stamp_ns = stamp_ns;
    OpenSet& set = setFor(view, stamp_ns);
    if (set.present[view])
    {
      ++counts.dropped;  // the same stamp again: the newer message replaces the older one
    }
    else
    {
      set.present[view] = true;
      ++set.count;
    }
    set.payloads[view] = std::move(payload);
    set.earliest_ns = std::min(set.earliest_ns, stamp_ns);
    set.latest_ns = std::max(set.latest_ns, stamp_ns);
    return set.count == options_.view_count ? std::optional<Set>(take(set)) : std::nullopt;
  }

  /// Forgets all messages, as if none had been received. The counts stay.
  void reset()
  {
    open_sets_.clear();
    last_stamp_ns_.reset();
  }

  const ViewSynchronizerStatistics& statistics() const { return statistics_; }

private:
  struct OpenSet
  {
    std::int64_t earliest_ns = 0;
    std::int64_t latest_ns = 0;
    std::size_t count = 0;
    std::vector<bool> present;
    std::vector<Payload> payloads;
  };

  /// How far the stamps of a set would spread with one more.
  static std::int64_t spreadWith(const OpenSet& set, std::int64_t stamp_ns)
  {
    return std::max(set.latest_ns, stamp_ns) - std::min(set.earliest_ns, stamp_ns);
  }

  /// Whether a message may join: it repeats the stamp that it replaces, or its place is free and near enough.
  bool admits(const OpenSet& set, std::size_t view, std::int64_t stamp_ns) const
  {
    return set.present[view] ? set.earliest_ns == stamp_ns && set.latest_ns == stamp_ns
                             : spreadWith(set, stamp_ns) <= options_.tolerance_ns;
  }

  /// The nearest open set that admits the message, or a new one.
  OpenSet& setFor(std::size_t view, std::int64_t stamp_ns)
  {
    OpenSet* nearest = nullptr;
    for (OpenSet& set : open_sets_)
    {
      if (admits(set, view, stamp_ns) &&
          (nearest == nullptr || spreadWith(set, stamp_ns) < spreadWith(*nearest, stamp_ns)))
      {
        nearest = &set;
      }
    }
    return nearest != nullptr ? *nearest : begin(stamp_ns);
  }

  OpenSet& begin(std::int64_t stamp_ns)
  {
    if (open_sets_.size() == options_.queue_size)
    {
      drop(open_sets_.begin());
    }
    OpenSet set;
    set.earliest_ns = stamp_ns;
    set.latest_ns = stamp_ns;
    set.present.resize(options_.view_count);
    set.payloads.resize(options_.view_count);
    open_sets_.push_back(std::move(set));
    return open_sets_.back();
  }

  typename std::list<OpenSet>::iterator drop(typename std::list<OpenSet>::iterator set)
  {
    for (std::size_t view = 0; view < options_.view_count; ++view)
    {
      ++(set->present[view] ? statistics_.views[view].dropped : statistics_.views[view].missing);
    }
    ++statistics_.sets_dropped;
    return open_sets_.erase(set);
  }

  Set take(OpenSet& complete)
  {
    Set set;
    set.stamp_ns = complete.earliest_ns;
    set.spread_ns = complete.latest_ns - complete.earliest_ns;
    set.payloads = std::move(complete.payloads);
    const bool jumped = last_stamp_ns_ && set.stamp_ns < *last_stamp_ns_;
    auto open_set = open_sets_.begin();
    while (&*open_set != &complete)
    {
      const bool outdated = jumped || open_set->latest_ns < set.stamp_ns;
      open_set = outdated ? drop(open_set) : std::next(open_set);
    }
    open_sets_.erase(open_set);
    ++statistics_.sets_complete;
    statistics_.time_jumps += jumped ? 1 : 0;
    last_stamp_ns_ = set.stamp_ns;
    return set;
  }

  ViewSynchronizerOptions options_;
  std::list<OpenSet> open_sets_;               ///< in the order in which they were begun
  std::optional<std::int64_t> last_stamp_ns_;  ///< of the last whole set
  ViewSynchronizerStatistics statistics_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H
