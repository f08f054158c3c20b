// One target under libFuzzer, which brings main(). UNSNARL_FUZZ_TARGET is its name.
#include <cstddef>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  unsnarl::fuzz::UNSNARL_FUZZ_TARGET({data, size});
  return 0;
}
