#ifndef LIGHT_FIELD_DEPTH_SRC_IO_LITTLE_ENDIAN_H
#define LIGHT_FIELD_DEPTH_SRC_IO_LITTLE_ENDIAN_H

#include <cstdint>
#include <cstring>
#include <string>

namespace light_field_depth
{
/// Appends the four bytes of a float, the least significant first, on any machine.
inline void appendLittleEndian(std::string& bytes, float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8)
  {
    bytes += static_cast<char>((bits >> shift) & 0xFFU);
  }
}

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_LITTLE_ENDIAN_H
