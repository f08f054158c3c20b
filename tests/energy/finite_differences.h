#pragma once

#include <gtest/gtest.h>

#include <random>

#include "geometry/types.h"

namespace unsnarl {

/// Compares a gradient with central differences of the value, coordinate by coordinate.
template <class Value>
void expect_gradient(Value&& value, const Positions& x, const Positions& gradient, double step, double tolerance) {
  for (Index v = 0; v < x.cols(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      Positions plus = x, minus = x;
      plus(axis, v) += step;
      minus(axis, v) -= step;
      const double difference = (value(plus) - value(minus)) / (2 * step);
      EXPECT_NEAR(gradient(axis, v), difference, tolerance) << "vertex " << v << " axis " << axis;
    }
  }
}

/// Entries uniform in [-1, 1], the same on every machine.
inline Positions random_positions(std::uint64_t seed, Index count) {
  std::mt19937_64 engine(seed);
  Positions x(3, count);
  for (Index v = 0; v < count; ++v)
    for (int axis = 0; axis < 3; ++axis) x(axis, v) = static_cast<double>(engine() >> 11) * 0x1p-52 - 1;
  return x;
}

}  // namespace unsnarl
