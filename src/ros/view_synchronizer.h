#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <iterator>
#include <limits>
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

  /// Whether the views that are there can stand for all, so that a set without the others may be used; empty:
  /// never.
  std::function<bool(const std::vector<bool>& present)> enough;

  /// Whether a set may also lack views that are not silent (see setSilent()): single images that were lost.
  bool allow_incomplete = false;
};

/// What happened to the messages of one view.
struct ViewCounts
{
  std::uint64_t received = 0;
  std::uint64_t dropped = 0;       ///< received, but in no whole set
  std::uint64_t missing = 0;       ///< sets without a message of this view, dropped or used: who is to blame
  std::int64_t last_stamp_ns = 0;  ///< of the last message; only if received > 0
  std::uint64_t late = 0;          ///< dropped, since their set had been given up or used without them
  std::uint64_t late_by_sets = 0;  ///< at most: how many sets had been begun since then
};

struct ViewSynchronizerStatistics
{
  std::vector<ViewCounts> views;
  std::uint64_t sets_complete = 0;
  std::uint64_t sets_partial = 0;  ///< used without all of their views
  std::uint64_t sets_dropped = 0;  ///< incomplete
  std::uint64_t time_jumps = 0;    ///< whole sets that were older than the one before them
};

/// Brings together the messages of N views that belong to one moment. N is known at run time.
///
/// The views may be ahead of or behind one another. A whole set drops the older sets begun before it. When
/// time jumps back (a bag that loops, a restarted simulation), every view delivers older stamps anew; these
/// make whole sets again without further ado, and the first of them drops what is left from before the jump.
/// A message whose set has been dropped or used without it is dropped, too.
///
/// Where options.enough allows it, a set is used without the views that are said to be silent, as soon as all
/// others are there, and with options.allow_incomplete also without a view that has gone on to a later stamp.
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
    std::vector<Payload> payloads;  ///< one for each view, in the order of the views; Payload() where missing
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
    silent_.resize(options.view_count);
  }

  /// Adds a message; returns the first set that is ready, if one is. The others come from next().
  /// @pre view < view_count
  std::optional<Set> add(std::size_t view, std::int64_t stamp_ns, Payload payload)
  {
    ViewCounts& counts = statistics_.views[view];
    if (counts.received > 0 && stamp_ns < counts.last_stamp_ns)
    {
      gone_.clear();  // time has jumped back: stamps may come again
    }
    ++counts.received;
    counts.last_stamp_ns = stamp_ns;
    silent_[view] = false;
    if (OpenSet* const set = setFor(view, stamp_ns))
    {
      store(*set, view, stamp_ns, std::move(payload));
    }
    useWhatIsReady(view, stamp_ns);
    return next();
  }

  /// The next set that is ready, in the order in which they are to be used.
  std::optional<Set> next()
  {
    if (ready_.empty())
    {
      return std::nullopt;
    }
    std::optional<Set> set(std::move(ready_.front()));
    ready_.pop_front();
    return set;
  }

  /// Says that nothing comes from a view. It is waited for again after its next message. Sets may be ready
  /// now, see next().
  void setSilent(std::size_t view)
  {
    silent_[view] = true;
    useWhatIsReady(view, std::numeric_limits<std::int64_t>::min());
  }

  /// Forgets all messages, as if none had been received. The counts stay.
  void reset()
  {
    open_sets_.clear();
    ready_.clear();
    gone_.clear();
    silent_.assign(options_.view_count, false);
    last_stamp_ns_.reset();
  }

  const ViewSynchronizerStatistics& statistics() const { return statistics_; }

