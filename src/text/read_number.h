#pragma once

#include <charconv>
#include <version>

namespace unsnarl {

/// std::from_chars for a number with decimals, which some standard libraries lack (libc++ before 20).
template <class Real>
std::from_chars_result read_number(const char* first, const char* last, Real& value);

#if defined(__cpp_lib_to_chars)
template <class Real>
std::from_chars_result read_number(const char* first, const char* last, Real& value) {
  return std::from_chars(first, last, value);
}
#else
extern template std::from_chars_result read_number(const char*, const char*, double&);
extern template std::from_chars_result read_number(const char*, const char*, float&);
#endif

}  // namespace unsnarl
