#include "energy/gaussian_bandwidth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace unsnarl {
namespace {

double fraction(std::mt19937& generator) {
  return static_cast<double>(generator()) / 4294967295.0;
}

std::vector<BandwidthPair> random_pairs(Index n, std::mt19937& generator) {
  Positions x(3, n);
  for (Index i = 0; i < x.size(); ++i) x(i) = fraction(generator);
  std::vector<BandwidthPair> pairs;
  for (Index i = 0; i < n; ++i) {
    for (Index j = i + 1; j < n; ++j) {
      pairs.push_back({i, j, (x.col(i) - x.col(j)).squaredNorm(), 0.5 + fraction(generator)});
    }
  }
  return pairs;
}

double local_energy(const std::vector<BandwidthPair>& pairs, const std::vector<double>& squared) {
  double sum = 0;
  for (const BandwidthPair& pair : pairs) {
    const double eps2 = 0.5 * (squared[pair.i] + squared[pair.j]);
    sum += pair.weight / eps2 * std::exp(-pair.squared_distance / eps2);
  }
  return sum;
}

TEST(GlobalBandwidth, is_the_maximum_found_by_brute_force) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 10; ++trial) {
    const std::vector<BandwidthPair> pairs = random_pairs(12, generator);
    const std::vector<GlobalBandwidth> found = global_bandwidths(pairs);
    ASSERT_FALSE(found.empty());
    double best = 0, best_energy = 0;
    for (double epsilon = 0.01; epsilon < 2; epsilon *= 1.0002) {
      const double energy = global_contact_energy(pairs, epsilon);
      if (energy > best_energy) best_energy = energy, best = epsilon;
    }
    EXPECT_NEAR(found[0].epsilon, best, 3e-4 * best);
    EXPECT_FALSE(found[0].clamped);
  }
}

TEST(GlobalBandwidth, finds_both_maxima_of_two_scales) {
  // A few close pairs and very many distant ones.
  const std::vector<BandwidthPair> pairs{{0, 1, 0.01 * 0.01, 1}, {2, 3, 1, 20000}};
  const std::vector<GlobalBandwidth> found = global_bandwidths(pairs);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].epsilon, 1, 1e-3);  // p = 2: eps = r
  EXPECT_NEAR(found[1].epsilon, 0.01, 1e-5);
  EXPECT_GT(found[0].energy, found[1].energy);
}

TEST(GlobalBandwidth, nothing_from_nothing_and_a_clamp_for_coincident_points) {
  EXPECT_TRUE(global_bandwidths({}).empty());
  const std::vector<BandwidthPair> pairs{{0, 1, 0, 1}, {0, 2, 1, 1e-9}};
  BandwidthOptions options;
  options.smallest = 0.25;
  const std::vector<GlobalBandwidth> found = global_bandwidths(pairs, options);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].clamped);
  EXPECT_EQ(found[0].epsilon, 0.25);
}

TEST(SymmetricLocalBandwidth, is_a_local_maximum) {
  std::mt19937 generator(2);
  int settled = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<BandwidthPair> pairs = random_pairs(7, generator);
    std::vector<double> squared(7, std::pow(global_bandwidths(pairs)[0].epsilon, 2));
    BandwidthOptions options;
    options.smallest = 0.05;
    options.max_iterations = 5000;
    const LocalBandwidthReport report = symmetric_local_bandwidths(pairs, squared, options);
    if (!report.converged || report.clamped > 0) continue;  // see the next test
    ++settled;
    // Brute force around it: no bandwidth alone, and no random mix of them, does better.
    const double energy = local_energy(pairs, squared);
    for (int probe = 0; probe < 500; ++probe) {
      std::vector<double> other = squared;
      if (probe < 14) {
        other[probe / 2] *= probe % 2 ? 1.02 : 0.98;
      } else {
        for (double& eps2 : other) eps2 *= 1 + 0.02 * (2 * fraction(generator) - 1);
      }
      EXPECT_LE(local_energy(pairs, other), energy * (1 + 1e-9));
    }
  }
  EXPECT_GT(settled, 2);
}

