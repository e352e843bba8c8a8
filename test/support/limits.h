#ifndef LIGHT_FIELD_DEPTH_TEST_SUPPORT_LIMITS_H
#define LIGHT_FIELD_DEPTH_TEST_SUPPORT_LIMITS_H

#include <sys/resource.h>

#include <csignal>

namespace light_field_depth::testing
{
/// While it lives no file grows beyond so many bytes, as on a disk that becomes full.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace light_field_depth::testing

#endif  // LIGHT_FIELD_DEPTH_TEST_SUPPORT_LIMITS_H
