#pragma once

#include <cstdio>
#include <cstdlib>

namespace unsnarl::fuzz {

/// Ends the process where a promise is broken, so that the fuzzer keeps the bytes that broke it.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

}  // namespace unsnarl::fuzz
