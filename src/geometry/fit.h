#pragma once

#include "geometry/types.h"

namespace unsnarl {

/// Gives a matrix this size, its numbers any. Eigen's own resize() frees the old numbers before it asks for room for
/// the new ones, and where there is none they are freed once more at the end of the matrix.
template <class Matrix>
void fit(Matrix& matrix, Index rows, Index cols) {
  if (matrix.rows() == rows && matrix.cols() == cols) return;
  matrix = Matrix();
  matrix.resize(rows, cols);
}

}  // namespace unsnarl
