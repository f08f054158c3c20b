#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/scale.h"
#include "geometry/types.h"

namespace unsnarl {

// What a file's numbers can hold, of positions that are at a scale other than the file's (PreparedSurface::scale).

/// Can float32 hold these positions, however coarsely?
inline bool fits_float32(const Positions& x, const Scale& scale) {
  return x.size() == 0 || x.cwiseAbs().maxCoeff() <= scale.in(std::numeric_limits<float>::max());
}
/// Coordinates beyond float32 become its largest number, since predicates need numbers.
inline Positions rounded_to_float32(const Positions& x, const Scale& scale) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (scale.is_one()) return x.cwiseMax(-largest).cwiseMin(largest).cast<float>().cast<double>();
  return x.unaryExpr(
      [&](double number) { return scale.in(static_cast<float>(std::clamp(scale.out(number), -largest, largest))); });
}
/// Rounds those of these numbers of a file that are not what they are in the input (as many).
inline void round_changed_to_float32(std::span<const double> input, std::span<double> numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (numbers[k] != input[k]) numbers[k] = static_cast<double>(static_cast<float>(numbers[k]));
}

/// Distance between neighbouring float32 numbers at the largest coordinate; infinite beyond float32.
inline double float32_unit(double largest_coordinate, const Scale& scale) {
  if (largest_coordinate > scale.in(std::numeric_limits<float>::max())) return std::numeric_limits<double>::infinity();
  return std::max<double>(largest_coordinate * 0x1p-23, scale.in(std::numeric_limits<float>::denorm_min()));
}
inline double float64_unit(double largest_coordinate, const Scale& scale) {
  return std::max(largest_coordinate * 0x1p-52, scale.in(std::numeric_limits<double>::denorm_min()));
}

}  // namespace unsnarl
