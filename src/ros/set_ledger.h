#ifndef LIGHT_FIELD_DEPTH_SRC_ROS_SET_LEDGER_H
#define LIGHT_FIELD_DEPTH_SRC_ROS_SET_LEDGER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace light_field_depth
{
/// Which worker has which set, and whose results may be published: those of a set when nothing is awaited of
/// the sets before it. Used under the caller's lock.
class SetLedger
{
public:
  using Time = std::chrono::steady_clock::time_point;
  using Publication = std::function<void()>;

  /// A set whose results are given up.
  struct Lost
  {
    std::size_t worker = 0;
    std::int64_t stamp_ns = 0;
  };

  explicit SetLedger(std::size_t workers) : busy_(workers), last_used_(workers) {}

  /// The worker that has been idle for the longest time. @param alive one for each worker
  std::optional<std::size_t> idleWorker(const std::vector<bool>& alive) const;

  /// @param topics that a result has to have come on before it is whole
  void give(std::size_t worker, std::int64_t stamp_ns, std::set<std::string> topics, Time now);

  /// A result has come. @param publication is called when it is its turn; dropped where its set is unknown or
  /// given up
  void add(std::size_t worker, std::int64_t stamp_ns, const std::string& topic, Publication publication);

  /// The worker has said that it is done with a set: what is still awaited after `grace` does not come.
  void finish(std::size_t worker, std::int64_t stamp_ns, std::chrono::duration<double> grace, Time now);

  /// Gives up the sets of workers that are dead, and those that were given out longer ago than `patience`.
  std::vector<Lost> giveUp(const std::vector<bool>& alive, std::chrono::duration<double> patience, Time now);

  /// What may be published now, in the order of the stamps.
  std::vector<Publication> takeReady();

private:
  struct Entry
  {
    std::size_t worker = 0;
    Time given;
    std::optional<Time> whole_at;  ///< even without what is awaited
    std::set<std::string> awaited;
    std::vector<Publication> publications;
  };

  std::map<std::int64_t, Entry> entries_;  ///< by stamp
  std::vector<bool> busy_;
  std::vector<std::uint64_t> last_used_;  ///< count of sets at that time
  std::uint64_t given_ = 0;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_ROS_SET_LEDGER_H
