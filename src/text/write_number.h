#pragma once

#include <charconv>
#include <version>

namespace unsnarl {

/// Does what write_number() does, by the digits that fmt finds.
template <class Real>
char* write_number_by_fmt(char* first, Real value);
extern template char* write_number_by_fmt(char*, double);
extern template char* write_number_by_fmt(char*, float);

/// std::to_chars for a number with decimals, which some standard libraries lack (libc++ before 14): the fewest
/// characters that are read as the same number, which are 24 at most. Returns their end.
template <class Real>
char* write_number(char* first, char* last, Real value) {
#if defined(__cpp_lib_to_chars)
  return std::to_chars(first, last, value).ptr;
#else
  static_cast<void>(last);
  return write_number_by_fmt(first, value);
#endif
}

}  // namespace unsnarl
