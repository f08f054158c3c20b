#include "applications/knots/triangles4.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using ExactVec4 = std::array<Rational, 4>;

/// Error of a product of a difference with a number, summed over four coordinates, relative to the sum of magnitudes:
/// each term rounds twice, the sum three times (fixed by float64)
constexpr double sum_of_products_bound = 8 * detail::half_ulp;

/// x . coefficients + constant.
struct LinearForm {
  std::array<Rational, 4> coefficients;
  Rational constant;

  void add_multiple(const LinearForm& other, const Rational& factor) {
    for (int k = 0; k < 4; ++k) coefficients[k] += factor * other.coefficients[k];
    constant += factor * other.constant;
  }
};

/// Whether some x makes all `zero` forms vanish and no form of `not_negative` negative. Equations are solved by
/// elimination, inequalities by that of Fourier and Motzkin, whose growth is small for the half dozen of two triangles.
bool is_feasible(std::vector<LinearForm> zero, std::vector<LinearForm> not_negative) {
  for (std::size_t row = 0; row < zero.size(); ++row) {
    int pivot = 0;
    while (pivot < 4 && zero[row].coefficients[pivot] == 0) ++pivot;
    if (pivot == 4) {
      if (zero[row].constant != 0) return false;
      continue;
    }
    const LinearForm equation = zero[row];
    const auto eliminate = [&](LinearForm& form) {
      if (form.coefficients[pivot] == 0) return;
      form.add_multiple(equation, -form.coefficients[pivot] / equation.coefficients[pivot]);
    };
    for (std::size_t other = row + 1; other < zero.size(); ++other) eliminate(zero[other]);
    for (LinearForm& form : not_negative) eliminate(form);
  }
  for (int k = 0; k < 4; ++k) {
    std::vector<LinearForm> next, lower, upper;
    for (LinearForm& form : not_negative) {
      const int sign = form.coefficients[k].sign();
      (sign == 0 ? next : sign > 0 ? lower : upper).push_back(std::move(form));
    }
    for (const LinearForm& l : lower)
      for (const LinearForm& u : upper) {
        LinearForm sum = l;
        sum.add_multiple(u, -l.coefficients[k] / u.coefficients[k]);
        next.push_back(std::move(sum));
      }
    not_negative = std::move(next);
  }
  return std::all_of(not_negative.begin(), not_negative.end(), [](const LinearForm& f) { return f.constant >= 0; });
}

ExactVec4 difference(const Vec4& a, const Vec4& b) {
  ExactVec4 d;
  for (int k = 0; k < 4; ++k) d[k] = Rational(a[k]) - Rational(b[k]);
  return d;
}

LinearForm unknown(int k, int factor = 1, int constant = 0) {
  LinearForm form;
  form.coefficients[k] = factor;
  form.constant = constant;
  return form;
}

bool meet_exactly(const Triangle4& a, const Triangle4& b, int shared) {
  // a0 + x0 (a1 - a0) + x1 (a2 - a0) = b0 + x2 (b1 - b0) + x3 (b2 - b0), one equation a coordinate.
  const ExactVec4 a1 = difference(a[1], a[0]), a2 = difference(a[2], a[0]);
  const ExactVec4 b1 = difference(b[1], b[0]), b2 = difference(b[2], b[0]), between = difference(a[0], b[0]);
  std::vector<LinearForm> zero(4);
  for (int k = 0; k < 4; ++k) zero[k] = {{a1[k], a2[k], Rational(-b1[k]), Rational(-b2[k])}, between[k]};
  std::vector<LinearForm> not_negative;
  if (shared < 2) {
    for (int k = 0; k < 4; ++k) not_negative.push_back(unknown(k));
    LinearForm sum = unknown(0, -1, 1);  // 1 - x0 - x1
    sum.coefficients[1] = -1;
    not_negative.push_back(sum);
    if (shared == 0) {
      sum = unknown(2, -1, 1);
      sum.coefficients[3] = -1;
      not_negative.push_back(sum);
    } else {
      zero.push_back(
          sum);  // as the cones from the common corner meet in a ray or not at all, one of length 1 is enough
    }
  } else {
    // Beyond the common edge they meet where a2 lies in the half plane of b: x1 = 1, x3 >= 0, x2 arbitrary.
    zero.push_back(unknown(0));
    zero.push_back(unknown(1, -1, 1));
    not_negative.push_back(unknown(3));
  }
  return is_feasible(std::move(zero), std::move(not_negative));
}

