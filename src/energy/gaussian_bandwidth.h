#pragma once

#include <span>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// One interaction as the bandwidth models see it: how far apart, and a_ij = A_i A_j w_ij.
struct BandwidthPair {
  Index i = 0, j = 0;
  double squared_distance = 0;  ///< r_ij^2
  double weight = 0;            ///< a_ij >= 0
};

struct BandwidthOptions {
  double exponent = 2;    ///< The exponent p of the bandwidth in the energy (no unit)
  double damping = 0.25;  ///< Theta of the damped Jacobi iteration, paper §3.1.5 (no unit)
  /// Iterations of the local model, at most; a bandwidth that has not settled by then oscillates (unit: iterations)
  int max_iterations = 400;
  /// A fixed point is reached where eps^2 changes by less than this share (no unit)
  double tolerance = 1e-10;
  double smallest = 0;  ///< length: bandwidths are kept within [smallest, largest]
  double largest = 0;   ///< length; 0: the largest distance among the pairs
  /// Starts of the global iteration, evenly spaced in log eps between the least and largest distance (unit: starts)
  int starts = 9;
};

/// E_G for one global bandwidth: sum of a_ij eps^-p exp(-r_ij^2 / eps^2).
double global_contact_energy(std::span<const BandwidthPair> pairs, double epsilon, double exponent = 2);

struct GlobalBandwidth {
  double epsilon = 0;
  double energy = 0;     ///< E_G there
  bool clamped = false;  ///< stands at an end of [smallest, largest]: not stationary
};
/// Local maxima of E_G over one global bandwidth (paper §3.1.3, App. B.1), found from several starts, highest energy
/// first; stable fixed points of eps^2 = 2 M2 / (p M0). Empty without pairs.
std::vector<GlobalBandwidth> global_bandwidths(std::span<const BandwidthPair> pairs,
                                               const BandwidthOptions& options = {});

struct LocalBandwidthReport {
  int iterations = 0;
  bool converged = false;
  Index clamped = 0;    ///< points whose value left [smallest, largest] (it can turn negative) at the last iteration
  Index undefined = 0;  ///< points without a neighbour that counts (0/0): their value is kept
};

/// Damped Jacobi steps of the symmetric local model (II), in place: eps_ij^2 = (eps_i^2 + eps_j^2) / 2 (App. B.4).
/// `squared`: eps_i^2 > 0, one a point; also the start.
LocalBandwidthReport symmetric_local_bandwidths(std::span<const BandwidthPair> pairs, std::vector<double>& squared,
                                                const BandwidthOptions& options = {});

/// The independent local model (I), for comparison: every point maximises the energy of its own interactions.
LocalBandwidthReport independent_local_bandwidths(std::span<const BandwidthPair> pairs, std::vector<double>& squared,
                                                  const BandwidthOptions& options = {});

}  // namespace unsnarl
