#pragma once

#include <cstdint>

namespace unsnarl {

/// What the state of SplitMix64 grows by from number to number.
inline constexpr std::uint64_t splitmix_step = 0x9e3779b97f4a7c15ULL;

/// The number of SplitMix64 (Steele, Lea, Flood 2014) for a state, in [0, 1): the same everywhere, and for states that
/// differ in anything as good as independent. Number k of a list is that for the state k splitmix_step.
constexpr double splitmix_number(std::uint64_t state) {
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

}  // namespace unsnarl
