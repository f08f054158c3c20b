#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "geometry/portable_math.h"
#include "geometry/types.h"

namespace unsnarl {

/// Gaussian self-contact energy of weighted points in the plane, in space or in R^4 (paper eq. (4)):
///   E_G = sum over unordered pairs of a_ij eps_ij^-p exp(-r_ij^2 / eps_ij^2),  a_ij = A_i A_j w_ij,
///   eps_ij^2 = (eps_i^2 + eps_j^2) / 2.
/// (The paper's double sum (4) counts every pair twice; its printed gradient, §3.5.3, is that of one count with one
/// global eps.) The weights are constants when differentiating. Knows nothing but points: curves, surfaces, clusters.
template <int Dim>
class GaussianContact {
 public:
  using Points = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

  struct Pair {
    Index i = 0, j = 0;
    double weight = 0;  ///< a_ij >= 0
  };

  std::vector<Pair> pairs;                ///< unordered pairs that interact, each once
  std::vector<double> squared_bandwidth;  ///< eps_i^2 > 0, length squared, one a point
  double exponent = Dim == 2 ? 1 : 2;     ///< p: the dimension of the shape, 1 for curves, 2 for surfaces
  /// Model (I) of the paper's App. B.3: the mean of the terms with eps_i and with eps_j, not one with eps_ij.
  bool independent = false;

  /// Returns weight * E_G and adds weight * its gradient.
  double value_and_gradient(const Points& x, Points& gradient, double weight = 1) const {
    double value = 0;
    const auto add = [&](const Pair& pair, double squared, double share) {
      const Eigen::Matrix<double, Dim, 1> r = x.col(pair.i) - x.col(pair.j);
      const double power = exponent == 2 ? 1 / squared : portable::pow(squared, -0.5 * exponent);
      const double term = share * pair.weight * power * portable::exp(-r.squaredNorm() / squared);
      value += term;
      const Eigen::Matrix<double, Dim, 1> force = (2 * weight * term / squared) * r;
      gradient.col(pair.i) -= force;
      gradient.col(pair.j) += force;
    };
    for (const Pair& pair : pairs) {
      if (independent) {
        add(pair, squared_bandwidth[pair.i], 0.5);
        add(pair, squared_bandwidth[pair.j], 0.5);
      } else {
        add(pair, 0.5 * (squared_bandwidth[pair.i] + squared_bandwidth[pair.j]), 1);
      }
    }
    return weight * value;
  }
};

/// All pairs i < j of points no farther apart than `cutoff` (> 0), sorted: the neighbourhoods of paper §3.5.4.
template <int Dim>
std::vector<std::array<Index, 2>> pairs_within(const Eigen::Matrix<double, Dim, Eigen::Dynamic>& x, double cutoff);

extern template std::vector<std::array<Index, 2>> pairs_within<2>(const Eigen::Matrix<double, 2, Eigen::Dynamic>&,
                                                                  double);
extern template std::vector<std::array<Index, 2>> pairs_within<3>(const Eigen::Matrix<double, 3, Eigen::Dynamic>&,
                                                                  double);
extern template std::vector<std::array<Index, 2>> pairs_within<4>(const Eigen::Matrix<double, 4, Eigen::Dynamic>&,
                                                                  double);

}  // namespace unsnarl
