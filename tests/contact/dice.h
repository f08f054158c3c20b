#pragma once

#include <cstdint>
#include <random>

#include "geometry/types.h"

namespace unsnarl {

/// Random numbers that are the same everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double symmetric() { return 2 * unit() - 1; }
  Vec3 vector() { return {symmetric(), symmetric(), symmetric()}; }
  int integer(int lo, int hi) { return lo + static_cast<int>(engine_() % static_cast<std::uint64_t>(hi - lo + 1)); }
  Vec3 lattice(int n) { return Vec3(integer(-n, n), integer(-n, n), integer(-n, n)); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace unsnarl