/// Whether n . v > 0 for all v, whose coordinates are differences that were rounded once.
bool all_ahead(const Vec4& n, const std::array<Vec4, 9>& v, int count) {
  for (int k = 0; k < count; ++k) {
    const double along = n.dot(v[k]), magnitude = n.cwiseAbs().dot(v[k].cwiseAbs());
    if (!(along > sum_of_products_bound * magnitude && magnitude > detail::underflow_guard)) return false;
  }
  return true;
}

/// Whether a2 and b2 are proven to lie on different sides of the line through the common edge, or not both in one plane
/// with it.
bool is_edge_open(const Triangle4& a, const Triangle4& b) {
  const Vec4 q = a[1] - a[0], p = a[2] - a[0], r = b[2] - a[0];
  // |q|^2 times the product of the parts of p and r across q: negative on different sides.
  const double pr = p.dot(r), qq = q.squaredNorm(), pq = p.dot(q), rq = r.dot(q);
  const double magnitude =
      p.cwiseAbs().dot(r.cwiseAbs()) * qq + p.cwiseAbs().dot(q.cwiseAbs()) * r.cwiseAbs().dot(q.cwiseAbs());
  const double bound = 4 * sum_of_products_bound * magnitude + detail::underflow_guard;
  if (pr * qq - pq * rq < -bound) return true;
  // Not in one plane where a determinant of three coordinates does not vanish.
  for (int skip = 0; skip < 4; ++skip) {
    const int i = (skip + 1) % 4, j = (skip + 2) % 4, k = (skip + 3) % 4;
    const double d1 = q[j] * r[k] - q[k] * r[j], d2 = q[k] * r[i] - q[i] * r[k], d3 = q[i] * r[j] - q[j] * r[i];
    const double m1 = std::abs(q[j] * r[k]) + std::abs(q[k] * r[j]), m2 = std::abs(q[k] * r[i]) + std::abs(q[i] * r[k]),
                 m3 = std::abs(q[i] * r[j]) + std::abs(q[j] * r[i]);
    const double m = std::abs(p[i]) * m1 + std::abs(p[j]) * m2 + std::abs(p[k]) * m3;
    if (std::abs(p[i] * d1 + p[j] * d2 + p[k] * d3) > 4 * sum_of_products_bound * m + detail::underflow_guard)
      return true;
  }
  return false;
}

}  // namespace

