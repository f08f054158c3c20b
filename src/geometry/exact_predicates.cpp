// The last resort of the predicates: the coordinates as integers of as many digits as they need.
#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/bit_cast.h"
#include "geometry/predicates.h"

namespace unsnarl::detail {
namespace {

namespace mp = boost::multiprecision;

/// Sign and `bits` binary digits, on the stack; its cost follows the digits that are in use.
template <unsigned bits>
using Integer = mp::number<mp::cpp_int_backend<bits, bits, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;

// Integers that never overflow where coordinates have at most so many binary digits, n. Differences have n + 1, 2 x 2
// minors of these 2 n + 3, and 3 x 3 determinants 3 n + 6.

struct ShortIntegers {
  using Coordinate = std::int64_t;
  __extension__ using Minor = __int128;
  using Determinant = Integer<192>;
  static constexpr int most_bits = 62;  ///< the largest n that these have room for (fixed by the integers; unit: bits)
};
struct MiddleIntegers {
  using Coordinate = Integer<384>;
  using Minor = Coordinate;
  using Determinant = Coordinate;
  static constexpr int most_bits = 126;  ///< the largest n that these have room for (fixed by the integers; unit: bits)
};
/// For all finite doubles: n is 1024 + 1074.
struct LongIntegers {
  using Coordinate = Integer<6400>;
  using Minor = Coordinate;
  using Determinant = Coordinate;
};

/// digits * 2^exponent, exactly. The digits are odd, or zero.
struct Dyadic {
  std::int64_t digits = 0;
  int exponent = 0;
};

// IEEE 754 stores a double as a sign, an exponent and digits.
static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53);
constexpr int stored_bits = 52;  ///< Binary digits that are stored (fixed by float64; unit: bits)
constexpr std::uint64_t hidden_bit = std::uint64_t{1} << stored_bits;  ///< Before these, if normal (fixed by float64)
constexpr int exponent_mask = 0x7ff;  ///< Of the exponent, once shifted down (fixed by float64)
constexpr int exponent_bias = 0x3ff;  ///< What is added to an exponent that is stored (fixed by float64)

Dyadic dyadic_of(double value) {
  const auto bits = bit_cast<std::uint64_t>(value);
  const int exponent = static_cast<int>(bits >> stored_bits) & exponent_mask;
  const std::uint64_t digits = (bits & (hidden_bit - 1)) | (exponent > 0 ? hidden_bit : 0);
  if (digits == 0) return {};
  const int zeros = std::countr_zero(digits);
  const auto odd = static_cast<std::int64_t>(digits >> zeros);
  return {value < 0 ? -odd : odd, std::max(exponent, 1) - exponent_bias - stored_bits + zeros};
}

/// Finite coordinates, in common units: 2^lowest.
template <std::size_t count>
struct Coordinates {
  std::array<Dyadic, count> values;
  int lowest = std::numeric_limits<int>::max();
  int bits = 0;  ///< binary digits of the largest, in these units

  explicit Coordinates(const std::array<double, count>& coordinates) {
    int highest = std::numeric_limits<int>::min();
    for (std::size_t k = 0; k < count; ++k) {
      const Dyadic v = values[k] = dyadic_of(coordinates[k]);
      if (v.digits == 0) continue;
      lowest = std::min(lowest, v.exponent);
      const auto size = static_cast<std::uint64_t>(std::abs(v.digits));
      highest = std::max(highest, v.exponent + static_cast<int>(std::bit_width(size)));
    }
    if (highest > lowest) bits = highest - lowest;
  }

  /// Returns the coordinates as integers, in these units.
  template <class Int>
  std::array<Int, count> as() const {
    std::array<Int, count> result;
    for (std::size_t k = 0; k < count; ++k) {
      result[k] = values[k].digits;
      if (values[k].digits != 0) result[k] <<= values[k].exponent - lowest;
    }
    return result;
  }
};

/// Returns the sign of the determinant of b - a, c - a, d - a.
template <class Integers>
Sign sign_of_determinant(const Coordinates<12>& coordinates) {
  using Int = typename Integers::Coordinate;
  using Determinant = typename Integers::Determinant;
  const std::array<Int, 12> p = coordinates.as<Int>();
  const Int bx = p[3] - p[0], by = p[4] - p[1], bz = p[5] - p[2];
  const Int cx = p[6] - p[0], cy = p[7] - p[1], cz = p[8] - p[2];
  const Int dx = p[9] - p[0], dy = p[10] - p[1], dz = p[11] - p[2];
  const auto minor = [](const Int& i, const Int& j, const Int& k, const Int& l) {
    return Determinant(typename Integers::Minor(i) * l - typename Integers::Minor(j) * k);
  };
  const Determinant sum = minor(cy, cz, dy, dz) * bx + minor(cz, cx, dz, dx) * by + minor(cx, cy, dx, dy) * bz;
  return (sum > 0) - (sum < 0);
}

/// Returns the sign of the determinant of a - c, b - c.
template <class Integers>
Sign sign_of_determinant(const Coordinates<6>& coordinates) {
  using Int = typename Integers::Coordinate;
  using Minor = typename Integers::Minor;
  const std::array<Int, 6> p = coordinates.as<Int>();
  const Int ax = p[0] - p[4], ay = p[1] - p[5], bx = p[2] - p[4], by = p[3] - p[5];
  const Minor area = Minor(ax) * by - Minor(ay) * bx;
  return (area > 0) - (area < 0);
}

/// Computes a sign by the shortest integers that have room. Points that are not finite have sign 0.
template <std::size_t count>
Sign exact_sign(const std::array<double, count>& coordinates) {
  if (!std::all_of(coordinates.begin(), coordinates.end(), [](double v) { return std::isfinite(v); })) return 0;
  const Coordinates<count> p(coordinates);
  if (p.bits <= ShortIntegers::most_bits) return sign_of_determinant<ShortIntegers>(p);
  if (p.bits <= MiddleIntegers::most_bits) return sign_of_determinant<MiddleIntegers>(p);
  return sign_of_determinant<LongIntegers>(p);
}

}  // namespace

Sign orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return exact_sign<12>({a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]});
}

Sign orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy) {
  return exact_sign<6>({ax, ay, bx, by, cx, cy});
}

}  // namespace unsnarl::detail
