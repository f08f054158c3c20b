#include "applications/seifert/polynomial.h"

#include <algorithm>

namespace unsnarl {
namespace {

/// Bareiss's elimination, in which every division leaves no remainder.
Integer determinant(std::vector<Integer> m, Index n) {
  const auto at = [&](Index i, Index j) -> Integer& { return m[std::size_t(i) * n + j]; };
  Integer previous = 1;
  int sign = 1;
  for (Index k = 0; k + 1 < n; ++k) {
    Index pivot = k;
    while (pivot < n && at(pivot, k) == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != k) {
      for (Index j = 0; j < n; ++j) std::swap(at(k, j), at(pivot, j));
      sign = -sign;
    }
    for (Index i = k + 1; i < n; ++i)
      for (Index j = k + 1; j < n; ++j) at(i, j) = (at(i, j) * at(k, k) - at(i, k) * at(k, j)) / previous;
    previous = at(k, k);
  }
  return n == 0 ? Integer(1) : Integer(sign * at(n - 1, n - 1));
}

}  // namespace

Polynomial determinant(const LinearMatrix& matrix) {
  const Index n = matrix.size;
  std::vector<Integer> difference;  // values at 0, ..., n, then Newton's divided differences
  for (Index t = 0; t <= n; ++t) {
    std::vector<Integer> values;
    for (std::size_t k = 0; k < matrix.constant.size(); ++k)
      values.emplace_back(Integer(matrix.constant[k]) + Integer(matrix.slope[k]) * t);
    difference.push_back(determinant(std::move(values), n));
  }
  for (Index order = 1; order <= n; ++order)
    for (Index k = n; k >= order; --k) difference[k] = (difference[k] - difference[k - 1]) / order;
  Polynomial result{difference[n]};
  for (Index k = n - 1; k >= 0; --k) {  // Horner: result (t - k) + difference[k]
    result.insert(result.begin(), Integer(0));
    for (std::size_t i = 0; i + 1 < result.size(); ++i) result[i] -= result[i + 1] * k;
    result[0] += difference[k];
  }
  return result;
}

Polynomial without_units(Polynomial polynomial) {
  while (!polynomial.empty() && polynomial.back() == 0) polynomial.pop_back();
  const auto first = std::find_if(polynomial.begin(), polynomial.end(), [](const Integer& c) { return c != 0; });
  polynomial.erase(polynomial.begin(), first);
  if (!polynomial.empty() && polynomial.back() < 0)
    for (Integer& c : polynomial) c = -c;
  return polynomial;
}

std::string to_text(const Polynomial& polynomial) {
  std::string text;
  for (std::size_t k = 0; k < polynomial.size(); ++k) {
    const Integer& c = polynomial[k];
    if (c == 0) continue;
    const Integer size = abs(c);
    text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
    if (size != 1 || k == 0) text += size.str();
    if (k > 0) text += "t";
    if (k > 1) text += "^" + std::to_string(k);
  }
  return text.empty() ? "0" : text;
}

Integer value_at(const Polynomial& polynomial, int t) {
  Integer value = 0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) value = value * t + *c;
  return value;
}

}  // namespace unsnarl
