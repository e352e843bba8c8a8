#ifndef LIGHT_FIELD_DEPTH_TEST_FUZZ_BYTE_SOURCE_H
#define LIGHT_FIELD_DEPTH_TEST_FUZZ_BYTE_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace light_field_depth::fuzz
{
/// Values out of a block of bytes, zeros behind its end.
class ByteSource
{
public:
  ByteSource(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() { return place_ < size_ ? data_[place_++] : std::uint8_t{0}; }
  /// 0 .. limit - 1
  int below(int limit) { return byte() % limit; }
  bool flag() { return (byte() & 1U) != 0; }

  /// Small numbers mostly, often on a grid, and the odd ones that break programs.
  double number()
  {
    static constexpr double ODD[] = {0.0, 1e-300, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3, 0.03, 0.5,  1.0,
                                     8.0, 100.0,  999.0, 1e4,  1e6,  1e7,  3e9,  1e19, 1e38, 1e300};
    constexpr int ODDITIES = sizeof(ODD) / sizeof(ODD[0]);
    const int kind = below(32);
    const double sign = flag() ? -1.0 : 1.0;
    if (kind < 16)
    {
      return sign * below(9);
    }
    if (kind < 28)
    {
      return sign * (below(9) + byte() / 256.0);
    }
    if (kind < 31)
    {
      return sign * ODD[below(ODDITIES)];
    }
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i)
    {
      bits = bits << 8U | byte();
    }
    double any = 0.0;
    std::memcpy(&any, &bits, sizeof(any));
    return any;
  }

  std::string rest()
  {
    const std::size_t from = place_ < size_ ? place_ : size_;
    place_ = size_;
    return {reinterpret_cast<const char*>(data_) + from, size_ - from};
  }

private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t place_ = 0;
};

}  // namespace light_field_depth::fuzz

#endif  // LIGHT_FIELD_DEPTH_TEST_FUZZ_BYTE_SOURCE_H
