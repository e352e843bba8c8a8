#include "light_field_depth/io/image_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "io/jpeg_check.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/core/mask_sources.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
constexpr std::array<std::string_view, 11> EXTENSIONS = {".png", ".jpg", ".jpeg", ".tif",  ".tiff", ".bmp",
                                                         ".pgm", ".ppm", ".pnm",  ".webp", ".exr"};

/// OpenCV reads and writes OpenEXR only when it is told so before the first image; what the user says wins.
const bool OPENEXR_ALLOWED = setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0) == 0;

bool startsWith(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

bool isJpeg(std::string_view content)
{
  return startsWith(content, "\xFF\xD8");
}

/// Decoders fill the rest of a truncated JPEG with grey and call it a success, and complain about a truncated
/// PNG on stderr; so the end of the file is looked at before.
bool isTruncated(std::string_view content)
{
  using namespace std::string_view_literals;
  if (startsWith(content, "\x89PNG"sv))
  {
    return content.rfind("IEND"sv) == std::string_view::npos;
  }
  if (isJpeg(content))
  {
    const std::size_t last_scan = content.rfind("\xFF\xDA"sv);
    const std::size_t end = content.rfind("\xFF\xD9"sv);
    return last_scan == std::string_view::npos || end == std::string_view::npos || end < last_scan;
  }
  return false;
}

cv::Mat decode(const std::string& content, int flags = cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR)
{
  try
  {
    const cv::Mat bytes(1, static_cast<int>(content.size()), CV_8UC1, const_cast<char*>(content.data()));
    return cv::imdecode(bytes, flags);
  }
  catch (const cv::Exception& error)
  {
    if (error.code == cv::Error::StsNoMem)
    {
      throw std::bad_alloc();
    }
    return {};
  }
}

/// Whether it is a PNG whose pixels have an alpha channel.
bool hasAlpha(std::string_view content)
{
  using namespace std::string_view_literals;
  constexpr std::size_t COLOUR_TYPE_AT = 25;
  constexpr char GREY_AND_ALPHA = 4;
  constexpr char COLOUR_AND_ALPHA = 6;
  return startsWith(content, "\x89PNG"sv) && content.size() > COLOUR_TYPE_AT &&
         (content[COLOUR_TYPE_AT] == GREY_AND_ALPHA || content[COLOUR_TYPE_AT] == COLOUR_AND_ALPHA);
}

cv::Mat maskOf(const std::string& content, const cv::Size& size)
{
  const cv::Mat mask = hasAlpha(content) ? alphaMask(decode(content, cv::IMREAD_UNCHANGED)) : cv::Mat();
  return mask.size() == size ? mask : cv::Mat();  // of an image that was turned upright the mask is unknown
}

/// The bytes of an image file. @return false if there is no such format, or it cannot hold the values
bool encode(const std::string& extension, const cv::Mat& image, std::string& content)
{
  std::vector<std::uint8_t> bytes;
  try
  {
    if (!cv::imencode(extension, image, bytes))
    {
      return false;
    }
  }
  catch (const cv::Exception& error)
  {
    if (error.code == cv::Error::StsNoMem)
    {
      throw std::bad_alloc();
    }
    return false;
  }
  content.assign(bytes.begin(), bytes.end());
  return true;
}

}  // namespace

bool isImageFile(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return std::find(EXTENSIONS.begin(), EXTENSIONS.end(), extension) != EXTENSIONS.end();
}

std::string imageFormatsText()
{
  return "PNG, JPEG, TIFF, BMP, PGM, PPM, WebP or EXR";
}

cv::Mat readImage(const std::filesystem::path& path, cv::Mat* mask, double max_megapixels)
{
  const auto require_pixels = [&](const cv::Size& size)
  {
    requirePixels(size, max_megapixels, "The image '" + path.string() + "'",
                  "Reduce it, or raise --max-megapixels.");
  };
  const std::string content = readFile(path);
  if (content.empty())
  {
    throw InputError("The image '" + path.string() + "' is an empty file; copy it again or remove it.");
  }
  if (isTruncated(content))
  {
    throw InputError("The image '" + path.string() +
                     "' is truncated: its end is missing; copy it again or remove it.");
  }
  if (isJpeg(content) && isDamagedJpeg(content))
  {
    throw InputError("The image '" + path.string() +
                     "' is damaged: a part of the picture cannot be decoded; copy it again or remove it.");
  }
  if (const std::optional<cv::Size> size = encodedSize(content))
  {
    require_pixels(*size);
  }
  cv::Mat image = decode(content);
  if (image.empty())
  {
    throw InputError("The image '" + path.string() + "' cannot be decoded as " + imageFormatsText() +
                     "; it is damaged or of another format.");
  }
  require_pixels(image.size());
  if (image.depth() != CV_8U && image.depth() != CV_16U && image.depth() != CV_32F)
  {
    throw InputError("The image '" + path.string() +
                     "' has values that are neither of 8 nor of 16 bits nor single floats; convert it.");
  }
  if (mask != nullptr)
  {
    *mask = maskOf(content, image.size());
  }
  return image;
}

void writeImage(const std::filesystem::path& path, const cv::Mat& image)
{
  std::string content;
  if (!encode(path.extension().string(), image, content))
  {
    throw InputError("The image '" + path.string() + "' cannot be written in this format; choose one of " +
                     imageFormatsText() + ".");
  }
  writeFile(path, content);
}

}  // namespace light_field_depth
