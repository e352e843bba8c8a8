#ifndef LIGHT_FIELD_DEPTH_SRC_IO_JPEG_CHECK_H
#define LIGHT_FIELD_DEPTH_SRC_IO_JPEG_CHECK_H

#include <string_view>

namespace light_field_depth
{
/// Whether a JPEG has places that cannot be decoded. Decoders fill them in and go on, and OpenCV does not say
/// so. Costs about a third of decoding. Damage that happens to be a legal code stays unknown, as the format
/// has no checksum.
bool isDamagedJpeg(std::string_view content);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_JPEG_CHECK_H
