#include "recover/step_operator.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace unsnarl {
namespace {

constexpr Index chunk = 1024;  // rows, strains or terms a task

/// Share of its trace that is added to a block, so that it has an inverse to working precision: stiff contacts and
/// collapsed faces leave only one direction of it.
constexpr double regularisation = 1e-12;

/// Through its Cholesky factor: positive definite whatever the block's condition. (With cofactors it was not, around
/// collapsed faces, and no step was taken at all.)
Eigen::Matrix3d inverse_of(Eigen::Matrix3d block) {
  block.diagonal().array() += regularisation * block.trace();
  const Eigen::LLT<Eigen::Matrix3d> factor(block);
  if (factor.info() != Eigen::Success) return Vec3(block.diagonal().cwiseInverse()).asDiagonal();
  const Eigen::Matrix3d inverse_factor = factor.matrixL().solve(Eigen::Matrix3d::Identity());
  return inverse_factor.transpose() * inverse_factor;
}

void add_strain(const StepOperator::Strained& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) {
    if (t.slot[k] >= 0) {
      corners.col(k) = t.stiffness * v.col(t.slot[k]);
    } else {
      corners.col(k).setZero();
    }
  }
  corners = t.strain.apply(corners);
  for (int k = 0; k < 3; ++k) {
    if (t.slot[k] >= 0) result.col(t.slot[k]) += corners.col(k);
  }
}

void add_term(const StepOperator::RankOne& t, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) {
  double dot = 0;
  for (int k = 0; k < 4; ++k) {
    if (t.slot[k] >= 0) dot += t.g.col(k).dot(v.col(t.slot[k]));
  }
  dot *= t.stiffness;
  for (int k = 0; k < 4; ++k) {
    if (t.slot[k] >= 0) result.col(t.slot[k]) += dot * t.g.col(k);
  }
}

}  // namespace

void StepOperator::apply(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const {
  const Index n = static_cast<Index>(mass.size());
  for_chunks(n, chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Vec3 sum = (shift * mass[i]) * v.col(i);
      for (Index k = row_begin[i]; k < row_begin[i + 1]; ++k) sum += entry[k] * v.col(column[k]);
      result.col(i) = sum;
    }
  });
  // One range for both, so that one sum over the parts does.
  const Index strain_count = static_cast<Index>(strains.size());
  const Index count = strain_count + static_cast<Index>(terms.size());
  scattered_(count, 2 * chunk, result, [&](Index begin, Index end, Eigen::Matrix3Xd& out) {
    for (Index k = begin; k < std::min(end, strain_count); ++k) add_strain(strains[k], v, out);
    for (Index k = std::max(begin, strain_count); k < end; ++k) add_term(terms[k - strain_count], v, out);
  });
}

void StepOperator::inverse_blocks(bool diagonal_only, std::vector<Eigen::Matrix3d>& blocks) const {
  const Index n = static_cast<Index>(mass.size());
  blocks.resize(n);
  for (Index i = 0; i < n; ++i) {
    double diagonal = shift * mass[i];
    for (Index k = row_begin[i]; k < row_begin[i + 1]; ++k) {
      if (column[k] == i) diagonal += entry[k];
    }
    blocks[i] = diagonal * Eigen::Matrix3d::Identity();
  }
  for (const Strained& t : strains) {
    for (int k = 0; k < 3; ++k) {
      if (t.slot[k] >= 0) blocks[t.slot[k]] += t.stiffness * t.strain.block(k);
    }
  }
  for (const RankOne& t : terms) {
    for (int k = 0; k < 4; ++k) {
      if (t.slot[k] >= 0) blocks[t.slot[k]].noalias() += t.stiffness * t.g.col(k) * t.g.col(k).transpose();
    }
  }
  for_chunks(n, chunk, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      Eigen::Matrix3d& block = blocks[i];
      if (diagonal_only) {
        block = Vec3(block.diagonal().cwiseInverse()).asDiagonal();
      } else {
        block = inverse_of(block);
      }
    }
  });
}

}  // namespace unsnarl
