#ifndef LIGHT_FIELD_DEPTH_CORE_INPUT_LIMITS_H
#define LIGHT_FIELD_DEPTH_CORE_INPUT_LIMITS_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

namespace light_field_depth
{
/// How large an input may be by default: more than any array or camera that we know, and less than fills a
/// machine before anybody has looked at it. The memory of a run has a limit of its own (memory_need.h).
struct InputLimits
{
  /// Of a light field; the largest in use have 17 x 17 = 289 (plenoptic cameras, Stanford's gantry).
  int views = 1024;

  /// Millions of pixels in one image, as it is in its file or message. 289 views of a megapixel in one
  /// picture fit, and the largest sensors of cameras (150).
  double megapixels = 400.0;

  /// Of one message with an image, in MB of 10^6 bytes: ROS itself takes none above 1000.
  double message_mb = 500.0;
};

/// @param remedy ends the sentence: where views are chosen, or the limit is raised
/// @throw InputError that says how many there are and how many would fit
void requireViews(std::size_t views, int limit, const std::string& remedy);

/// @param subject begins the sentence, such as "The image 'a.png'"
/// @throw InputError that says how large it is and which size of that shape would fit
void requirePixels(const cv::Size& size, double limit_megapixels, const std::string& subject,
                   const std::string& remedy);

/// @throw InputError that says how large it is and what would fit
void requireMessageSize(std::size_t bytes, double limit_mb, const std::string& subject,
                        const std::string& remedy);

/// The size of an encoded image by its first bytes, before it is decoded: of a PNG, JPEG, BMP, PGM or PPM.
/// Absent for other formats, and where the bytes do not say.
std::optional<cv::Size> encodedSize(std::string_view bytes);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_INPUT_LIMITS_H
