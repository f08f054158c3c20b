#include <algorithm>
#include <cstdint>
#include <optional>

#include "applications/seifert/polynomial.h"

namespace unsnarl {
namespace {

using Residue = std::uint64_t;          // below a prime of 31 bits, so that products fit
using Residues = std::vector<Residue>;  // of a matrix row by row, or of a polynomial from the constant up

constexpr Residue above_primes = Residue(1) << 31;  ///< Primes are below this (fixed by products in 64 bits)

bool is_prime(Residue n) {
  for (Residue d = 2; d * d <= n; ++d)
    if (n % d == 0) return false;
  return n > 1;
}

Residue power(Residue base, Residue exponent, Residue prime) {
  Residue result = 1;
  for (; exponent > 0; exponent /= 2, base = base * base % prime)
    if (exponent % 2 == 1) result = result * base % prime;
  return result;
}

Residue inverse(Residue value, Residue prime) {
  return power(value, prime - 2, prime);
}

Residue residue_of(std::int64_t value, Residue prime) {
  const auto p = static_cast<std::int64_t>(prime);
  return static_cast<Residue>((value % p + p) % p);
}

/// row[k] -= factor * other[k] from `begin` on.
void subtract(Residues& m, Index row, Index other, Residue factor, Index begin, Index width, Residue prime) {
  Residue* to = &m[std::size_t(row) * width];
  const Residue* from = &m[std::size_t(other) * width];
  for (Index k = begin; k < width; ++k) to[k] = (to[k] + (prime - factor) * from[k]) % prime;
}

/// Turns [A | B], n rows of width n + any, into [1 | B / A]. Returns the determinant of A; 0: A has no inverse.
Residue eliminate(Residues& m, Index n, Index width, Residue prime) {
  Residue determinant = 1;
  for (Index k = 0; k < n; ++k) {
    Index pivot = k;
    while (pivot < n && m[std::size_t(pivot) * width + k] == 0) ++pivot;
    if (pivot == n) return 0;
    if (pivot != k) {
      std::swap_ranges(&m[std::size_t(k) * width], &m[std::size_t(k) * width] + width, &m[std::size_t(pivot) * width]);
      determinant = (prime - determinant) % prime;
    }
    const Residue head = m[std::size_t(k) * width + k], over = inverse(head, prime);
    determinant = determinant * head % prime;
    for (Index j = k; j < width; ++j) m[std::size_t(k) * width + j] = m[std::size_t(k) * width + j] * over % prime;
    for (Index i = 0; i < n; ++i)
      if (const Residue factor = m[std::size_t(i) * width + k]; i != k && factor != 0)
        subtract(m, i, k, factor, k, width, prime);
  }
  return determinant;
}

/// det(x - M), by a Hessenberg matrix that is similar to M (H. Cohen, "A Course in Computational Algebraic Number
/// Theory", algorithm 2.2.9).
Residues characteristic_polynomial(Residues m, Index n, Residue prime) {
  const auto at = [&](Index i, Index j) -> Residue& { return m[std::size_t(i) * n + j]; };
  for (Index k = 1; k + 1 < n; ++k) {
    Index pivot = k;
    while (pivot < n && at(pivot, k - 1) == 0) ++pivot;
    if (pivot == n) continue;
    if (pivot != k) {
      for (Index j = k - 1; j < n; ++j) std::swap(at(pivot, j), at(k, j));
      for (Index i = 0; i < n; ++i) std::swap(at(i, pivot), at(i, k));
    }
    const Residue over = inverse(at(k, k - 1), prime);
    for (Index i = k + 1; i < n; ++i) {
      const Residue factor = at(i, k - 1) * over % prime;
      if (factor == 0) continue;
      subtract(m, i, k, factor, k - 1, n, prime);
      for (Index j = 0; j < n; ++j) at(j, k) = (at(j, k) + factor * at(j, i)) % prime;
    }
  }
  std::vector<Residues> of_leading{{1}};  // of the first k rows and columns
  for (Index k = 0; k < n; ++k) {
    Residues next(k + 2, 0);
    for (Index i = 0; i <= k; ++i) {
      next[i + 1] = (next[i + 1] + of_leading[k][i]) % prime;
      next[i] = (next[i] + (prime - at(k, k)) * of_leading[k][i]) % prime;
    }
    Residue below = 1;  // product of the entries below the diagonal
    for (Index i = 1; i <= k; ++i) {
      below = below * at(k - i + 1, k - i) % prime;
      const Residue factor = (prime - at(k - i, k) * below % prime) % prime;
      for (std::size_t j = 0; j < of_leading[k - i].size(); ++j)
        next[j] = (next[j] + factor * of_leading[k - i][j]) % prime;
    }
    of_leading.push_back(std::move(next));
  }
  return of_leading.back();
}

/// det(A + t B) modulo a prime: where A + at B has an inverse, it is det(A + at B) det(1 + (t - at) B / (A + at B)).
Residues determinant_modulo(const LinearMatrix& matrix, Residue prime) {
  const Index n = matrix.size, width = 2 * n;
  Residues both(std::size_t(n) * width);
  Residue value = 0, at = 0;
  // A polynomial of degree n that is not zero has a value that is not, at one of these.
  for (Index tried = 0; tried <= n && value == 0; ++tried) {
    at = static_cast<Residue>(tried + 1);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const Residue slope = residue_of(matrix.slope[matrix.at(i, j)], prime);
        both[std::size_t(i) * width + n + j] = slope;
        both[std::size_t(i) * width + j] = (residue_of(matrix.constant[matrix.at(i, j)], prime) + at * slope) % prime;
      }
    value = eliminate(both, n, width, prime);
  }
  if (value == 0) return Residues(n + 1, 0);
  Residues quotient(std::size_t(n) * n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      quotient[std::size_t(i) * n + j] = (prime - both[std::size_t(i) * width + n + j]) % prime;
  Residues result = characteristic_polynomial(std::move(quotient), n, prime);
  std::reverse(result.begin(), result.end());  // now in s = t - at
  for (Residue& c : result) c = c * value % prime;
  for (Index k = 0; k < n; ++k)  // Horner's shift
    for (Index i = n - 1; i >= k; --i) result[i] = (result[i] + (prime - at) * result[i + 1]) % prime;
  return result;
}

/// No coefficient of the determinant is larger: it is a sum of products of one entry from each row.
Integer bound_of(const LinearMatrix& matrix) {
  Integer bound = 1;
  for (Index i = 0; i < matrix.size; ++i) {
    Integer row = 0;
    for (Index j = 0; j < matrix.size; ++j)
      row += abs(Integer(matrix.constant[matrix.at(i, j)])) + abs(Integer(matrix.slope[matrix.at(i, j)]));
    bound *= row;
  }
  return bound;
}

}  // namespace

/// By its residues modulo so many primes that their product is above twice the largest coefficient that can be.
Polynomial determinant(const LinearMatrix& matrix) {
  const Integer enough = 2 * bound_of(matrix);
  Polynomial result(matrix.size + 1, Integer(0));
  Integer modulus = 1;
  for (Residue prime = above_primes - 1; modulus <= enough; --prime) {
    if (!is_prime(prime)) continue;
    const Residues residues = determinant_modulo(matrix, prime);
    const Residue over = inverse(static_cast<Residue>(modulus % prime), prime);
    for (std::size_t k = 0; k < result.size(); ++k) {
      const auto known = static_cast<Residue>(result[k] % prime);
      result[k] += modulus * ((residues[k] + prime - known) % prime * over % prime);
    }
    modulus *= prime;
  }
  for (Integer& c : result)
    if (2 * c > modulus) c -= modulus;
  return result;
}

}  // namespace unsnarl
