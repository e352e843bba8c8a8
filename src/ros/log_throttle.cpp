#include "ros/log_throttle.h"

#include <iterator>

namespace light_field_depth
{
bool LogThrottle::isNews(const std::string& sentence, Time now)
{
  for (auto entry = logged_.begin(); entry != logged_.end();)
  {
    entry = now - entry->second >= REPEAT_AFTER ? logged_.erase(entry) : std::next(entry);
  }
  return logged_.emplace(sentence, now).second;
}

}  // namespace light_field_depth
