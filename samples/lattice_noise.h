#pragma once

#include <cstdint>

namespace unsnarl {

/// Smooth noise in the plane with values in [-1, 1], from random values at integer points blended by quintics. The same
/// on every machine: the hash works on integers only.
double lattice_noise(double x, double y, std::uint32_t seed);

/// A number in [0, 1) for each (seed, index).
double hashed_unit(std::uint32_t seed, std::uint32_t index);

}  // namespace unsnarl
