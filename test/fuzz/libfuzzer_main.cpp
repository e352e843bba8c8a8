// What libFuzzer calls; the target's harness is chosen when this is compiled.

#include <cstddef>
#include <cstdint>

#include "fuzz/harnesses.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  light_field_depth::fuzz::HARNESSES[FUZZ_HARNESS].run(data, size);
  return 0;
}
