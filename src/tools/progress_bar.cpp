#include "tools/progress_bar.h"

#include <algorithm>
#include <iostream>

#include <unistd.h>

namespace light_field_depth
{
namespace
{
/// Shorter runs show no bar. Set by hand, like its length.
constexpr std::chrono::seconds QUIET_TIME{1};
constexpr std::size_t BAR_LENGTH = 40;
constexpr const char* ERASE_LINE = "\r\033[K";  // ECMA-48: erase to the end of the line
}  // namespace

ProgressBar::ProgressBar()
    : start_(std::chrono::steady_clock::now()), on_terminal_(isatty(STDERR_FILENO) == 1)
{
}

ProgressBar::~ProgressBar()
{
  if (shown_)
  {
    std::cerr << ERASE_LINE << std::flush;
  }
}

void ProgressBar::show(const std::string& stage, double fraction)
{
  if (!on_terminal_ || std::chrono::steady_clock::now() - start_ < QUIET_TIME)
  {
    return;
  }
  shown_ = true;
  const double bounded = std::clamp(fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(bounded * BAR_LENGTH);
  std::cerr << ERASE_LINE << '[' << std::string(filled, '#') << std::string(BAR_LENGTH - filled, ' ') << "] "
            << static_cast<int>(100.0 * bounded) << " % " << stage << std::flush;
}

}  // namespace light_field_depth
