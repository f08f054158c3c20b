#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "energy/arap_triangle.h"
#include "geometry/parallel_sums.h"

namespace unsnarl {

/// Matrix of a Newton step: a symmetric positive semidefinite operator over the vertices that move, by slots. A scalar
/// sparse matrix on each coordinate, plus strains of triangles, plus rank-one terms of up to four vertices.
struct StepOperator {
  struct RankOne {
    std::array<Index, 4> slot;      // -1: does not move
    Eigen::Matrix<double, 3, 4> g;  // the term is stiffness * g g^T
    double stiffness;
  };
  struct Strained {
    Triangle slot;
    ArapTriangle::Strain strain;
    double stiffness;
  };

  std::vector<Index> row_begin, column;  // of the sparse matrix
  std::vector<double> entry;
  std::vector<RankOne> terms;
  std::vector<Strained> strains;
  double shift = 0;  // times the mass
  std::vector<double> mass;

  void apply(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const;
  /// Inverses of the 3 x 3 blocks on the diagonal, or of their diagonals.
  void inverse_blocks(bool diagonal_only, std::vector<Eigen::Matrix3d>& blocks) const;

 private:
  mutable ScatteredSum scattered_;
};

}  // namespace unsnarl
