#include "applications/knots/knot_energy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "contact/distances.h"
#include "energy/ipc_barrier.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

static_assert(2 * KnotEnergy::beta == 9, "powers are written as square roots");

struct Edges {
  explicit Edges(const Positions& x) : n(static_cast<Index>(x.cols())), e(3, n), m(3, n), length(n) {
    for (Index i = 0; i < n; ++i) {
      const Index j = (i + 1) % n;
      e.col(i) = x.col(j) - x.col(i);
      m.col(i) = 0.5 * (x.col(j) + x.col(i));
      length[i] = e.col(i).norm();
    }
    total = length.sum();
  }
  Index n;
  Positions e, m;
  Eigen::VectorXd length;
  double total = 0;
};

/// Edges with fewer between them are kept apart by what bends cost, not by the barrier (unit: edges)
constexpr Index barrier_from = 4;

bool touch(Index i, Index j, Index n) {
  return i == j || (i + 1) % n == j || (j + 1) % n == i;
}

}  // namespace

double KnotEnergy::operator()(const Positions& x) const {
  Positions unused;
  return (*this)(x, unused);
}

double KnotEnergy::operator()(const Positions& x, Positions& gradient) const {
  const Edges edges(x);
  const Index n = edges.n;
  // Derivatives by middles and by edge vectors.
  Positions by_m = Positions::Zero(3, n), by_e = Positions::Zero(3, n);
  gradient.setZero(3, n);
  const double activation = barrier_reach * edges.total / n;
  double sum = 0, barriers = 0, barriers_by_total = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j) {
      if (touch(i, j, n)) continue;
      const Vec3 d = edges.m.col(i) - edges.m.col(j), e = edges.e.col(i), f = edges.e.col(j);
      const double r2 = d.squaredNorm(), l = edges.length[i], k = edges.length[j];
      const double power = 1 / (r2 * r2 * std::sqrt(std::sqrt(r2)));  // r^-beta
      const double ed = e.dot(d), fd = f.dot(d);
      // Both orders: l k (r2 - (e.d)^2 / l^2) + k l (r2 - (f.d)^2 / k^2), times r^-beta.
      const double ratio_e = ed / l, ratio_f = fd / k;
      const double both = 2 * r2 - ratio_e * ratio_e - ratio_f * ratio_f;
      const double lk = l * k;
      sum += lk * both * power;
      const Vec3 by_d =
          lk * power * (4 * d - 2 * ratio_e / l * e - 2 * ratio_f / k * f) - lk * both * beta * power / r2 * d;
      by_m.col(i) += by_d;
      by_m.col(j) -= by_d;
      by_e.col(i) += power * (k / l * both * e + lk * (-2 * ratio_e / l * d + 2 * ratio_e * ratio_e / (l * l) * e));
      by_e.col(j) += power * (l / k * both * f + lk * (-2 * ratio_f / k * d + 2 * ratio_f * ratio_f / (k * k) * f));
      const double reach = 0.5 * (l + k) + activation;
      if (r2 >= reach * reach || std::min(j - i, i + n - j) < barrier_from) continue;
      const std::array<Index, 4> v{i, (i + 1) % n, j, (j + 1) % n};
      const Closest closest = closest_edge_edge(x.col(v[0]), x.col(v[1]), x.col(v[2]), x.col(v[3]));
      if (closest.distance >= activation) continue;
      const double y = closest.distance / activation, slope = barrier_weight * barrier_derivative(y);
      barriers += barrier_weight * barrier(y);
      barriers_by_total -= slope * y / edges.total;
      for (int c = 0; c < 4; ++c) gradient.col(v[c]) += slope / activation * closest.weights[c] * closest.direction;
    }
  const double scale = portable::pow(edges.total, beta - 4);
  const double squares = edges.length.squaredNorm();
  const double even = evenness * (n * squares / (edges.total * edges.total) - 1);
  for (Index i = 0; i < n; ++i) {
    const Vec3 direction = edges.e.col(i) / edges.length[i];
    const Vec3 by_edge = scale * by_e.col(i) + (beta - 4) * scale / edges.total * sum * direction +
                         evenness * n *
                             (2 / (edges.total * edges.total) * edges.e.col(i) -
                              2 * squares / (edges.total * edges.total * edges.total) * direction) +
                         barriers_by_total * direction;
    const Vec3 half = 0.5 * scale * by_m.col(i);
    gradient.col(i) += half - by_edge;
    gradient.col((i + 1) % n) += half + by_edge;
  }
  return scale * sum + even + barriers;
}

KnotMetric::KnotMetric(const Positions& x, double evenness) {
  const Edges edges(x);
  const Index n = edges.n;
  // By pairs of edges: differences of derivatives, (u' T)_I - (u' T)_J, and of values. Their weight, r^-(2 sigma + 1)
  // with sigma = (beta - 1) / 2 - 1, is r^-2.5.
  Eigen::MatrixXd of_edges = Eigen::MatrixXd::Zero(n, n), of_middles = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j) {
      if (touch(i, j, n)) continue;
      const Vec3 d = edges.m.col(i) - edges.m.col(j), e = edges.e.col(i) / edges.length[i],
                 f = edges.e.col(j) / edges.length[j];
      const double r2 = d.squaredNorm(), l = edges.length[i], k = edges.length[j];
      const double w = 2 * l * k / (r2 * std::sqrt(std::sqrt(r2)));
      of_edges(i, i) += w / (l * l);
      of_edges(j, j) += w / (k * k);
      of_edges(i, j) -= w * e.dot(f) / (l * k);
      const double both = (2 * r2 - portable::pow(e.dot(d), 2) - portable::pow(f.dot(d), 2)) / (r2 * r2);
      const double v = 0.5 * w * both;
      of_middles(i, i) += v;
      of_middles(j, j) += v;
      of_middles(i, j) -= v;
    }
  const double scale = portable::pow(edges.total, KnotEnergy::beta - 4);
  of_edges *= scale;
  of_middles *= scale;
  for (Index i = 0; i < n; ++i) of_edges(i, i) += 2 * evenness * n / (edges.total * edges.total);
  of_edges = of_edges.selfadjointView<Eigen::Upper>();
  of_middles = of_middles.selfadjointView<Eigen::Upper>();
  Eigen::MatrixXd a(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index p = (i + n - 1) % n, q = (j + n - 1) % n;
      a(i, j) = of_edges(p, q) - of_edges(p, j) - of_edges(i, q) + of_edges(i, j) +
                0.25 * (of_middles(p, q) + of_middles(p, j) + of_middles(i, q) + of_middles(i, j));
    }
  // Translations are in the kernel.
  double trace = 0;
  for (Index i = 0; i < n; ++i) trace += a(i, i);
  a.array() += trace / (static_cast<double>(n) * n);
  factor_.compute(a);
}

Positions KnotMetric::solve(const Positions& v) const {
  Positions result(3, v.cols());
  for (int k = 0; k < 3; ++k) result.row(k) = factor_.solve(Eigen::VectorXd(v.row(k).transpose())).transpose();
  return result;
}

}  // namespace unsnarl
