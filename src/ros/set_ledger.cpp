#include "ros/set_ledger.h"

#include <utility>

namespace light_field_depth
{
std::optional<std::size_t> SetLedger::idleWorker(const std::vector<bool>& alive) const
{
  std::optional<std::size_t> longest;
  for (std::size_t worker = 0; worker < busy_.size(); ++worker)
  {
    if (alive[worker] && !busy_[worker] && (!longest || last_used_[worker] < last_used_[*longest]))
    {
      longest = worker;
    }
  }
  return longest;
}

void SetLedger::give(std::size_t worker, std::int64_t stamp_ns, std::set<std::string> topics, Time now)
{
  busy_[worker] = true;
  last_used_[worker] = ++given_;
  entries_[stamp_ns] = {worker, now, std::nullopt, std::move(topics), {}};
}

void SetLedger::add(std::size_t worker, std::int64_t stamp_ns, const std::string& topic,
                    Publication publication)
{
  const auto entry = entries_.find(stamp_ns);
  if (entry == entries_.end() || entry->second.worker != worker || entry->second.awaited.erase(topic) == 0)
  {
    return;
  }
  entry->second.publications.push_back(std::move(publication));
  if (entry->second.awaited.empty())
  {
    busy_[worker] = false;
  }
}

void SetLedger::finish(std::size_t worker, std::int64_t stamp_ns, std::chrono::duration<double> grace,
                       Time now)
{
  const auto entry = entries_.find(stamp_ns);
  if (entry != entries_.end() && entry->second.worker == worker)
  {
    entry->second.whole_at = now + std::chrono::duration_cast<Time::duration>(grace);
  }
}

std::vector<SetLedger::Lost> SetLedger::giveUp(const std::vector<bool>& alive,
                                               std::chrono::duration<double> patience, Time now)
{
  std::vector<Lost> lost;
  for (auto entry = entries_.begin(); entry != entries_.end();)
  {
    const std::size_t worker = entry->second.worker;
    if (entry->second.whole_at && now >= *entry->second.whole_at)
    {
      busy_[worker] = busy_[worker] && entry->second.awaited.empty();
      entry->second.awaited.clear();
    }
    if (!entry->second.awaited.empty() && (!alive[worker] || now - entry->second.given > patience))
    {
      lost.push_back({worker, entry->first});
      busy_[worker] = false;
      entry = entries_.erase(entry);
    }
    else
    {
      ++entry;
    }
  }
  return lost;
}

std::vector<SetLedger::Publication> SetLedger::takeReady()
{
  std::vector<Publication> ready;
  while (!entries_.empty() && entries_.begin()->second.awaited.empty())
  {
    for (Publication& publication : entries_.begin()->second.publications)
    {
      ready.push_back(std::move(publication));
    }
    entries_.erase(entries_.begin());
  }
  return ready;
}

}  // namespace light_field_depth
