#include "text/write_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace unsnarl {
namespace {

/// digits[0].digits[1]digits[2]... * 10^exponent
struct Decimal {
  std::string digits;  // without zeros at their end
  int exponent;
};

/// The fewest digits that are read as the same number. Precondition: it is finite and not negative.
template <class Real>
Decimal decimal_of(Real value) {
  Decimal decimal{{}, 0};
  // Without a precision fmt writes the fewest digits, as 1234.5, 0.00012 or 1.2e+30.
  const std::string shortest = fmt::format("{}", value);
  const std::string_view mantissa = std::string_view(shortest).substr(0, shortest.find('e'));
  for (const char c : mantissa)
    if (c != '.') decimal.digits += c;
  const std::size_t zeros = std::min(decimal.digits.find_first_not_of('0'), decimal.digits.size() - 1);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const int exponent_written =
      shortest.size() > mantissa.size() ? std::atoi(shortest.c_str() + mantissa.size() + 1) : 0;
  decimal.exponent = static_cast<int>(point) - 1 - static_cast<int>(zeros) + exponent_written;
  decimal.digits.erase(0, zeros);
  decimal.digits.erase(decimal.digits.find_last_not_of('0') + 1);
  if (decimal.digits.empty()) decimal = {"0", 0};
  return decimal;
}

std::string scientific(const Decimal& decimal) {
  const std::string point = decimal.digits.size() > 1 ? "." : "";
  return fmt::format("{}{}{}e{}{:02}", decimal.digits[0], point, decimal.digits.substr(1),
                     decimal.exponent < 0 ? '-' : '+', std::abs(decimal.exponent));
}

template <class Real>
std::string fixed(const Decimal& decimal, Real value) {
  const int count = static_cast<int>(decimal.digits.size()), decimals = count - 1 - decimal.exponent;
  if (decimals <= 0) return fmt::format("{:.0f}", value);  // a whole number, with all its digits
  if (decimal.exponent < 0)
    return "0." + std::string(static_cast<std::size_t>(-1 - decimal.exponent), '0') + decimal.digits;
  std::string text = decimal.digits;
  return text.insert(static_cast<std::size_t>(decimal.exponent) + 1, ".");
}

}  // namespace

template <class Real>
char* write_number_by_fmt(char* first, Real value) {
  if (!std::isfinite(value)) return fmt::format_to(first, "{}", value);
  if (std::signbit(value)) *first++ = '-';
  const Real size = std::abs(value);
  const Decimal decimal = decimal_of(size);
  std::string shorter = scientific(decimal);
  // A fixed one that is longer for certain is not made.
  if (std::abs(decimal.exponent) < 25)
    if (std::string other = fixed(decimal, size); other.size() <= shorter.size()) shorter = std::move(other);
  return std::copy(shorter.begin(), shorter.end(), first);
}

template char* write_number_by_fmt(char*, double);
template char* write_number_by_fmt(char*, float);

}  // namespace unsnarl
