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

/// Linking numbers of a basis of the loops of an embedded, connected, oriented surface with boundary: entry (i, j) is
/// that of loop i and of loop j pushed off to the side that the faces look to.
///
/// Loops run from face to face. Instead of loop i itself the one pushed off to the other side is taken, which meets
/// loop j just as little. How far is found out: no part of a pushed loop may meet the surface, nor what joins it to its
/// loop any other face; both by exact predicates. Linking numbers are counted from signs of crossings, likewise.
/// Throws std::runtime_error where rounding leaves no room between sheets.
SeifertMatrix seifert_matrix(std::span<const Vec3> x, std::span<const Triangle> faces);

/// det(V - t V').
Polynomial alexander_polynomial(const SeifertMatrix& matrix);

}  // namespace unsnarl
