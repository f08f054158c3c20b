#include "energy/gaussian_bandwidth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// A fixed point is a maximum where the energy is lower at this ratio above and below it (no unit)
constexpr double neighbour_ratio = 1.001;
/// Maxima are one and the same where they differ by less than this share (no unit)
constexpr double same_maximum = 1e-4;

struct Range {
  double least = std::numeric_limits<double>::infinity();  // positive squared distance
  double largest = 0;
};

Range squared_range(std::span<const BandwidthPair> pairs) {
  Range range;
  for (const BandwidthPair& pair : pairs) {
    if (!(pair.weight > 0)) continue;
    if (pair.squared_distance > 0) range.least = std::min(range.least, pair.squared_distance);
    range.largest = std::max(range.largest, pair.squared_distance);
  }
  return range;
}

double squared_upper_bound(std::span<const BandwidthPair> pairs, const BandwidthOptions& options) {
  return options.largest > 0 ? options.largest * options.largest : squared_range(pairs).largest;
}

}  // namespace

double global_contact_energy(std::span<const BandwidthPair> pairs, double epsilon, double exponent) {
  const double squared = epsilon * epsilon;
  double sum = 0;
  for (const BandwidthPair& pair : pairs) sum += pair.weight * portable::exp(-pair.squared_distance / squared);
  return sum * portable::pow(epsilon, -exponent);
}

std::vector<GlobalBandwidth> global_bandwidths(std::span<const BandwidthPair> pairs, const BandwidthOptions& options) {
  std::vector<GlobalBandwidth> maxima;
  const Range range = squared_range(pairs);
  if (!(range.largest > 0)) return maxima;
  const double upper = squared_upper_bound(pairs, options);
  const double lower = std::max(options.smallest * options.smallest, std::numeric_limits<double>::min());
  // All terms scaled by the largest: at small eps the plain moments are 0/0. Coincident points leave eps no positive
  // limit there; the clamp below catches them.
  double nearest = range.largest;
  for (const BandwidthPair& pair : pairs) {
    if (pair.weight > 0) nearest = std::min(nearest, pair.squared_distance);
  }
  const auto g = [&](double squared) {
    double m0 = 0, m2 = 0;
    for (const BandwidthPair& pair : pairs) {
      const double term = pair.weight * portable::exp((nearest - pair.squared_distance) / squared);
      m0 += term;
      m2 += term * pair.squared_distance;
    }
    return 2 * m2 / (options.exponent * m0);
  };
  const int starts = std::max(1, options.starts);
  for (int k = 0; k < starts; ++k) {
    const double t = starts == 1 ? 0.5 : static_cast<double>(k) / (starts - 1);
    double squared = std::clamp(portable::pow(range.least, 1 - t) * portable::pow(range.largest, t), lower, upper);
    bool clamped = false;
    // Undamped steps do no overshooting here (g is increasing), but converge slowly near double points: many allowed.
    for (int i = 0; i < 10 * options.max_iterations; ++i) {
      const double wanted = g(squared);
      const double next = std::clamp(wanted, lower, upper);
      clamped = next != wanted;
      const bool settled = std::abs(next - squared) <= options.tolerance * squared;
      squared = next;
      if (settled) break;
    }
    const double epsilon = std::sqrt(squared);
    const double energy = global_contact_energy(pairs, epsilon, options.exponent);
    if (!std::isfinite(energy)) continue;
    // A fixed point may also be a minimum.
    if (!clamped && (global_contact_energy(pairs, epsilon * neighbour_ratio, options.exponent) > energy ||
                     global_contact_energy(pairs, epsilon / neighbour_ratio, options.exponent) > energy)) {
      continue;
    }
    const bool known = std::any_of(maxima.begin(), maxima.end(), [&](const GlobalBandwidth& m) {
      return std::abs(m.epsilon - epsilon) <= same_maximum * epsilon;
    });
    if (!known) maxima.push_back({epsilon, energy, clamped});
  }
  std::stable_sort(maxima.begin(), maxima.end(),
                   [](const GlobalBandwidth& a, const GlobalBandwidth& b) { return a.energy > b.energy; });
  return maxima;
}

namespace {

// Both local models: `accumulate(pair, squared, top_i, bottom_i, top_j, bottom_j)` adds one pair's share, and the
// wanted eps_i^2 is top / bottom.
template <class Accumulate>
LocalBandwidthReport iterate(std::span<const BandwidthPair> pairs, std::vector<double>& squared,
                             const BandwidthOptions& options, Accumulate&& accumulate) {
  LocalBandwidthReport report;
  const double upper = squared_upper_bound(pairs, options);
  const double lower = std::max(options.smallest * options.smallest, std::numeric_limits<double>::min());
  std::vector<double> top(squared.size()), bottom(squared.size());
  for (; report.iterations < options.max_iterations && !report.converged; ++report.iterations) {
    std::fill(top.begin(), top.end(), 0.0);
    std::fill(bottom.begin(), bottom.end(), 0.0);
    for (const BandwidthPair& pair : pairs) accumulate(pair, squared, top, bottom);
    report.clamped = report.undefined = 0;
    report.converged = true;
    for (std::size_t i = 0; i < squared.size(); ++i) {
      const double wanted = top[i] / bottom[i];
      if (!(bottom[i] > 0) || !std::isfinite(wanted)) {
        ++report.undefined;
        continue;
      }
      const double damped = (1 - options.damping) * squared[i] + options.damping * wanted;
      const double next = std::clamp(damped, lower, upper);
      if (next != damped) ++report.clamped;
      if (std::abs(next - squared[i]) > options.tolerance * squared[i]) report.converged = false;
      squared[i] = next;
    }
  }
  return report;
}

}  // namespace

LocalBandwidthReport symmetric_local_bandwidths(std::span<const BandwidthPair> pairs, std::vector<double>& squared,
                                                const BandwidthOptions& options) {
  const double p = options.exponent;
  return iterate(pairs, squared, options,
                 [p](const BandwidthPair& pair, const std::vector<double>& eps2, std::vector<double>& top,
                     std::vector<double>& bottom) {
                   const double mean = 0.5 * (eps2[pair.i] + eps2[pair.j]);
                   const double power = p == 2 ? 1 / (mean * mean * mean) : portable::pow(mean, -0.5 * (p + 4));
                   const double b = pair.weight * power * portable::exp(-pair.squared_distance / mean);
                   const double target = 4 / p * pair.squared_distance;
                   top[pair.i] += b * (target - eps2[pair.j]);
                   top[pair.j] += b * (target - eps2[pair.i]);
                   bottom[pair.i] += b;
                   bottom[pair.j] += b;
                 });
}

LocalBandwidthReport independent_local_bandwidths(std::span<const BandwidthPair> pairs, std::vector<double>& squared,
                                                  const BandwidthOptions& options) {
  const double p = options.exponent;
  return iterate(pairs, squared, options,
                 [p](const BandwidthPair& pair, const std::vector<double>& eps2, std::vector<double>& top,
                     std::vector<double>& bottom) {
                   for (const Index i : {pair.i, pair.j}) {
                     const double term = pair.weight * portable::exp(-pair.squared_distance / eps2[i]);
                     top[i] += 2 / p * term * pair.squared_distance;
                     bottom[i] += term;
                   }
                 });
}

}  // namespace unsnarl
