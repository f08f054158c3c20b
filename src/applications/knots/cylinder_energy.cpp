#include "applications/knots/cylinder_energy.h"

#include <algorithm>
#include <cmath>

#include "contact/bvh.h"
#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// Vertices of a ring repel those of this many rings above and below too (unit: rings)
constexpr int rings_near = 1;
/// Points fewer edges than this apart along the ring neither repel nor are penalised (unit: edges)
constexpr Index neighbours = 3;
/// Triangles count as running through each other where |x|^2 is below this (unit: that of the largest difference of
/// corners)
constexpr double touching = 1e-20;

/// Orthogonal to u, v and w, as long as the volume that they span.
Vec4 across(const Vec4& u, const Vec4& v, const Vec4& w) {
  Vec4 n;
  for (int skip = 0; skip < 4; ++skip) {
    const int i = skip == 0 ? 1 : 0, j = skip <= 1 ? 2 : 1, k = skip <= 2 ? 3 : 2;
    const double det =
        u[i] * (v[j] * w[k] - v[k] * w[j]) - u[j] * (v[i] * w[k] - v[k] * w[i]) + u[k] * (v[i] * w[j] - v[j] * w[i]);
    n[skip] = skip % 2 == 0 ? det : -det;
  }
  return n;
}

Index steps_between(Index i, Index j, Index n) {
  const Index d = std::abs(i - j);
  return std::min(d, n - d);
}

}  // namespace

Separation4 separation_of(const Triangle4& a, const Triangle4& b) {
  std::array<Vec4, 9> v;
  double largest = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      v[3 * i + j] = a[i] - b[j];
      largest = std::max(largest, v[3 * i + j].squaredNorm());
    }
  Separation4 made;
  const Vec4 nearest = nearest_to_origin(v, 9, made.weights);
  if (nearest.squaredNorm() > touching * largest) {
    made.distance = nearest.norm();
    made.direction = nearest / made.distance;
    return made;
  }
  double depth = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    for (const Vec4& normal : {across(a[1] - a[0], a[2] - a[0], b[(k + 1) % 3] - b[k]),
                               across(b[1] - b[0], b[2] - b[0], a[(k + 1) % 3] - a[k])}) {
      const double length = normal.norm();
      if (!(length > 0)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Vec4 n = sign / length * normal;
        double reach = -std::numeric_limits<double>::infinity();
        for (const Vec4& p : v) reach = std::max(reach, n.dot(p));
        if (reach < depth) {
          depth = reach;
          made.direction = -n;
        }
      }
    }
  if (!std::isfinite(depth)) return made;  // in one plane
  made.distance = -depth;
  for (Vec4& p : v) p += depth * made.direction;
  nearest_to_origin(v, 9, made.weights);
  return made;
}

CylinderEnergy::CylinderEnergy(std::vector<Positions> rings)
    : rest_(std::move(rings)), n_(static_cast<Index>(rest_.front().cols())), strip_(straight_strip(n_)) {
  for (const Positions& x : {rest_.front(), rest_.back()})
    for (Index k = 0; k < n_; ++k) edge_ += 0.5 / n_ * (x.col((k + 1) % n_) - x.col(k)).norm();
  const auto inner = static_cast<Index>(rest_.size()) - 2;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index r = 0; r < inner; ++r)
    for (Index k = 0; k < n_; ++k) {
      const Index at = r * n_ + k;
      entries.emplace_back(at, at, 4);
      entries.emplace_back(at, r * n_ + (k + 1) % n_, -1);
      entries.emplace_back(at, r * n_ + (k + n_ - 1) % n_, -1);
      if (r > 0) entries.emplace_back(at, at - n_, -1);
      if (r + 1 < inner) entries.emplace_back(at, at + n_, -1);
    }
  Eigen::SparseMatrix<double> laplacian(inner * n_, inner * n_);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(laplacian);
}

std::vector<Positions> CylinderEnergy::rings_at(const Eigen::VectorXd& displacement) const {
  std::vector<Positions> x = rest_;
  for (std::size_t r = 1; r + 1 < x.size(); ++r)
    x[r] += Eigen::Map<const Positions>(displacement.data() + 3 * n_ * (r - 1), 3, n_);
  return x;
}

