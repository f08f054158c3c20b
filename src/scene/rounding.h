#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "geometry/types.h"

namespace unsnarl {

/// Can float32 hold these positions, however coarsely?
inline bool fits_float32(const Positions& x) {
  return x.size() == 0 || x.cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max();
}
/// Coordinates beyond float32 become its largest number, since predicates need numbers.
inline Positions rounded_to_float32(const Positions& x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return x.cwiseMax(-largest).cwiseMin(largest).cast<float>().cast<double>();
}
/// Rounds those of these numbers that are not what they are in the input (as many).
inline void round_changed_to_float32(std::span<const double> input, std::span<double> numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != input[k]) numbers[k] = static_cast<double>(static_cast<float>(numbers[k]));
}

/// Distance between neighbouring float32 numbers at the largest coordinate; infinite beyond float32.
inline double float32_unit(double largest_coordinate) {
  if (largest_coordinate > std::numeric_limits<float>::max()) return std::numeric_limits<double>::infinity();
  return std::max<double>(largest_coordinate * 0x1p-23, std::numeric_limits<float>::denorm_min());
}
inline double float64_unit(double largest_coordinate) {
  return std::max(largest_coordinate * 0x1p-52, std::numeric_limits<double>::denorm_min());
}

}  // namespace unsnarl
