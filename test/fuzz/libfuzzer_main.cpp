// What libFuzzer calls; the target's harness is chosen when this is compiled.

#include <cstddef>
#include <cstdint>

#include "fuzz/harnesses.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  // A constant: what the other harnesses need is not linked.
  constexpr light_field_depth::fuzz::Input RUN = light_field_depth::fuzz::HARNESSES[FUZZ_HARNESS].run;
  RUN(data, size);
  return 0;
}
