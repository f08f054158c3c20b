#pragma once

#include "geometry/types.h"

namespace unsnarl {

inline Positions rounded_to_float32(const Positions& x) {
  return x.cast<float>().cast<double>();
}

/// Distance between neighbouring float32 numbers at the largest coordinate.
inline double float32_unit(double largest_coordinate) {
  return largest_coordinate * 0x1p-23;
}
inline double float64_unit(double largest_coordinate) {
  return largest_coordinate * 0x1p-52;
}

}  // namespace unsnarl
