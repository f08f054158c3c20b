#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <string>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

using Integer = boost::multiprecision::cpp_int;
/// Coefficients from the constant one up; empty: zero.
using Polynomial = std::vector<Integer>;

/// A square matrix of polynomials constant + slope t.
struct LinearMatrix {
  explicit LinearMatrix(Index n) : size(n), constant(std::size_t(n) * n), slope(std::size_t(n) * n) {}
  std::size_t at(Index row, Index column) const { return std::size_t(row) * size + column; }

  Index size;
  std::vector<std::int64_t> constant, slope;  ///< row by row
};

/// Exactly; 1 for a matrix without rows.
Polynomial determinant(const LinearMatrix& matrix);

/// The associate up to units ± t^k that starts with a constant other than 0 and ends with a positive coefficient.
Polynomial without_units(Polynomial polynomial);

/// "1 - 3t + t^2".
std::string to_text(const Polynomial& polynomial);

Integer value_at(const Polynomial& polynomial, int t);

}  // namespace unsnarl
