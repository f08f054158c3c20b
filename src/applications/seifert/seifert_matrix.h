#pragma once

#include <span>
#include <vector>

#include "applications/seifert/polynomial.h"

namespace unsnarl {

/// A square matrix of integers, row by row.
struct SeifertMatrix {
  Index size = 0;
  std::vector<std::int64_t> entries;
};

/// Linking numbers of a basis of the loops of an embedded, oriented surface whose components have boundaries: entry (i,
/// j) is that of loop i and of loop j pushed off to the side that the faces look to.
///
/// Loops run from face to face. Loop i is replaced by itself pushed off to the other side, which does not meet loop j
/// either. The distance is chosen so that a pushed loop does not meet the surface, and the strip between it and its
/// loop meets no other face; exact predicates decide. Linking numbers are sums of signs of crossings, also exact.
/// Throws std::runtime_error if rounding leaves no room between sheets.
SeifertMatrix seifert_matrix(std::span<const Vec3> x, std::span<const Triangle> faces);

/// The signature of V + V': the number of its positive eigenvalues less that of its negative ones, found exactly. It is
/// -2 for the right-handed trefoil.
int signature(const SeifertMatrix& matrix);

/// det(V - t V').
Polynomial alexander_polynomial(const SeifertMatrix& matrix);

}  // namespace unsnarl
