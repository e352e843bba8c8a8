#include "light_field_depth/ros/tile_splitter.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <sensor_msgs/image_encodings.h>
#include <boost/make_shared.hpp>

#include "light_field_depth/core/error.h"

namespace light_field_depth
{
namespace
{
namespace encodings = sensor_msgs::image_encodings;

std::string sizeText(std::uint32_t width, std::uint32_t height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

std::size_t bytesPerPixel(const std::string& encoding)
{
  constexpr int BITS_PER_BYTE = 8;
  try
  {
    return static_cast<std::size_t>(encodings::numChannels(encoding) * encodings::bitDepth(encoding) /
                                    BITS_PER_BYTE);
  }
  catch (const std::runtime_error&)
  {
    throw InputError("The image of all views has the encoding '" + encoding +
                     "', which is not known; publish mono, bgr, rgb, Bayer or yuv422.");
  }
}

void checkImage(const sensor_msgs::Image& image, const TileGrid& grid, std::size_t pixel_bytes)
{
  const bool in_cells = encodings::isBayer(image.encoding) || image.encoding.rfind("yuv422", 0) == 0;
  const auto columns = static_cast<std::uint32_t>(grid.columns * (in_cells ? 2 : 1));
  const auto rows = static_cast<std::uint32_t>(grid.rows * (encodings::isBayer(image.encoding) ? 2 : 1));
  if (image.width == 0 || image.height == 0 || image.width % columns != 0 || image.height % rows != 0)
  {
    throw InputError("The image of all views is " + sizeText(image.width, image.height) + " pixels of " +
                     image.encoding + ", which " + std::to_string(grid.rows) + " rows and " +
                     std::to_string(grid.columns) +
                     " columns do not divide into equal views; correct 'rows' and 'columns'.");
  }
  if (image.step < image.width * pixel_bytes ||
      image.data.size() <
          static_cast<std::size_t>(image.step) * (image.height - 1) + image.width * pixel_bytes)
  {
    throw InputError("The image of all views has less data than " + sizeText(image.width, image.height) +
                     " pixels of " + image.encoding + " need; correct the driver.");
  }
}

}  // namespace

sensor_msgs::ImagePtr tileOf(const sensor_msgs::Image& image, const TileGrid& grid, int row, int column)
{
  const std::size_t pixel_bytes = bytesPerPixel(image.encoding);
  checkImage(image, grid, pixel_bytes);
  auto tile = boost::make_shared<sensor_msgs::Image>();
  tile->header = image.header;
  tile->encoding = image.encoding;
  tile->is_bigendian = image.is_bigendian;
  tile->width = image.width / static_cast<std::uint32_t>(grid.columns);
  tile->height = image.height / static_cast<std::uint32_t>(grid.rows);
  tile->step = static_cast<std::uint32_t>(tile->width * pixel_bytes);
  tile->data.resize(static_cast<std::size_t>(tile->step) * tile->height);
  const std::uint8_t* const first = image.data.data() +
                                    static_cast<std::size_t>(row) * tile->height * image.step +
                                    static_cast<std::size_t>(column) * tile->step;
  for (std::size_t y = 0; y < tile->height; ++y)
  {
    std::memcpy(tile->data.data() + y * tile->step, first + y * image.step, tile->step);
  }
  return tile;
}

}  // namespace light_field_depth