TEST(SymmetricLocalBandwidth, two_points_share_their_distance) {
  const std::vector<BandwidthPair> pairs{{0, 1, 4, 1}};
  std::vector<double> squared{1, 2};
  const LocalBandwidthReport report = symmetric_local_bandwidths(pairs, squared, {.largest = 10});
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(0.5 * (squared[0] + squared[1]), 4, 1e-8);  // p = 2: eps_ij^2 = r^2
}

TEST(SymmetricLocalBandwidth, negative_and_undefined_values_are_clamped_and_reported) {
  // Point 1 is close to 0 and far from 2, which pulls its partner's bandwidth up: 4 r^2 / p - eps_j^2 < 0.
  const std::vector<BandwidthPair> pairs{{0, 1, 1e-4, 1}};
  std::vector<double> squared{1e-6 + 1e-3, 0.5, 7};
  BandwidthOptions options;
  options.smallest = 1e-3;
  options.largest = 3;
  options.max_iterations = 1;
  options.damping = 1;
  const LocalBandwidthReport report = symmetric_local_bandwidths(pairs, squared, options);
  EXPECT_GE(report.clamped, 1);
  EXPECT_EQ(report.undefined, 1);  // point 2 has nobody
  EXPECT_NEAR(squared[0], 1e-6, 1e-18);
  EXPECT_EQ(squared[2], 7);
  squared = {1e-8, 1e-8, 1};  // exp(-1e-4 / 1e-8) underflows: 0/0
  const LocalBandwidthReport underflow = symmetric_local_bandwidths(pairs, squared, options);
  EXPECT_EQ(underflow.undefined, 3);
  EXPECT_EQ(squared[0], 1e-8);
}

TEST(IndependentLocalBandwidth, maximises_every_points_own_energy) {
  std::mt19937 generator(3);
  const std::vector<BandwidthPair> pairs = random_pairs(8, generator);
  std::vector<double> squared(8, 0.25);
  BandwidthOptions options;
  options.max_iterations = 20000;
  const LocalBandwidthReport report = independent_local_bandwidths(pairs, squared, options);
  EXPECT_TRUE(report.converged);
  for (Index i = 0; i < 8; ++i) {
    const auto own = [&](double eps2) {
      double sum = 0;
      for (const BandwidthPair& pair : pairs) {
        if (pair.i == i || pair.j == i) sum += pair.weight / eps2 * std::exp(-pair.squared_distance / eps2);
      }
      return sum;
    };
    EXPECT_GE(own(squared[i]), own(squared[i] * 1.01));
    EXPECT_GE(own(squared[i]), own(squared[i] / 1.01));
  }
}

// E_G where every pair has its own best bandwidth, eps_ij = r_ij for p = 2: sum of a_ij / (e r_ij^2).
double pairwise_optimal_energy(std::span<const BandwidthPair> pairs) {
  double sum = 0;
  for (const BandwidthPair& pair : pairs) sum += pair.weight * std::exp(-1.0) / pair.squared_distance;
  return sum;
}

// Model (III): the kernel drops out and what is left is singular (App. B.3), which is why it is not used.
TEST(PairwiseOptimalBandwidth, diverges_as_points_meet) {
  double previous = 0;
  for (const double r : {1.0, 1e-2, 1e-4, 1e-8}) {
    const std::vector<BandwidthPair> pairs{{0, 1, r * r, 1}};
    const double energy = pairwise_optimal_energy(pairs);
    EXPECT_NEAR(energy * r * r, std::exp(-1.0), 1e-12);
    EXPECT_NEAR(energy, global_contact_energy(pairs, r), 1e-12 * energy);
    EXPECT_GT(energy, previous);
    previous = energy;
  }
  const std::vector<BandwidthPair> touching{{0, 1, 0, 1}};
  EXPECT_TRUE(std::isinf(pairwise_optimal_energy(touching)));
}

}  // namespace
}  // namespace unsnarl
