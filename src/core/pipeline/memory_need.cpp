#include "light_field_depth/core/memory_need.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/multiview/multiview_estimator.h"
#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
// Peaks of `estimate` over the program's own, by pixel, on scenes of 512 to 2048 pixels a side, 2 to 81 views
// and ranges of 8 to 120 px; ranges have to be allowed for, as they are found only later. Rounded upwards.
constexpr double PROGRAM_BYTES = 70e6;
constexpr double BYTES_OF_SMALL = 460.0;      ///< the widest bands of labels; 253 to 453 were seen
constexpr double BYTES_OF_LARGE = 310.0;      ///< searched from coarse to fine; 245 to 291 were seen
constexpr double BYTES_OF_FAST = 160.0;       ///< 98 to 148 were seen
constexpr double BYTES_OF_PAPER2017 = 100.0;  ///< and, of each view on its lines:
constexpr double BYTES_OF_PAPER2017_VIEW = 39.0;
/// On a row and a column through the reference; 17 x 17 is the largest array of a camera that we know.
constexpr std::size_t MOST_PAPER2017_VIEWS = 33;
/// Of each view, besides its image and the copy with 8 bits a channel.
constexpr double BYTES_OF_VIEW = 4.0;
constexpr double BYTES_OF_DENSE_CLOUD = 530.0;  ///< maps of the other views; 512 were seen
constexpr double BYTES_PER_MB = 1e6;
constexpr int LEAST_SIDE_PX = 16;  ///< of a view

double bytesPerPixel(double pixels, const PipelineOptions& options, const ProductRequest& request,
                     std::size_t views)
{
  double bytes = BYTES_OF_LARGE;
  if (options.method == Method::Paper2017)
  {
    bytes = BYTES_OF_PAPER2017 +
            BYTES_OF_PAPER2017_VIEW * static_cast<double>(std::min(views, MOST_PAPER2017_VIEWS));
  }
  else if (options.multiview.preset == MultiviewPreset::Fast)
  {
    bytes = BYTES_OF_FAST;
  }
  else if (pixels <= MultiviewEstimator::LARGE_PIXELS)
  {
    bytes = BYTES_OF_SMALL;
  }
  return bytes +
         (request.dense_cloud || request.dense_cloud_later || request.view_maps ? BYTES_OF_DENSE_CLOUD : 0.0);
}

std::string amount(double megabytes)
{
  if (megabytes < 1000.0)
  {
    return std::to_string(std::lround(megabytes)) + " MB";
  }
  const std::string text = std::to_string(std::round(megabytes / 10.0) / 100.0);
  return text.substr(0, text.find('.') + 3) + " GB";
}

/// The largest number up to `most` for which `fits` holds, which holds for all smaller ones; 0: none.
template <class Fits>
std::size_t largest(std::size_t most, const Fits& fits)
{
  std::size_t low = 0;
  std::size_t high = most;
  while (low < high)
  {
    const std::size_t middle = low + (high - low + 1) / 2;
    (fits(middle) ? low : high) = fits(middle) ? middle : middle - 1;
  }
  return low;
}

}  // namespace

double memoryNeedMb(const LightFieldShape& shape, const PipelineOptions& options,
                    const ProductRequest& request)
{
  const double pixels = static_cast<double>(shape.size.width) * shape.size.height;
  const double of_view = BYTES_OF_VIEW + static_cast<double>(CV_ELEM_SIZE(shape.type)) +
                         static_cast<double>(CV_MAT_CN(shape.type));
  const double bytes =
      bytesPerPixel(pixels, options, request, shape.views) + of_view * static_cast<double>(shape.views);
  return (PROGRAM_BYTES + pixels * bytes) / BYTES_PER_MB;
}

void requireMemory(const LightFieldShape& shape, const PipelineOptions& options,
                   const ProductRequest& request, double limit_mb, const std::string& remedy)
{
  const double limit = limit_mb > 0.0 ? limit_mb : machineMemoryMb();
  const auto fits = [&](const LightFieldShape& other)
  { return memoryNeedMb(other, options, request) <= limit; };
  if (fits(shape))
  {
    return;
  }
  const std::size_t views = largest(shape.views,
                                    [&](std::size_t count) {
                                      return fits({count, shape.size, shape.type});
                                    });
  const auto scaled = [&](std::size_t width)
  {
    const double height =
        static_cast<double>(shape.size.height) * static_cast<double>(width) / shape.size.width;
    return cv::Size(static_cast<int>(width), static_cast<int>(height));
  };
  const std::size_t width = largest(static_cast<std::size_t>(shape.size.width),
                                    [&](std::size_t count) {
                                      return fits({shape.views, scaled(count), shape.type});
                                    });
  std::string advice;
  if (views >= 2)
  {
    advice = std::to_string(views) + " views of this size would fit";
  }
  if (scaled(width).width >= LEAST_SIDE_PX && scaled(width).height >= LEAST_SIDE_PX)
  {
    advice += std::string(advice.empty() ? "views" : ", or all of them") + " of " +
              std::to_string(scaled(width).width) + " x " + std::to_string(scaled(width).height) + " pixels" +
              (advice.empty() ? " would fit" : "");
  }
  throw InputError(std::to_string(shape.views) + " views of " + std::to_string(shape.size.width) + " x " +
                   std::to_string(shape.size.height) + " pixels may need up to " +
                   amount(memoryNeedMb(shape, options, request)) + ", but " + amount(limit) +
                   " are allowed; " + (advice.empty() ? "no light field would fit" : advice) + ". " + remedy);
}

double machineMemoryMb()
{
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         BYTES_PER_MB;
}

}  // namespace light_field_depth
