#include "energy/hessian.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

namespace unsnarl {
namespace {

/// A task of a parallel loop has this many unknowns or terms (unit: unknowns or terms)
constexpr Index chunk = 1024;

/// Added to the diagonal of a block to make it invertible in working precision, where stiff contacts and collapsed
/// faces leave only one direction of it (unit: trace of the block)
constexpr double regularisation = 1e-12;

// The three edge vectors e_k = v_(k+1) - v_k sum to zero, so their squares are those of two orthonormal combinations:
// a = (e_0 - e_1) / sqrt 2 = (2 v_1 - v_0 - v_2) / sqrt 2,  b = (e_0 + e_1 - 2 e_2) / sqrt 6 = 3 (v_2 - v_0) / sqrt 6.
constexpr double combine_a = std::numbers::sqrt2 / 2;  ///< 1 / sqrt 2, the factor of a (fixed by algebra)
constexpr double combine_b = 1.2247448713915890;       ///< 3 / sqrt 6, the factor of b (fixed by algebra)
constexpr double coefficient_a[3] = {-combine_a, 2 * combine_a, -combine_a};
constexpr double coefficient_b[3] = {-combine_b, 0, combine_b};

/// By its Cholesky factor, so that the inverse is positive definite whatever the block's condition; cofactors do not
/// guarantee that around collapsed faces.
Eigen::Matrix3d inverse_of(Eigen::Matrix3d block) {
  block.diagonal().array() += regularisation * block.trace();
  const Eigen::LLT<Eigen::Matrix3d> factor(block);
  if (factor.info() != Eigen::Success) return Vec3(block.diagonal().cwiseInverse()).asDiagonal();
  const Eigen::Matrix3d inverse_factor = factor.matrixL().solve(Eigen::Matrix3d::Identity());
  return inverse_factor.transpose() * inverse_factor;
}

void add_strain(const HessianTerms::Strain& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) {
    if (t.vertices[k] >= 0) {
      corners.col(k) = v.col(t.vertices[k]);
    } else {
      corners.col(k).setZero();
    }
  }
  corners = t.apply(corners);
  for (int k = 0; k < 3; ++k) {
    if (t.vertices[k] >= 0) result.col(t.vertices[k]) += corners.col(k);
  }
}

void add_rank_one(const HessianTerms::RankOne& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
  double dot = 0;
  for (int k = 0; k < 4; ++k) {
    if (t.vertices[k] >= 0) dot += t.g.col(k).dot(v.col(t.vertices[k]));
  }
  dot *= t.stiffness;
  for (int k = 0; k < 4; ++k) {
    if (t.vertices[k] >= 0) result.col(t.vertices[k]) += dot * t.g.col(k);
  }
}

/// The term over the unknowns alone.
HessianTerms::Dense over_unknowns(const HessianTerms::Dense& of_vertices, std::span<const Index> slot) {
  HessianTerms::Dense term;
  term.g.resize(3, of_vertices.g.cols());
  for (std::size_t k = 0; k < of_vertices.vertices.size(); ++k) {
    const Index unknown = slot[of_vertices.vertices[k]];
    if (unknown < 0) continue;
    term.g.col(static_cast<Index>(term.vertices.size())) = of_vertices.g.col(static_cast<Index>(k));
    term.vertices.push_back(unknown);
  }
  term.g.conservativeResize(3, static_cast<Index>(term.vertices.size()));
  term.stiffness = of_vertices.stiffness;
  return term;
}

void add_dense(const HessianTerms::Dense& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
  double dot = 0;
  for (std::size_t k = 0; k < t.vertices.size(); ++k) dot += t.g.col(static_cast<Index>(k)).dot(v.col(t.vertices[k]));
  dot *= t.stiffness;
  for (std::size_t k = 0; k < t.vertices.size(); ++k) result.col(t.vertices[k]) += dot * t.g.col(static_cast<Index>(k));
}

}  // namespace

Eigen::Vector4d HessianTerms::Strain::turn_of(const Eigen::Matrix<double, 2, 3>& e0) {
  const Eigen::Vector2d a = combine_a * (e0.col(0) - e0.col(1));
  const Eigen::Vector2d b = (e0.col(0) + e0.col(1) - 2 * e0.col(2)) * (combine_a / std::numbers::sqrt3);
  return Eigen::Vector4d(-a[1], a[0], -b[1], b[0]).normalized();
}

Eigen::Matrix3d HessianTerms::Strain::apply(const Eigen::Matrix3d& v) const {
  const Vec3 a = combine_a * (2 * v.col(1) - v.col(0) - v.col(2));
  const Vec3 b = combine_b * (v.col(2) - v.col(0));
  const Vec3 p = rotation.col(0), q = rotation.col(1);
  double y[4] = {p.dot(a), q.dot(a), p.dot(b), q.dot(b)};
  const double along = turn[0] * y[0] + turn[1] * y[1] + turn[2] * y[2] + turn[3] * y[3];
  for (int k = 0; k < 4; ++k) y[k] = (1 - uniform) * stiffness * (y[k] - along * turn[k]);
  const Vec3 back_a = y[0] * p + y[1] * q + (uniform * stiffness) * a;
  const Vec3 back_b = y[2] * p + y[3] * q + (uniform * stiffness) * b;
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) result.col(k) = coefficient_a[k] * back_a + coefficient_b[k] * back_b;
  return result;
}

