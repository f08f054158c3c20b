#pragma once

#include <Eigen/SparseCore>
#include <span>

#include "geometry/types.h"

namespace unsnarl::peers {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// n x n, symmetric, positive semidefinite: half the sum of the cotangents opposite each edge, negated, off the
/// diagonal; rows sum to zero. Triangles thinner than 1e-8 (height / longest side) count as if they were not.
SparseMatrix cotangent_laplacian(const Positions& x, std::span<const Triangle> triangles);

/// n x n mass matrix of piecewise linear finite elements, not lumped.
SparseMatrix mass_matrix(const Positions& x, std::span<const Triangle> triangles);

}  // namespace unsnarl::peers
