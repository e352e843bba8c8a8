#include "io/jpeg_check.h"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <vector>

// After <cstdio>, which they need and do not include.
#include <jerror.h>
#include <jpeglib.h>

namespace light_field_depth
{
namespace
{
/// What libjpeg calls instead of writing to stderr and ending the program.
struct Messages
{
  jpeg_error_mgr manager;  // first: libjpeg knows this part alone
  std::jmp_buf give_up;
  bool damaged;
};

Messages& messagesOf(j_common_ptr common)
{
  return *reinterpret_cast<Messages*>(common->err);
}

[[noreturn]] void onError(j_common_ptr common)
{
  Messages& messages = messagesOf(common);
  messages.damaged = true;
  std::longjmp(messages.give_up, 1);
}

/// Of the warnings some are no damage: bytes to spare, which cameras write, or an unknown Adobe marker.
void onMessage(j_common_ptr common, int level)
{
  if (level >= 0)
  {
    return;
  }
  switch (common->err->msg_code)
  {
    case JWRN_BOGUS_PROGRESSION:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_JPEG_EOF:
    case JWRN_MUST_RESYNC:
      messagesOf(common).damaged = true;
      break;
    default:
      break;
  }
}

void onOutput(j_common_ptr /*common*/) {}

/// Reads an eighth of the picture, for which all codes are read, but little is computed.
void readSmall(jpeg_decompress_struct& picture, std::string_view content, std::vector<JSAMPLE>& row)
{
  jpeg_mem_src(&picture, reinterpret_cast<const unsigned char*>(content.data()), content.size());
  jpeg_read_header(&picture, TRUE);
  picture.scale_num = 1;
  picture.scale_denom = 8;
  jpeg_start_decompress(&picture);
  row.resize(static_cast<std::size_t>(picture.output_width) *
             static_cast<std::size_t>(picture.output_components));
  std::array<JSAMPROW, 1> rows = {row.data()};
  while (picture.output_scanline < picture.output_height &&
         !messagesOf(reinterpret_cast<j_common_ptr>(&picture)).damaged)
  {
    jpeg_read_scanlines(&picture, rows.data(), 1);
  }
}

/// Comes back where libjpeg gives up. All that it leaves behind belongs to the caller.
void readUntilDamaged(jpeg_decompress_struct& picture, Messages& messages, std::string_view content,
                      std::vector<JSAMPLE>& row)
{
  if (setjmp(messages.give_up) == 0)  // libjpeg is C: no exception may pass it
  {
    jpeg_create_decompress(&picture);
    readSmall(picture, content, row);
  }
}

}  // namespace

bool isDamagedJpeg(std::string_view content)
{
  jpeg_decompress_struct picture = {};
  Messages messages = {};
  std::vector<JSAMPLE> row;
  picture.err = jpeg_std_error(&messages.manager);
  messages.manager.error_exit = onError;
  messages.manager.emit_message = onMessage;
  messages.manager.output_message = onOutput;
  readUntilDamaged(picture, messages, content, row);
  jpeg_destroy_decompress(&picture);
  return messages.damaged;
}

}  // namespace light_field_depth
