#include "samples/lattice_noise.h"

#include <cmath>

namespace unsnarl {
namespace {

// Finaliser of MurmurHash3 (A. Appleby, public domain).
std::uint32_t mixed(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x85ebca6bU;
  h ^= h >> 13;
  h *= 0xc2b2ae35U;
  return h ^ (h >> 16);
}

double fade(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

}  // namespace

double hashed_unit(std::uint32_t seed, std::uint32_t index) {
  return mixed(mixed(seed + 0x9e3779b9U) ^ (index * 0x9e3779b9U)) / 4294967296.0;
}

double lattice_noise(double x, double y, std::uint32_t seed) {
  const double i = std::floor(x), j = std::floor(y), s = fade(x - i), t = fade(y - j);
  const auto value = [&](double a, double b) {
    const auto row = mixed(static_cast<std::uint32_t>(static_cast<std::int32_t>(b)) + 0x632be5abU);
    return 2 * hashed_unit(seed, row + static_cast<std::uint32_t>(static_cast<std::int32_t>(a))) - 1;
  };
  return (1 - t) * ((1 - s) * value(i, j) + s * value(i + 1, j)) +
         t * ((1 - s) * value(i, j + 1) + s * value(i + 1, j + 1));
}

}  // namespace unsnarl
