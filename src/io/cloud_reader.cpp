#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string>

#include "light_field_depth/core/error.h"
#include "light_field_depth/io/cloud_files.h"
#include "light_field_depth/io/files.h"

namespace light_field_depth
{
namespace
{
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem)
{
  throw InputError("'" + path.string() + "' " + problem);
}

/// Bytes of a property of a type; 0 for types that PLY does not have.
std::size_t bytesOf(const std::string& type)
{
  static const std::map<std::string, std::size_t> bytes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = bytes.find(type);
  return found == bytes.end() ? 0 : found->second;
}

struct Coordinate
{
  std::size_t offset = 0;
  std::size_t bytes = 0;  ///< 4 or 8; 0: not there
};

/// What the header says of the vertices, which must be the first element.
struct Layout
{
  std::size_t vertices = 0;
  std::size_t stride = 0;
  std::array<Coordinate, 3> position;
  std::size_t body = 0;  ///< where the vertices begin
};

void addProperty(const std::filesystem::path& path, const std::string& line, Layout& layout)
{
  std::istringstream words(line);
  std::string word;
  std::string type;
  std::string name;
  words >> word >> type >> name;
  const std::size_t bytes = bytesOf(type);
  if (bytes == 0)
  {
    fail(path, "has a property of type '" + type + "' among its vertices; numbers alone can be read.");
  }
  const std::size_t axis = std::string("xyz").find(name);
  if (name.size() == 1 && axis != std::string::npos && (type[0] == 'f' || type[0] == 'd'))
  {
    layout.position.at(axis) = {layout.stride, bytes};
  }
  layout.stride += bytes;
}

Layout parseHeader(const std::filesystem::path& path, const std::string& content)
{
  Layout layout;
  bool binary = false;
  bool in_vertices = false;
  bool ended = false;
  bool first_element = true;
  std::size_t position = 0;
  while (!ended)
  {
    const std::size_t end = content.find('\n', position);
    if (end == std::string::npos || (position == 0 && content.compare(0, 3, "ply") != 0))
    {
      fail(path, "is not a PLY file, or its header is cut off.");
    }
    std::string line = content.substr(position, end - position);
    position = end + 1;
    if (!line.empty() && line.back() == '\r')
    {
      line.pop_back();
    }
    std::istringstream words(line);
    std::string word;
    std::string second;
    words >> word >> second;
    binary = binary || (word == "format" && second == "binary_little_endian");
    if (word == "element")
    {
      in_vertices = second == "vertex";
      if (in_vertices && !first_element)
      {
        fail(path, "has other elements before its vertices; write the vertices first.");
      }
      first_element = false;
      if (in_vertices)
      {
        words >> layout.vertices;
      }
    }
    else if (word == "property" && in_vertices)
    {
      addProperty(path, line, layout);
    }
    ended = word == "end_header";
  }
  if (!binary)
  {
    fail(path, "is not of the format binary_little_endian; save it as such.");
  }
  layout.body = position;
  return layout;
}

float valueAt(const char* bytes, std::size_t count)
{
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  if (count == sizeof(double))
  {
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<float>(value);
  }
  const auto low = static_cast<std::uint32_t>(bits);
  float value = 0.0F;
  std::memcpy(&value, &low, sizeof value);
  return value;
}

}  // namespace

std::vector<cv::Point3f> readPlyPositions(const std::filesystem::path& path)
{
  const std::string content = readFile(path);
  const Layout layout = parseHeader(path, content);
  const bool complete = std::all_of(layout.position.begin(), layout.position.end(),
                                    [](const Coordinate& coordinate) { return coordinate.bytes != 0; });
  if (!complete)
  {
    fail(path, "has no vertices with x, y and z as float or double.");
  }
  if ((content.size() - layout.body) / layout.stride < layout.vertices)
  {
    fail(path, "says that it has " + std::to_string(layout.vertices) + " vertices of " +
                   std::to_string(layout.stride) +
                   " bytes, but it is shorter; the file is damaged, make it anew.");
  }
  std::vector<cv::Point3f> points(layout.vertices);
  const char* vertex = content.data() + layout.body;
  for (cv::Point3f& point : points)
  {
    const auto at = [&](std::size_t axis)
    { return valueAt(vertex + layout.position.at(axis).offset, layout.position.at(axis).bytes); };
    point = {at(0), at(1), at(2)};
    vertex += layout.stride;
  }
  return points;
}

}  // namespace light_field_depth
