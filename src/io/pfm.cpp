#include "light_field_depth/io/pfm.h"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "io/number_text.h"
#include "light_field_depth/core/error.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
/// Beyond any camera; keeps width * height * 4 far from overflow.
constexpr std::int64_t MAX_SIDE_PX = 65536;
constexpr std::size_t BYTES_PER_VALUE = sizeof(float);

struct Header
{
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool big_endian = false;
  std::size_t bytes = 0;
};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem)
{
  throw InputError("'" + path.string() + "' " + problem);
}

/// The next word of the header; `position` moves to the white space behind it.
std::string nextWord(const std::string& content, std::size_t& position)
{
  const auto is_space = [&](std::size_t i)
  { return std::isspace(static_cast<unsigned char>(content[i])) != 0; };
  while (position < content.size() && is_space(position))
  {
    ++position;
  }
  const std::size_t begin = position;
  while (position < content.size() && !is_space(position))
  {
    ++position;
  }
  return content.substr(begin, position - begin);
}

Header parseHeader(const std::filesystem::path& path, const std::string& content)
{
  Header header;
  const std::string magic = nextWord(content, header.bytes);
  if (magic == "PF")
  {
    fail(path, "is a PFM with three channels; a disparity map has one ('Pf').");
  }
  if (magic != "Pf")
  {
    fail(path, "is not a PFM file: it does not begin with 'Pf'.");
  }
  const auto width = numberFromText<std::int64_t>(nextWord(content, header.bytes));
  const auto height = numberFromText<std::int64_t>(nextWord(content, header.bytes));
  const auto scale = numberFromText<double>(nextWord(content, header.bytes));
  if (!width || !height || !scale || header.bytes >= content.size())
  {
    fail(path, "has a broken PFM header: width, height and scale must follow 'Pf'.");
  }
  header.width = *width;
  header.height = *height;
  if (header.width < 1 || header.height < 1 || header.width > MAX_SIDE_PX || header.height > MAX_SIDE_PX)
  {
    fail(path, "claims a size of " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                   " pixels; sides of 1 to " + std::to_string(MAX_SIDE_PX) + " pixels can be read.");
  }
  if (!std::isfinite(*scale) || *scale == 0.0)
  {
    fail(path, "has a broken PFM header: the scale must be a number other than 0.");
  }
  header.big_endian = *scale > 0.0;
  ++header.bytes;  // one white space ends the header
  return header;
}

/// The value whose bytes stand at `bytes` in the given order, on a machine of any order.
float decodeValue(const char* bytes, bool big_endian)
{
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < BYTES_PER_VALUE; ++i)
  {
    const std::size_t significance = big_endian ? BYTES_PER_VALUE - 1 - i : i;
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * significance);
  }
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

void encodeLittleEndian(float value, char* bytes)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(value));
  for (std::size_t i = 0; i < BYTES_PER_VALUE; ++i)
  {
    bytes[i] = static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
  }
}

}  // namespace

cv::Mat readPfm(const std::filesystem::path& path)
{
  const std::string content = readFile(path);
  const Header header = parseHeader(path, content);
  const auto wanted = static_cast<std::size_t>(header.width * header.height) * BYTES_PER_VALUE;
  const std::size_t found = content.size() - header.bytes;
  if (found != wanted)
  {
    fail(path, "says that it holds " + std::to_string(header.width) + " x " + std::to_string(header.height) +
                   " values (" + std::to_string(wanted) + " bytes), but " + std::to_string(found) +
                   " bytes follow its header; the file is damaged, make it anew.");
  }
  cv::Mat values(static_cast<int>(header.height), static_cast<int>(header.width), CV_32FC1);
  const char* bytes = content.data() + header.bytes;
  for (int y = values.rows - 1; y >= 0; --y)
  {
    auto* const row = values.ptr<float>(y);
    for (int x = 0; x < values.cols; ++x, bytes += BYTES_PER_VALUE)
    {
      row[x] = decodeValue(bytes, header.big_endian);
    }
  }
  return values;
}

void writePfm(const std::filesystem::path& path, const cv::Mat& values)
{
  CV_Assert(values.type() == CV_32FC1 && !values.empty());
  std::string content = "Pf\n" + std::to_string(values.cols) + " " + std::to_string(values.rows) + "\n-1.0\n";
  std::size_t position = content.size();
  content.resize(position + values.total() * BYTES_PER_VALUE);
  for (int y = values.rows - 1; y >= 0; --y)
  {
    const auto* const row = values.ptr<float>(y);
    for (int x = 0; x < values.cols; ++x, position += BYTES_PER_VALUE)
    {
      encodeLittleEndian(row[x], content.data() + position);
    }
  }
  writeFile(path, content);
}

}  // namespace light_field_depth
