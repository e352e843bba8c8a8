#include "light_field_depth/core/input_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
using namespace std::string_view_literals;

constexpr double PIXELS_PER_MEGAPIXEL = 1e6;
constexpr double BYTES_PER_MB = 1e6;

std::uint32_t byteAt(std::string_view bytes, std::size_t at)
{
  return static_cast<unsigned char>(bytes[at]);
}

/// A number of some bytes, the first of which is the largest. @pre they are there
std::uint32_t bigEndian(std::string_view bytes, std::size_t at, std::size_t count)
{
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    value = value << 8U | byteAt(bytes, at + i);
  }
  return value;
}

std::uint32_t littleEndian(std::string_view bytes, std::size_t at)
{
  return byteAt(bytes, at) | byteAt(bytes, at + 1) << 8U | byteAt(bytes, at + 2) << 16U |
         byteAt(bytes, at + 3) << 24U;
}

std::optional<cv::Size> sizeFrom(std::uint64_t width, std::uint64_t height)
{
  constexpr std::uint64_t MOST = std::numeric_limits<int>::max();
  if (width < 1 || height < 1 || width > MOST || height > MOST)
  {
    return std::nullopt;
  }
  return cv::Size(static_cast<int>(width), static_cast<int>(height));
}

/// The frame header of a JPEG is in one of the segments before the first scan.
std::optional<cv::Size> jpegSize(std::string_view bytes)
{
  constexpr std::uint32_t START_OF_SCAN = 0xDA;
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && byteAt(bytes, at) == 0xFF)
  {
    const std::uint32_t marker = byteAt(bytes, at + 1);
    if (marker == 0xFF)  // fills
    {
      ++at;
      continue;
    }
    // Frames are 0xC0 to 0xCF, but for the tables of Huffman and arithmetic codes and a reserved one.
    if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC)
    {
      return sizeFrom(bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2));
    }
    if (marker == START_OF_SCAN)
    {
      break;
    }
    at += 2 + bigEndian(bytes, at + 2, 2);
  }
  return std::nullopt;
}

/// The next number of a PGM's or PPM's text, after white space and comments. @return false if there is none
bool nextNumber(std::string_view bytes, std::size_t& at, std::uint64_t& number)
{
  constexpr std::uint64_t MOST = 1'000'000'000;
  while (at < bytes.size() && (" \t\r\n"sv.find(bytes[at]) != std::string_view::npos || bytes[at] == '#'))
  {
    at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
  }
  const std::size_t begin = at;
  number = 0;
  for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && number < MOST; ++at)
  {
    number = 10 * number + (byteAt(bytes, at) - '0');
  }
  return at > begin;
}

std::optional<cv::Size> pnmSize(std::string_view bytes)
{
  std::size_t at = 2;
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  if (!nextNumber(bytes, at, width) || !nextNumber(bytes, at, height))
  {
    return std::nullopt;
  }
  return sizeFrom(width, height);
}

/// The height is negative where the rows run downwards.
std::optional<cv::Size> bmpSize(std::string_view bytes)
{
  constexpr std::uint32_t HEADER_OF_OS2 = 12;  // with sides of 16 bits, which cannot be too large
  if (littleEndian(bytes, 14) == HEADER_OF_OS2)
  {
    return std::nullopt;
  }
  const auto height = static_cast<std::int32_t>(littleEndian(bytes, 22));
  return sizeFrom(littleEndian(bytes, 18), static_cast<std::uint64_t>(std::abs(std::int64_t{height})));
}

bool startsWith(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

}  // namespace

void requireViews(std::size_t views, int limit, const std::string& remedy)
{
  if (views > static_cast<std::size_t>(limit))
  {
    throw InputError(std::to_string(views) + " views are too many: " + std::to_string(limit) +
                     " would fit. " + remedy);
  }
}

void requirePixels(const cv::Size& size, double limit_megapixels, const std::string& subject,
                   const std::string& remedy)
{
  const double megapixels = static_cast<double>(size.width) * size.height / PIXELS_PER_MEGAPIXEL;
  if (megapixels <= limit_megapixels)
  {
    return;
  }
  const double scale = std::sqrt(limit_megapixels / megapixels);
  throw InputError(subject + " has " + std::to_string(size.width) + " x " + std::to_string(size.height) +
                   " pixels, which are too many: " + std::to_string(static_cast<int>(scale * size.width)) +
                   " x " + std::to_string(static_cast<int>(scale * size.height)) + " would fit. " + remedy);
}

void requireMessageSize(std::size_t bytes, double limit_mb, const std::string& subject,
                        const std::string& remedy)
{
  const double megabytes = static_cast<double>(bytes) / BYTES_PER_MB;
  if (megabytes > limit_mb)
  {
    throw InputError(subject + " has " + std::to_string(std::lround(std::ceil(megabytes))) +
                     " MB, which are too many: " + std::to_string(std::lround(std::floor(limit_mb))) +
                     " MB would fit. " + remedy);
  }
}

std::optional<cv::Size> encodedSize(std::string_view bytes)
{
  constexpr std::size_t PNG_HEADER = 24;
  constexpr std::size_t BMP_HEADER = 26;
  if (startsWith(bytes, "\x89PNG\r\n\x1A\n"sv) && bytes.size() >= PNG_HEADER)
  {
    return sizeFrom(bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4));
  }
  if (startsWith(bytes, "\xFF\xD8"sv))
  {
    return jpegSize(bytes);
  }
  if (startsWith(bytes, "BM"sv) && bytes.size() >= BMP_HEADER)
  {
    return bmpSize(bytes);
  }
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6')
  {
    return pnmSize(bytes);
  }
  return std::nullopt;
}

}  // namespace light_field_depth
