#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "geometry/bit_cast.h"

namespace unsnarl {

/// A number stored at `from` in the given byte order, which need not be aligned.
template <class T>
T load(const char* from, std::endian order) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), from, sizeof(T));
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  return bit_cast<T>(raw);
}

template <class T>
void store(char* to, T value, std::endian order) {
  auto raw = bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
  std::memcpy(to, raw.data(), sizeof(T));
}

}  // namespace unsnarl
