#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "geometry/bit_cast.h"

/// Elementary functions that give the same bits on every machine. Those of <cmath> differ in the last bit between C
/// libraries, and a repair takes another path from there on. These use additions, products, quotients, square roots and
/// powers of two alone, which IEEE 754 rounds in one way. Errors are below 1 ulp for exp and log, and some ulp for the
/// others where a bound is not given. tests/architecture keeps those of <cmath> out of the project.
namespace unsnarl::portable {

namespace detail {

/// Added to a number and taken away again, rounds it to the nearest integer, halves to even: from 2^52 on doubles are
/// whole (fixed by the format)
inline constexpr double whole_from = 0x1.8p52;

/// Sum of coefficients[k] x^k.
template <std::size_t Count>
inline double polynomial(const double (&coefficients)[Count], double x) {
  double sum = coefficients[Count - 1];
  for (std::size_t k = Count - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

/// Leading part of ln 2; 21 trailing zero bits make its products with exponents exact (fixed by arithmetic)
inline constexpr double ln2_high = 0x1.62e42fee00000p-1;
/// The rest of ln 2 (fixed by arithmetic)
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;

/// 2^k for a normal result: in a double, the exponent with offset 1023 lies above 52 bits.
inline double power_of_two(std::int64_t k) {
  return bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// A turn less whole quarters.
struct QuarterTurn {
  double rest;           ///< in radians, within pi/4 of 0
  std::int64_t quarter;  ///< whole quarter turns, modulo 4
};

inline QuarterTurn reduce(double x) {
  // pi/2 in three parts, each but the last with 20 trailing zero bits: products with up to 2^20 quarters are exact.
  constexpr double high = 0x1.921fb54400000p+0;     // the first part (fixed by arithmetic)
  constexpr double middle = 0x1.0b4611a600000p-34;  // the second part (fixed by arithmetic)
  constexpr double low = 0x1.3198a2e037073p-69;     // the third part (fixed by arithmetic)
  constexpr double most = 0x1p20;                   // larger angles lose whole turns first (fixed by arithmetic)
  if (!(std::abs(x) < most)) x = std::remainder(x, 4 * high);
  const double quarters = (x * (1 / (high + middle)) + whole_from) - whole_from;
  return {((x - quarters * high) - quarters * middle) - quarters * low, static_cast<std::int64_t>(quarters) & 3};
}

/// Within pi/4, by the Taylor series.
inline double sine_near_zero(double x) {
  // Coefficients of (sin x / x - 1) / x^2 in x^2 (fixed by arithmetic)
  constexpr double terms[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  const double z = x * x;
  return x + x * z * polynomial(terms, z);
}
inline double cosine_near_zero(double x) {
  // Coefficients of (cos x - 1 + x^2 / 2) / x^4 in x^2 (fixed by arithmetic)
  constexpr double terms[] = {1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
                              1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  const double z = x * x;
  return 1 - (0.5 * z - z * z * polynomial(terms, z));
}

/// The sine of a turn that is so many quarters further.
inline double sine(const QuarterTurn& turn, int further) {
  const std::int64_t quarter = (turn.quarter + further) & 3;
  const double size = quarter % 2 == 0 ? sine_near_zero(turn.rest) : cosine_near_zero(turn.rest);
  return quarter < 2 ? size : -size;
}

/// The arc tangent for 0 <= x <= 1: a quarter of the angle by its series. tan(a/2) = t / (1 + sqrt(1 + t^2)).
inline double arc_tangent(double x) {
  // Coefficients of (arctan x / x - 1) / x^2 in x^2 (fixed by arithmetic)
  constexpr double terms[] = {-1.0 / 3, 1.0 / 5,   -1.0 / 7, 1.0 / 9,   -1.0 / 11,
                              1.0 / 13, -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21};
  const double half = x / (1 + std::sqrt(1 + x * x)), t = half / (1 + std::sqrt(1 + half * half)), z = t * t;
  return 4 * (t + t * z * polynomial(terms, z));
}

}  // namespace detail

/// e^x: 2^k e^r with |r| <= ln 2 / 2, by the Taylor series of e^r.
inline double exp(double x) {
  using namespace detail;
  constexpr double largest = 709.8;  // results beyond are infinite (fixed by the format)
  constexpr double least = -745.2;   // results below are 0 (fixed by the format)
  if (!(x < largest)) return x >= largest ? std::numeric_limits<double>::infinity() : x;
  if (x < least) return 0;
  // Coefficients of (e^x - 1 - x) / x^2 in x (fixed by arithmetic)
  constexpr double terms[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                              1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                              1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const double k = (x * (1 / (ln2_high + ln2_low)) + whole_from) - whole_from;
  const double r = (x - k * ln2_high) - k * ln2_low;
  const double power = 1 + (r + r * r * polynomial(terms, r));
  const auto exponent = static_cast<std::int64_t>(k), half = exponent / 2;  // 2^k itself may not be a normal number
  return power * power_of_two(half) * power_of_two(exponent - half);
}

/// The natural logarithm: -inf at 0, NaN below. k ln 2 + ln(1 + f) with 1 + f between sqrt(1/2) and sqrt 2, where
/// ln(1 + f) = 2 artanh s with s = f / (2 + f).
inline double log(double x) {
  using namespace detail;
  if (!(x > 0)) return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (x == std::numeric_limits<double>::infinity()) return x;
  constexpr std::int64_t least = 0x3fe6a09e667f3bcd;  // bits of sqrt(1/2)
  std::int64_t k = 0;
  if (x < std::numeric_limits<double>::min()) x *= 0x1p54, k = -54;
  const std::int64_t bits = bit_cast<std::int64_t>(x), exponent = (bits - least) >> 52;
  k += exponent;
  // Coefficients of 2 (artanh s / s - 1) / s^2 in s^2 (fixed by arithmetic)
  constexpr double terms[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                              2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
  const double f = bit_cast<double>(bits - (exponent << 52)) - 1, s = f / (2 + f), z = s * s;
  const auto n = static_cast<double>(k);
  return n * ln2_high - ((s * (f - z * polynomial(terms, z)) - n * ln2_low) - f);
}

/// x^y for x >= 0; 1 for y = 0. Relative error: some |y ln x| ulp.
inline double pow(double x, double y) {
  return y == 0 ? 1 : exp(y * log(x));
}
/// x^n, by squaring.
inline double pow(double x, int n) {
  if (n < 0) return 1 / pow(x, -n);
  double result = 1;
  for (; n > 0; n /= 2, x *= x)
    if (n % 2 != 0) result *= x;
  return result;
}

/// sqrt(x^2 + y^2 + z^2), where no square overflows.
inline double length(double x, double y, double z) {
  return std::sqrt(x * x + y * y + z * z);
}

/// Sine, cosine and tangent of a finite angle in radians.
inline double sin(double x) {
  return detail::sine(detail::reduce(x), 0);
}
inline double cos(double x) {
  return detail::sine(detail::reduce(x), 1);
}
inline double tan(double x) {
  const detail::QuarterTurn turn = detail::reduce(x);
  return detail::sine(turn, 0) / detail::sine(turn, 1);
}

/// The angle of (x, y), finite, from the positive x axis, in [-pi, pi]; signs of zeros count as for std::atan2.
inline double atan2(double y, double x) {
  using std::numbers::pi;
  const double u = std::abs(x), v = std::abs(y);
  double angle = v <= u ? (u == 0 ? 0 : detail::arc_tangent(v / u)) : pi / 2 - detail::arc_tangent(u / v);
  if (std::signbit(x)) angle = pi - angle;
  return std::copysign(angle, y);
}
inline double atan(double x) {
  return atan2(x, 1);
}

/// For -1 <= x <= 1; NaN beyond.
inline double asin(double x) {
  return atan2(x, std::sqrt((1 - x) * (1 + x)));
}
inline double acos(double x) {
  return atan2(std::sqrt((1 - x) * (1 + x)), x);
}

inline double sinh(double x) {
  return 0.5 * (exp(x) - exp(-x));
}
inline double cosh(double x) {
  return 0.5 * (exp(x) + exp(-x));
}

}  // namespace unsnarl::portable