double CylinderEnergy::gaussians(const std::vector<Positions>& x, std::vector<Positions>& gradient) const {
  const double range = epsilon * edge_, reach = 3 * range;  // e^-9
  double sum = 0;
  for (std::size_t r = 0; r < x.size(); ++r)
    for (std::size_t s = r; s < std::min(x.size(), r + rings_near + 1); ++s) {
      const double height = edge_ * static_cast<double>(s - r);
      for (Index i = 0; i < n_; ++i)
        for (Index j = r == s ? i + 1 : 0; j < n_; ++j) {
          const Index steps = steps_between(i, j, n_);
          if (steps <= neighbours) continue;
          const Vec3 d = x[r].col(i) - x[s].col(j);
          const double squared = d.squaredNorm() + height * height;
          if (squared > reach * reach) continue;
          const double value = gaussian * steps / epsilon * portable::exp(-squared / (range * range));
          sum += value;
          const Vec3 force = -2 * value / (range * range) * d;
          gradient[r].col(i) += force;
          gradient[s].col(j) -= force;
        }
    }
  return sum;
}

double CylinderEnergy::penalties(const std::vector<Positions>& x, std::vector<Positions>& gradient) const {
  const double reach = margin * edge_, weight = penalty / (edge_ * edge_);
  double sum = 0;
  std::vector<Box> boxes(strip_.size());
  for (std::size_t r = 0; r + 1 < x.size(); ++r) {
    for (std::size_t k = 0; k < strip_.size(); ++k) {
      boxes[k] = {};
      for (const Vec4& p : corners_of(strip_[k], x[r], x[r + 1], edge_)) boxes[k].extend(Vec3(p.head<3>()));
      boxes[k] = boxes[k].inflated(0.5 * reach);
    }
    Bvh(boxes).self_pairs([&](Index i, Index j) {
      const StripTriangle &s = strip_[i], &t = strip_[j];
      if (steps_between(s.edge, t.edge, n_) <= neighbours) return;
      const Triangle4 a = corners_of(s, x[r], x[r + 1], edge_), b = corners_of(t, x[r], x[r + 1], edge_);
      const Separation4 apart = separation_of(a, b);
      const double lacking = reach - apart.distance;
      if (lacking <= 0) return;
      sum += weight * lacking * lacking;
      for (int c = 0; c < 3; ++c) {
        double of_a = 0, of_b = 0;
        for (int k = 0; k < 3; ++k) {
          of_a += apart.weights[3 * c + k];
          of_b += apart.weights[3 * k + c];
        }
        const Vec3 push = -2 * weight * lacking * apart.direction.head<3>();
        const auto add = [&](const StripTriangle& triangle, const Vec3& force) {
          const bool below = (c < 2) == triangle.on_lower;
          const Index v = c < 2 ? (triangle.edge + c) % n_ : triangle.apex;
          gradient[below ? r : r + 1].col(v) += force;
        };
        add(s, of_a * push);
        add(t, -of_b * push);
      }
    });
  }
  return sum;
}

double CylinderEnergy::operator()(const Eigen::VectorXd& displacement, Eigen::VectorXd& gradient) const {
  const std::vector<Positions> x = rings_at(displacement);
  std::vector<Positions> by_x(x.size(), Positions::Zero(3, n_));
  double sum = gaussians(x, by_x) + penalties(x, by_x);
  const double weight = membrane / (edge_ * edge_);
  const auto change = [&](std::size_t r, Index k) { return Vec3(x[r].col(k) - rest_[r].col(k)); };
  const auto stretch = [&](std::size_t r, Index k, std::size_t s, Index l) {
    const Vec3 d = change(s, l) - change(r, k);
    sum += weight * d.squaredNorm();
    by_x[r].col(k) -= 2 * weight * d;
    by_x[s].col(l) += 2 * weight * d;
  };
  for (std::size_t r = 0; r < x.size(); ++r)
    for (Index k = 0; k < n_; ++k) {
      stretch(r, k, r, (k + 1) % n_);
      if (r + 1 < x.size()) stretch(r, k, r + 1, k);
    }
  gradient.resize(size());
  for (std::size_t r = 1; r + 1 < x.size(); ++r)
    Eigen::Map<Positions>(gradient.data() + 3 * n_ * (r - 1), 3, n_) = by_x[r];
  return sum;
}

void CylinderEnergy::precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  const Eigen::MatrixXd solved = factor_.solve(Eigen::Map<const Positions>(v.data(), 3, v.size() / 3).transpose()) *
                                 (edge_ * edge_ / (2 * membrane));
  out.resize(v.size());
  Eigen::Map<Positions>(out.data(), 3, v.size() / 3) = solved.transpose();
}

}  // namespace unsnarl
