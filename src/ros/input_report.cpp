#include "ros/input_report.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>

namespace light_field_depth
{
namespace
{
/// So many views are named before the rest is only counted.
constexpr std::size_t MAX_NAMED = 4;
constexpr double NANOSECONDS_PER_MILLISECOND = 1e6;

/// " and 3 more ((0, 1), (0, 2), ...)" for all but the first.
std::string others(const ViewArray& array, const std::vector<std::size_t>& views)
{
  if (views.size() < 2)
  {
    return "";
  }
  std::string text = ", and " + std::to_string(views.size() - 1) + " more: ";
  for (std::size_t i = 1; i < std::min(views.size(), MAX_NAMED); ++i)
  {
    text += (i > 1 ? ", " : "") + toString(array.views[views[i]].grid);
  }
  return text + (views.size() > MAX_NAMED ? ", ..." : "");
}

std::vector<std::size_t> silentViews(const ViewSynchronizerStatistics& before,
                                     const ViewSynchronizerStatistics& now)
{
  std::vector<std::size_t> silent;
  for (std::size_t view = 0; view < now.views.size(); ++view)
  {
    if (now.views[view].received == before.views[view].received)
    {
      silent.push_back(view);
    }
  }
  return silent;
}

/// The view whose images came after their sets had been given up, and latest; none if all came in time.
std::optional<std::size_t> latestView(const ViewSynchronizerStatistics& before,
                                      const ViewSynchronizerStatistics& now)
{
  std::optional<std::size_t> latest;
  for (std::size_t view = 0; view < now.views.size(); ++view)
  {
    if (now.views[view].late > before.views[view].late &&
        (!latest || now.views[view].late_by_sets > now.views[*latest].late_by_sets))
    {
      latest = view;
    }
  }
  return latest;
}

std::string stampDifference(const ViewSynchronizerStatistics& statistics)
{
  std::int64_t earliest = std::numeric_limits<std::int64_t>::max();
  std::int64_t latest = std::numeric_limits<std::int64_t>::min();
  for (const ViewCounts& counts : statistics.views)
  {
    earliest = std::min(earliest, counts.last_stamp_ns);
    latest = std::max(latest, counts.last_stamp_ns);
  }
  std::ostringstream text;
  text << static_cast<double>(latest - earliest) / NANOSECONDS_PER_MILLISECOND << " ms";
  return text.str();
}

}  // namespace

std::string diagnoseMissingInput(const ViewArray& array, const ViewSynchronizerStatistics& before,
                                 const ViewSynchronizerStatistics& now,
                                 const std::vector<sensor_msgs::CameraInfoConstPtr>& infos, double seconds,
                                 int queue_size)
{
  std::ostringstream text;
  const std::vector<std::size_t> silent = silentViews(before, now);
  if (silent.size() == array.views.size())
  {
    text << "No images came in the last " << seconds << " s, neither on '" << array.views.front().image
         << "' nor on the topics of the other " << array.views.size() - 1
         << " views; start the cameras or the bag, or correct the topics of 'array'.";
    return text.str();
  }
  if (std::find(silent.begin(), silent.end(), array.reference) != silent.end())
  {
    text << describe(array.views[array.reference]) << ", the reference view: no image came in the last "
         << seconds << " s, and every result belongs to it; bring this camera back, or name another one as "
         << "'reference' of the array.";
    return text.str();
  }
  if (!silent.empty())
  {
    text << describe(array.views[silent.front()]) << ": no image came in the last " << seconds << " s"
         << others(array, silent) << "; start these cameras, or leave these views out of 'array'.";
    return text.str();
  }
  if (now.sets_complete + now.sets_partial == before.sets_complete + before.sets_partial)
  {
    if (const std::optional<std::size_t> late = latestView(before, now))
    {
      text << describe(array.views[*late]) << ": its images have the stamps of the others, but come up to "
           << now.views[*late].late_by_sets << " sets after them, when their set has been given up. Raise "
           << "queue_size (" << queue_size << ") above that, or find out what holds this camera up.";
      return text.str();
    }
    text << "All " << array.views.size()
         << " views send images, but no stamp has come from all of them in the last " << seconds
         << " s; their newest stamps are up to " << stampDifference(now)
         << " apart. Trigger the cameras together, or set sync_tolerance to the difference that is left, in "
            "seconds.";
    return text.str();
  }
  std::vector<std::size_t> uncalibrated;
  for (std::size_t view = 0; view < infos.size(); ++view)
  {
    if (infos[view] == nullptr)
    {
      uncalibrated.push_back(view);
    }
  }
  if (!uncalibrated.empty())
  {
    text << describe(array.views[uncalibrated.front()]) << ": no CameraInfo has come on '"
         << array.views[uncalibrated.front()].camera_info << "'" << others(array, uncalibrated)
         << "; publish it, or set use_camera_info to false and give focal_length and baseline_x.";
  }
  return text.str();
}

std::string describeSilentViews(const ViewArray& array, const std::vector<std::size_t>& silent,
                                double seconds)
{
  std::ostringstream text;
  text << describe(array.views[silent.front()]) << ": no image came in the last " << seconds << " s"
       << others(array, silent) << "; going on with the " << array.views.size() - silent.size() << " of "
       << array.views.size() << " views that are left. Start it again; it is used once it is back.";
  return text.str();
}

}  // namespace light_field_depth
