#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "geometry/parallel_sums.h"
#include "geometry/types.h"

namespace unsnarl {

/// The terms that elements of energies add to a Hessian, by vertex ids. Every term is positive semidefinite.
struct HessianTerms {
  /// factor * identity at one vertex.
  struct Diagonal {
    Index vertex;
    double factor;
  };
  /// stiffness * g g^T, a column of g for each vertex.
  struct RankOne {
    std::array<Index, 4> vertices = {-1, -1, -1, -1};  ///< -1: none, its column is zero
    Eigen::Matrix<double, 3, 4> g = Eigen::Matrix<double, 3, 4>::Zero();
    double stiffness = 0;
  };
  /// stiffness * g g^T over any number of vertices, a column of g for each.
  struct Dense {
    std::vector<Index> vertices;
    Eigen::Matrix3Xd g;
    double stiffness = 0;
  };
  /// Stiffness of a triangle's edges: a share `uniform` of it against every change of an edge vector, the rest against
  /// strains in the plane of the triangle alone (motions along the normal and rotations in the plane cost nothing).
  struct Strain {
    Triangle vertices;
    Eigen::Matrix<double, 3, 2> rotation;  ///< of the rest frame
    /// Unit: the infinitesimal rotation in the plane, in the coordinates (a, b) of hessian.cpp, each in the rest frame.
    Eigen::Vector4d turn;
    double stiffness = 0;
    double uniform = 0;

    /// Corner k of the result: sum_l H_kl v_l.
    Eigen::Matrix3d apply(const Eigen::Matrix3d& v) const;
    /// Block H_kl: what corner l does to corner k.
    Eigen::Matrix3d block(int k, int l) const;
    /// `turn` of a triangle with these rest edges (edge k from corner k to k + 1), in its own plane.
    static Eigen::Vector4d turn_of(const Eigen::Matrix<double, 2, 3>& rest_edges);
  };

  std::vector<Diagonal> diagonals;
  std::vector<RankOne> rank_ones;
  std::vector<Strain> strains;
  std::vector<Dense> dense;

  void clear();
};

/// The Hessian over the vertices that move ("unknowns"), as a sum of terms.
class Hessian {
 public:
  /// So many empty lists of terms, to be filled; assemble() takes them in order. They stay here, since they may be most
  /// of the memory of a solve.
  std::span<HessianTerms> begin(std::size_t parts);
  /// slot: vertex -> unknown, or -1 where the vertex does not move.
  void assemble(std::span<const Index> slot, Index unknowns);

  void apply(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const;
  /// Inverses of the 3 x 3 blocks on the diagonal.
  void inverse_blocks(std::vector<Eigen::Matrix3d>& blocks) const;
  /// Its lower triangle as a matrix, three rows an unknown. A dense term makes as many blocks as it has pairs of
  /// unknowns.
  Eigen::SparseMatrix<double> lower_triangle() const;

 private:
  std::vector<double> diagonal_;
  std::vector<HessianTerms> parts_;  // with unknowns in place of vertices once they are assembled
  mutable ScatteredSum scattered_;
};

}  // namespace unsnarl
