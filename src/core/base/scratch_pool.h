#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_BASE_SCRATCH_POOL_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_BASE_SCRATCH_POOL_H

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace light_field_depth::multiview
{
/// Working memory of the chunks of a loop: as many pieces as chunks were ever at work at once, used again
/// from call to call. Thread safe.
template <typename Scratch>
class ScratchPool
{
public:
  /// Calls body(scratch) with a piece that nobody else uses meanwhile; what is in it is left over. If the
  /// body throws, its piece is let go.
  template <typename Body>
  void use(const Body& body)
  {
    std::unique_ptr<Scratch> scratch = take();
    body(*scratch);
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(scratch));
  }

private:
  std::unique_ptr<Scratch> take()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty())
    {
      return std::make_unique<Scratch>();
    }
    std::unique_ptr<Scratch> scratch = std::move(free_.back());
    free_.pop_back();
    return scratch;
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> free_;
};

}  // namespace light_field_depth::multiview

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_BASE_SCRATCH_POOL_H