Vec4 nearest_to_origin(const std::array<Vec4, 9>& points, int count, std::array<double, 9>& weights) {
  // The corral: corners of a simplex whose inside the nearest point of their affine hull is in.
  std::array<int, 5> corral{};
  std::array<double, 5> weight{};
  int size = 1;
  for (int k = 1; k < count; ++k)
    if (points[k].squaredNorm() < points[corral[0]].squaredNorm()) corral[0] = k;
  weight[0] = 1;
  Vec4 x = points[corral[0]];
  constexpr double rounding_of_x = 1e-12;  ///< Relative error of |x|^2, with a reserve (fixed by float64)
  constexpr double no_weight = 1e-14;      ///< A corner leaves the corral where its weight falls to this (no unit)
  /// Rounds, at most: without rounding a corral does not come twice, and nine points have few (unit: rounds)
  constexpr int most_rounds = 50;
  for (int round = 0; round < most_rounds; ++round) {
    int next = 0;
    for (int k = 1; k < count; ++k)
      if (points[k].dot(x) < points[next].dot(x)) next = k;
    const double xx = x.squaredNorm();
    if (points[next].dot(x) >= xx * (1 - rounding_of_x) || xx == 0 || size == 5) break;
    if (std::find(corral.begin(), corral.begin() + size, next) != corral.begin() + size) break;
    corral[size] = next;
    weight[size++] = 0;
    while (true) {
      // Minimise |sum w p|^2 over sum w = 1.
      Eigen::Matrix<double, 6, 6> system = Eigen::Matrix<double, 6, 6>::Identity();
      Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
      for (int i = 0; i < size; ++i) {
        for (int j = 0; j < size; ++j) system(i, j) = points[corral[i]].dot(points[corral[j]]);
        system(i, 5) = system(5, i) = xx;
      }
      system(5, 5) = 0;
      right[5] = xx;
      const Eigen::Matrix<double, 6, 1> w = system.partialPivLu().solve(right);
      if (!w.allFinite()) break;
      double part = 1;
      for (int i = 0; i < size; ++i)
        if (w[i] <= 0) part = std::min(part, weight[i] / (weight[i] - w[i]));
      bool dropped = false;
      int kept = 0;
      for (int i = 0; i < size; ++i) {
        const double moved = weight[i] + part * (w[i] - weight[i]);
        if (part < 1 && !dropped && w[i] <= 0 && moved <= no_weight) {
          dropped = true;
          continue;
        }
        corral[kept] = corral[i];
        weight[kept++] = std::max(moved, 0.0);
      }
      size = kept;
      if (!dropped) break;
    }
    x.setZero();
    for (int i = 0; i < size; ++i) x += weight[i] * points[corral[i]];
  }
  weights.fill(0);
  for (int i = 0; i < size; ++i) weights[corral[i]] = weight[i];
  return x;
}

bool triangles_meet(const Triangle4& a, const Triangle4& b, int shared) {
  if (shared == 2) return !is_edge_open(a, b) && meet_exactly(a, b, 2);
  std::array<Vec4, 9> v;
  int count = 0;
  if (shared == 0) {
    for (const Vec4& p : a)
      for (const Vec4& q : b) v[count++] = p - q;
  } else {
    for (int k = 1; k < 3; ++k) {
      v[count++] = a[k] - a[0];
      v[count++] = b[0] - b[k];
    }
  }
  Vec4 sum = Vec4::Zero();
  for (int k = 0; k < count; ++k) sum += v[k];
  if (all_ahead(sum, v, count)) return false;
  std::array<double, 9> weights;
  if (all_ahead(nearest_to_origin(v, count, weights), v, count)) return false;
  return meet_exactly(a, b, shared);
}

int crossing_sign(const Triangle4& a, const Triangle4& b) {
  std::array<ExactVec4, 4> m{difference(a[1], a[0]), difference(a[2], a[0]), difference(b[1], b[0]),
                             difference(b[2], b[0])};
  int sign = 1;
  for (int k = 0; k < 4; ++k) {
    int pivot = k;
    while (pivot < 4 && m[pivot][k] == 0) ++pivot;
    if (pivot == 4) return 0;
    if (pivot != k) {
      std::swap(m[pivot], m[k]);
      sign = -sign;
    }
    sign *= m[k][k].sign();
    for (int row = k + 1; row < 4; ++row) {
      const Rational factor = m[row][k] / m[k][k];
      for (int column = k; column < 4; ++column) m[row][column] -= factor * m[k][column];
    }
  }
  return sign;
}

Vec4 crossing_point(const Triangle4& a, const Triangle4& b) {
  Eigen::Matrix4d m;
  m << a[1] - a[0], a[2] - a[0], b[0] - b[1], b[0] - b[2];
  const Vec4 x = m.fullPivLu().solve(b[0] - a[0]);
  return a[0] + x[0] * (a[1] - a[0]) + x[1] * (a[2] - a[0]);
}

}  // namespace unsnarl
