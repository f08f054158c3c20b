#pragma once

#include <cstdint>

#include "geometry/splitmix.h"
#include "geometry/types.h"

namespace unsnarl {

/// Unit-free pseudo-random number in [-1, 1), the same everywhere, for vertex `v`, coordinate `k`.
constexpr double jitter(Index v, int k) {
  return 2 * splitmix_number((static_cast<std::uint64_t>(v) * 3 + static_cast<std::uint64_t>(k) + 1) * splitmix_step) -
         1;
}

}  // namespace unsnarl
