#ifndef LIGHT_FIELD_DEPTH_ROS_TILE_SPLITTER_H
#define LIGHT_FIELD_DEPTH_ROS_TILE_SPLITTER_H

#include <string>

#include <sensor_msgs/Image.h>

namespace light_field_depth
{
/// How many rows and columns of equal views one image holds.
struct TileGrid
{
  int rows = 1;     ///< one below the other
  int columns = 1;  ///< beside each other
};

/// One view of an image that holds many, with its header. The pixels are copied once, as they are.
/// @param row    of the view, from 0
/// @param column of the view, from 0
/// @throw InputError for an image that the grid does not divide into equal views of whole pixels (of whole 2
/// x 2
///   cells for a Bayer pattern, pairs for YUV422), an unknown encoding, or one with too little data
sensor_msgs::ImagePtr tileOf(const sensor_msgs::Image& image, const TileGrid& grid, int row, int column);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_ROS_TILE_SPLITTER_H