Eigen::Matrix3d HessianTerms::Strain::block(int k, int l) const {
  const double both = coefficient_a[k] * coefficient_a[l] + coefficient_b[k] * coefficient_b[l];
  const auto turn_at = [this](int corner) -> Eigen::Vector2d {
    return coefficient_a[corner] * turn.head<2>() + coefficient_b[corner] * turn.tail<2>();
  };
  const Eigen::Matrix2d in_plane = both * Eigen::Matrix2d::Identity() - turn_at(k) * turn_at(l).transpose();
  return stiffness *
         ((1 - uniform) * rotation * in_plane * rotation.transpose() + uniform * both * Eigen::Matrix3d::Identity());
}

void HessianTerms::clear() {
  diagonals.clear();
  rank_ones.clear();
  strains.clear();
  dense.clear();
}

std::span<HessianTerms> Hessian::begin(std::size_t parts) {
  parts_.resize(parts);
  for (HessianTerms& part : parts_) part.clear();
  return parts_;
}

void Hessian::assemble(std::span<const Index> slot, Index unknowns) {
  diagonal_.assign(static_cast<std::size_t>(unknowns), 0);
  const auto number = [&](auto& terms) {
    for (auto& term : terms)
      for (Index& v : term.vertices)
        if (v >= 0) v = slot[v];
  };
  for (HessianTerms& part : parts_) {
    for (const HessianTerms::Diagonal& term : part.diagonals)
      if (slot[term.vertex] >= 0) diagonal_[slot[term.vertex]] += term.factor;
    number(part.rank_ones);
    number(part.strains);
    for (HessianTerms::Dense& term : part.dense) term = over_unknowns(term, slot);
  }
}

void Hessian::apply(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const {
  const Index n = static_cast<Index>(diagonal_.size());
  for_chunks(n, chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) result.col(i) = diagonal_[i] * v.col(i);
  });
  // One range for all, so that one sum does: the strains of each part, then the others of each.
  std::size_t count = 0;
  for (const HessianTerms& part : parts_) count += part.strains.size() + part.rank_ones.size();
  scattered_(static_cast<Index>(count), 2 * chunk, result, [&](Index begin, Index end, Eigen::Matrix3Xd& out) {
    Index offset = 0;
    const auto add_all = [&](const auto& terms, auto&& add) {
      const Index size = static_cast<Index>(terms.size());
      for (Index k = std::max(begin - offset, Index{0}); k < std::min(end - offset, size); ++k) add(terms[k], v, out);
      offset += size;
    };
    for (const HessianTerms& part : parts_) add_all(part.strains, add_strain);
    for (const HessianTerms& part : parts_) add_all(part.rank_ones, add_rank_one);
  });
  for (const HessianTerms& part : parts_)
    for (const HessianTerms::Dense& t : part.dense) add_dense(t, v, result);
}

Eigen::SparseMatrix<double> Hessian::lower_triangle() const {
  const Index n = static_cast<Index>(diagonal_.size());
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index i, Index j, const Eigen::Matrix3d& block) {
    if (i < j) return;
    for (int c = 0; c < 3; ++c)
      for (int r = i == j ? c : 0; r < 3; ++r) entries.emplace_back(3 * i + r, 3 * j + c, block(r, c));
  };
  for (Index i = 0; i < n; ++i) add(i, i, diagonal_[i] * Eigen::Matrix3d::Identity());
  for (const HessianTerms& part : parts_) {
    for (const HessianTerms::Strain& t : part.strains)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (t.vertices[k] >= 0 && t.vertices[l] >= 0) add(t.vertices[k], t.vertices[l], t.block(k, l));
    for (const HessianTerms::RankOne& t : part.rank_ones)
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l)
          if (t.vertices[k] >= 0 && t.vertices[l] >= 0)
            add(t.vertices[k], t.vertices[l], t.stiffness * t.g.col(k) * t.g.col(l).transpose());
    for (const HessianTerms::Dense& t : part.dense)
      for (std::size_t k = 0; k < t.vertices.size(); ++k)
        for (std::size_t l = 0; l < t.vertices.size(); ++l)
          add(t.vertices[k], t.vertices[l],
              t.stiffness * t.g.col(static_cast<Index>(k)) * t.g.col(static_cast<Index>(l)).transpose());
  }
  Eigen::SparseMatrix<double> result(3 * n, 3 * n);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void Hessian::inverse_blocks(std::vector<Eigen::Matrix3d>& blocks) const {
  const Index n = static_cast<Index>(diagonal_.size());
  blocks.resize(n);
  for (Index i = 0; i < n; ++i) blocks[i] = diagonal_[i] * Eigen::Matrix3d::Identity();
  for (const HessianTerms& part : parts_)
    for (const HessianTerms::Strain& t : part.strains)
      for (int k = 0; k < 3; ++k) {
        if (t.vertices[k] >= 0) blocks[t.vertices[k]] += t.block(k, k);
      }
  for (const HessianTerms& part : parts_)
    for (const HessianTerms::RankOne& t : part.rank_ones)
      for (int k = 0; k < 4; ++k) {
        if (t.vertices[k] >= 0) blocks[t.vertices[k]].noalias() += t.stiffness * t.g.col(k) * t.g.col(k).transpose();
      }
  for (const HessianTerms& part : parts_)
    for (const HessianTerms::Dense& t : part.dense)
      for (std::size_t k = 0; k < t.vertices.size(); ++k) {
        const Vec3 g = t.g.col(static_cast<Index>(k));
        blocks[t.vertices[k]].noalias() += t.stiffness * g * g.transpose();
      }
  for_chunks(n, chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) blocks[i] = inverse_of(blocks[i]);
  });
}

}  // namespace unsnarl
