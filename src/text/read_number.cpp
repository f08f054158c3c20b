#include "text/read_number.h"

#if !defined(__cpp_lib_to_chars)

#include <locale.h>
#include <stdlib.h>
#include <cmath>
#if __has_include(<xlocale.h>)  // where <locale.h> has no strtod_l()
#include <xlocale.h>
#endif
#include <string>
#include <string_view>
#include <type_traits>

namespace unsnarl {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The end of [-]digits[.digits][e[+-]digits], or of [-]inf, [-]infinity, [-]nan in any case; `first` if nothing is
/// there.
const char* end_of_number(const char* first, const char* last) {
  const char* at = first;
  if (at != last && *at == '-') ++at;
  for (const std::string_view word : {"infinity", "inf", "nan"}) {
    std::size_t same = 0;
    while (same < word.size() && at + same != last && (at[same] | 0x20) == word[same]) ++same;
    if (same == word.size()) return at + same;
  }
  const auto skip_digits = [&] {
    const char* begin = at;
    while (at != last && is_digit(*at)) ++at;
    return at - begin;
  };
  auto digits = skip_digits();
  if (at != last && *at == '.') {
    ++at;
    digits += skip_digits();
  }
  if (digits == 0) return first;
  const char* const mantissa = at;
  if (at == last || (*at | 0x20) != 'e') return at;
  ++at;
  if (at != last && (*at == '+' || *at == '-')) ++at;
  return skip_digits() > 0 ? at : mantissa;
}

template <class Real>
Real by_c_library(const char* text) {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  if constexpr (std::is_same_v<Real, float>) return strtof_l(text, nullptr, plain);
  return strtod_l(text, nullptr, plain);
}

}  // namespace

template <class Real>
std::from_chars_result read_number(const char* first, const char* last, Real& value) {
  const char* const end = end_of_number(first, last);
  if (end == first) return {first, std::errc::invalid_argument};
  const std::string text(first, end);
  const Real read = by_c_library<Real>(text.c_str());
  const std::string_view mantissa = std::string_view(text).substr(0, text.find_first_of("eE"));
  const bool is_word = mantissa.find_first_of("nN") != std::string_view::npos;
  const bool is_zero = mantissa.find_first_of("123456789") == std::string_view::npos;
  if (!is_word && (std::isinf(read) || (read == 0 && !is_zero))) return {end, std::errc::result_out_of_range};
  value = read;
  return {end, std::errc{}};
}

template std::from_chars_result read_number(const char*, const char*, double&);
template std::from_chars_result read_number(const char*, const char*, float&);

}  // namespace unsnarl

#endif