private:
  struct OpenSet
  {
    std::int64_t earliest_ns = 0;
    std::int64_t latest_ns = 0;
    std::size_t count = 0;
    std::uint64_t ordinal = 0;  ///< how many sets had been begun before
    std::vector<bool> present;
    std::vector<bool> passed;  ///< views that have gone on to a later stamp
    std::vector<Payload> payloads;
  };

  /// A set that was dropped or used with views missing.
  struct GoneSet
  {
    std::int64_t earliest_ns;
    std::int64_t latest_ns;
    std::uint64_t ordinal;
    std::vector<bool> present;
  };
  /// So many are remembered: a view that is later by more is out of anybody's patience.
  static constexpr std::size_t MAX_GONE = 256;

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

  /// The nearest open set that admits the message, or a new one; nullptr if the message comes too late.
  OpenSet* setFor(std::size_t view, std::int64_t stamp_ns)
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
    if (nearest != nullptr)
    {
      return nearest;
    }
    return isLate(view, stamp_ns) ? nullptr : &begin(stamp_ns);
  }

  bool isLate(std::size_t view, std::int64_t stamp_ns)
  {
    for (const GoneSet& set : gone_)
    {
      const std::int64_t spread = std::max(set.latest_ns, stamp_ns) - std::min(set.earliest_ns, stamp_ns);
      if (!set.present[view] && spread <= options_.tolerance_ns)
      {
        ViewCounts& counts = statistics_.views[view];
        ++counts.dropped;
        ++counts.late;
        counts.late_by_sets = std::max(counts.late_by_sets, sets_begun_ - set.ordinal);
        return true;
      }
    }
    return false;
  }

  void store(OpenSet& set, std::size_t view, std::int64_t stamp_ns, Payload payload)
  {
    if (set.present[view])
    {
      ++statistics_.views[view].dropped;  // the same stamp again: the newer message replaces the older one
    }
    else
    {
      set.present[view] = true;
      ++set.count;
    }
    set.payloads[view] = std::move(payload);
    set.earliest_ns = std::min(set.earliest_ns, stamp_ns);
    set.latest_ns = std::max(set.latest_ns, stamp_ns);
  }

  /// After a view has sent a stamp, or become silent: takes the sets that need not wait for anything.
  void useWhatIsReady(std::size_t view, std::int64_t stamp_ns)
  {
    for (auto set = open_sets_.begin(); set != open_sets_.end();)
    {
      set->passed[view] = set->passed[view] || set->latest_ns < stamp_ns;
      const auto following = std::next(set);
      if (isReady(*set))
      {
        take(*set);
        set = open_sets_.begin();  // others may have gone with it
      }
      else
      {
        set = following;
      }
    }
  }

  bool isReady(const OpenSet& set) const
  {
    if (set.count == options_.view_count || !options_.enough)
    {
      return set.count == options_.view_count;
    }
    for (std::size_t view = 0; view < options_.view_count; ++view)
    {
      const bool given_up = silent_[view] || (options_.allow_incomplete && set.passed[view]);
      if (!set.present[view] && !given_up)
      {
        return false;
      }
    }
    return options_.enough(set.present);
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
    set.ordinal = sets_begun_++;
    set.present.resize(options_.view_count);
    set.passed.resize(options_.view_count);
    set.payloads.resize(options_.view_count);
    open_sets_.push_back(std::move(set));
    return open_sets_.back();
  }

  void remember(OpenSet& set)
  {
    gone_.push_back({set.earliest_ns, set.latest_ns, set.ordinal, std::move(set.present)});
    if (gone_.size() > MAX_GONE)
    {
      gone_.pop_front();
    }
  }

  typename std::list<OpenSet>::iterator drop(typename std::list<OpenSet>::iterator set)
  {
    for (std::size_t view = 0; view < options_.view_count; ++view)
    {
      ++(set->present[view] ? statistics_.views[view].dropped : statistics_.views[view].missing);
    }
    ++statistics_.sets_dropped;
    remember(*set);
    return open_sets_.erase(set);
  }

  /// Uses a set, whole or not, and drops what is outdated by it.
  void take(OpenSet& used)
  {
    Set set;
    set.stamp_ns = used.earliest_ns;
    set.spread_ns = used.latest_ns - used.earliest_ns;
    set.payloads = std::move(used.payloads);
    const bool jumped = last_stamp_ns_ && set.stamp_ns < *last_stamp_ns_;
    auto open_set = open_sets_.begin();
    while (&*open_set != &used)
    {
      const bool outdated = jumped || open_set->latest_ns < set.stamp_ns;
      open_set = outdated ? drop(open_set) : std::next(open_set);
    }
    const bool whole = used.count == options_.view_count;
    ++(whole ? statistics_.sets_complete : statistics_.sets_partial);
    if (!whole)
    {
      for (std::size_t view = 0; view < options_.view_count; ++view)
      {
        statistics_.views[view].missing += used.present[view] ? 0 : 1;
      }
      remember(used);
    }
    open_sets_.erase(open_set);
    statistics_.time_jumps += jumped ? 1 : 0;
    last_stamp_ns_ = set.stamp_ns;
    ready_.push_back(std::move(set));
  }

  ViewSynchronizerOptions options_;
  std::list<OpenSet> open_sets_;  ///< in the order in which they were begun
  std::uint64_t sets_begun_ = 0;
  std::deque<GoneSet> gone_;
  std::deque<Set> ready_;
  std::vector<bool> silent_;                   ///< one for each view
  std::optional<std::int64_t> last_stamp_ns_;  ///< of the last whole set
  ViewSynchronizerStatistics statistics_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_VIEW_SYNCHRONIZER_H
