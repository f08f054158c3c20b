#pragma once

#include <random>

namespace unsnarl {

/// A random number from -1 to 1, the same with every standard library.
inline double uniform(std::mt19937& generator) {
  return static_cast<double>(generator()) / 4294967295.0 * 2 - 1;
}

}  // namespace unsnarl
