#pragma once

#include <bit>
#include <initializer_list>
#include <string>
#include <vector>

#include "io/byte_order.h"

namespace unsnarl {

/// The bytes of these numbers, each stored as a T.
template <class T, class Numbers>
std::string packed_all(const Numbers& numbers, std::endian order) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  char* to = bytes.data();
  for (const auto number : numbers) {
    store(to, static_cast<T>(number), order);
    to += sizeof(T);
  }
  return bytes;
}
template <class T>
std::string packed(std::initializer_list<double> numbers, std::endian order) {
  return packed_all<T>(std::vector<double>(numbers), order);
}

}  // namespace unsnarl
