#include "applications/isotopy/annulus_energy.h"

#include <algorithm>
#include <cmath>

#include "applications/curves/repel_curves.h"
#include "energy/gaussian_contact.h"

namespace unsnarl {
namespace {

/// Points of one polygon fewer edges than this apart do not repel each other (unit: edges)
constexpr Index steps_apart = 3;
/// Points farther apart than this do not repel each other: e^-4 (unit: ranges)
constexpr double seen_ranges = 2;

}  // namespace

AnnulusEnergy::AnnulusEnergy(std::vector<Polygons> rings) : net_(net_of(rings.front())), tree_(net_) {
  n_ = net_.vertex_count();
  for (const Polygons& ring : rings) rest_.push_back(joined_points(ring));
  for (const Points2& x : {rest_.front(), rest_.back()})
    for (const auto& [a, b] : net_.segments) edge_ += 0.5 / n_ * (x.col(b) - x.col(a)).norm();

  const auto inner = static_cast<Index>(rest_.size()) - 2;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index r = 0; r < inner; ++r)
    for (Index k = 0; k < n_; ++k) {
      const Index at = r * n_ + k, beside = r * n_ + net_.segments[k][1];
      entries.emplace_back(at, at, 4);
      entries.emplace_back(at, beside, -1);
      entries.emplace_back(beside, at, -1);
      if (r > 0) entries.emplace_back(at, at - n_, -1);
      if (r + 1 < inner) entries.emplace_back(at, at + n_, -1);
    }
  Eigen::SparseMatrix<double> laplacian(inner * n_, inner * n_);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(laplacian);
}

std::vector<Polygons> AnnulusEnergy::rings_at(const Eigen::VectorXd& displacement) const {
  std::vector<Polygons> rings;
  for (std::size_t r = 0; r < rest_.size(); ++r) {
    Points2 x = rest_[r];
    if (r > 0 && r + 1 < rest_.size())
      x += Eigen::Map<const Points2>(displacement.data() + 2 * n_ * (static_cast<Index>(r) - 1), 2, n_);
    Polygons& ring = rings.emplace_back();
    for (const CurveNet::Chain& chain : net_.chains) ring.push_back(x.middleCols(chain.first_segment, chain.size()));
  }
  return rings;
}

double AnnulusEnergy::gaussians(const Points2& x, Points2& gradient) const {
  const double reach = range * edge_;
  GaussianContact<2> contact;
  contact.squared_bandwidth.assign(n_, reach * reach);
  contact.exponent = 2;
  for (const auto& [i, j] : pairs_within<2>(x, seen_ranges * reach)) {
    double along = 1;
    if (net_.chain_of[i] == net_.chain_of[j]) {
      const Index n = net_.chains[net_.chain_of[i]].size(), between = std::abs(i - j);
      const Index steps = std::min(between, n - between);
      if (steps <= steps_apart) continue;
      along = std::min(1.0, steps / (seen_ranges * range));
    }
    contact.pairs.push_back({i, j, along * reach * reach});
  }
  return contact.value_and_gradient(x, gradient, gaussian);
}

double AnnulusEnergy::penalties(const Points2& x, Points2& gradient) {
  const double weight = penalty / edge_;
  double sum = 0;
  tree_.refit(x);
  tree_.pairs_within(0, [&](Index i, Index j) {
    const Edge &a = net_.segments[i], &b = net_.segments[j];
    if (a[0] == b[1] || a[1] == b[0]) return;
    const SegmentPenetration p = segment_penetration(x.col(a[0]), x.col(a[1]), x.col(b[0]), x.col(b[1]));
    if (p.depth <= 0) return;
    sum += weight * (p.depth + overshoot * edge_);
    for (int k = 0; k < 2; ++k) {
      gradient.col(a[k]) -= weight * p.weight_a[k] * p.normal;
      gradient.col(b[k]) += weight * p.weight_b[k] * p.normal;
    }
  });
  return sum;
}

double AnnulusEnergy::operator()(const Eigen::VectorXd& displacement, Eigen::VectorXd& gradient) {
  std::vector<Points2> x = rest_;
  for (std::size_t r = 1; r + 1 < x.size(); ++r)
    x[r] += Eigen::Map<const Points2>(displacement.data() + 2 * n_ * (static_cast<Index>(r) - 1), 2, n_);
  std::vector<Points2> by_x(x.size(), Points2::Zero(2, n_));
  double sum = 0;
  for (std::size_t r = 1; r + 1 < x.size(); ++r) sum += gaussians(x[r], by_x[r]) + penalties(x[r], by_x[r]);
  const double weight = membrane / (edge_ * edge_);
  const auto stretch = [&](std::size_t r, Index k, std::size_t s, Index l) {
    const Vec2 d = (x[s].col(l) - rest_[s].col(l)) - (x[r].col(k) - rest_[r].col(k));
    sum += weight * d.squaredNorm();
    by_x[r].col(k) -= 2 * weight * d;
    by_x[s].col(l) += 2 * weight * d;
  };
  for (std::size_t r = 0; r < x.size(); ++r)
    for (Index k = 0; k < n_; ++k) {
      stretch(r, k, r, net_.segments[k][1]);
      if (r + 1 < x.size()) stretch(r, k, r + 1, k);
    }
  gradient.resize(size());
  for (std::size_t r = 1; r + 1 < x.size(); ++r)
    Eigen::Map<Points2>(gradient.data() + 2 * n_ * (static_cast<Index>(r) - 1), 2, n_) = by_x[r];
  return sum;
}

void AnnulusEnergy::precondition(const Eigen::VectorXd& v, Eigen::VectorXd& out) const {
  const Eigen::MatrixXd solved = factor_.solve(Eigen::Map<const Points2>(v.data(), 2, v.size() / 2).transpose()) *
                                 (edge_ * edge_ / (2 * membrane));
  out.resize(v.size());
  Eigen::Map<Points2>(out.data(), 2, v.size() / 2) = solved.transpose();
}

}  // namespace unsnarl
