#include "samples/projective_maps.h"

#include <cmath>
#include <complex>

namespace unsnarl {

Vec3 boy_map(const Vec3& direction) {
  // w and -1 / conj(w) give the same point; the half of the sphere with |w| <= 1 avoids large powers.
  const Vec3 d = direction[2] > 0 ? Vec3(-direction) : direction;
  const std::complex<double> w(d[0] / (1 - d[2]), d[1] / (1 - d[2]));
  const auto w2 = w * w, w3 = w2 * w, w4 = w2 * w2, w6 = w3 * w3;
  const auto below = w6 + std::sqrt(5.0) * w3 - 1.0;
  // Quotients of complex numbers are not the same bits on every machine; this is.
  const auto above_it = [&](const std::complex<double>& above) { return above * std::conj(below) / std::norm(below); };
  const Vec3 g(-1.5 * above_it(w * (1.0 - w4)).imag(), -1.5 * above_it(w * (1.0 + w4)).real(),
               above_it(1.0 + w6).imag() - 0.5);
  const Vec3 p = g / g.squaredNorm();
  return {p[0], -p[2], p[1]};
}

Vec3 cross_cap_map(const Vec3& d) {
  return {2 * d[0] * d[1], d[0] * d[0] - d[1] * d[1], 2 * d[1] * d[2]};
}

Vec3 roman_map(const Vec3& d) {
  return {2 * d[1] * d[2], 2 * d[2] * d[0], 2 * d[0] * d[1]};
}

}  // namespace unsnarl
