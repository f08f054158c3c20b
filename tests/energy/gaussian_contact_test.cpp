#include "energy/gaussian_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "energy/uniform.h"

namespace unsnarl {
namespace {

template <int Dim>
struct Sample {
  typename GaussianContact<Dim>::Points x;
  GaussianContact<Dim> energy;
};

template <int Dim>
Sample<Dim> make_sample(Index n, std::mt19937& generator) {
  Sample<Dim> sample;
  sample.x.resize(Dim, n);
  for (Index i = 0; i < n * Dim; ++i) sample.x(i) = uniform(generator);
  for (Index i = 0; i < n; ++i) {
    sample.energy.squared_bandwidth.push_back(0.3 + 0.2 * uniform(generator));
    for (Index j = i + 1; j < n; ++j) sample.energy.pairs.push_back({i, j, 1.5 + uniform(generator)});
  }
  return sample;
}

template <int Dim>
void expect_gradient(Sample<Dim>& sample) {
  using Points = typename GaussianContact<Dim>::Points;
  const Index n = static_cast<Index>(sample.x.cols());
  Points gradient = Points::Zero(Dim, n), unused = gradient;
  sample.energy.value_and_gradient(sample.x, gradient, 2);
  for (Index i = 0; i < n * Dim; ++i) {
    Points up = sample.x, down = sample.x;
    up(i) += 1e-6;
    down(i) -= 1e-6;
    const double numeric =
        (sample.energy.value_and_gradient(up, unused, 2) - sample.energy.value_and_gradient(down, unused, 2)) / 2e-6;
    EXPECT_NEAR(numeric, gradient(i), 1e-7 * (1 + std::abs(numeric)));
  }
  EXPECT_NEAR(gradient.rowwise().sum().norm(), 0, 1e-10);  // translations cost nothing
}

TEST(GaussianContact, gradient_matches_finite_differences_in_every_dimension) {
  std::mt19937 generator(1);
  Sample<2> plane = make_sample<2>(8, generator);
  Sample<3> space = make_sample<3>(8, generator);
  Sample<4> four = make_sample<4>(8, generator);
  expect_gradient(plane);
  expect_gradient(space);
  expect_gradient(four);
  space.energy.independent = true;
  expect_gradient(space);
  space.energy.independent = false;
  space.x.col(1) = space.x.col(0);  // coincident points: finite, no force between them
  space.x.col(2) = space.x.col(0);
  expect_gradient(space);
}

TEST(GaussianContact, counts_every_pair_once_with_the_quadratic_mean_of_the_bandwidths) {
  GaussianContact<3> energy;
  energy.pairs = {{0, 1, 6}};
  energy.squared_bandwidth = {1, 3};
  Positions x(3, 2), gradient = Positions::Zero(3, 2);
  x << 0, 2, 0, 0, 0, 0;
  EXPECT_NEAR(energy.value_and_gradient(x, gradient), 6.0 / 2 * std::exp(-4.0 / 2), 1e-14);
  EXPECT_GT(gradient(0, 0), 0);  // downhill is apart
  EXPECT_NEAR(gradient(0, 0), -gradient(0, 1), 1e-16);
}

// Paper §3.5.5: with areas, X^2 for scale-free weights and X^3 when the weight is an intrinsic distance.
TEST(GaussianContact, scaling_laws) {
  std::mt19937 generator(2);
  Sample<3> sample = make_sample<3>(10, generator);
  Positions unused = Positions::Zero(3, 10);
  const double value = sample.energy.value_and_gradient(sample.x, unused);
  const double factor = 1.7;
  for (const int intrinsic : {0, 1}) {
    Sample<3> scaled = sample;
    scaled.x *= factor;
    for (double& eps2 : scaled.energy.squared_bandwidth) eps2 *= factor * factor;
    for (auto& pair : scaled.energy.pairs) pair.weight *= std::pow(factor, 4 + intrinsic);
    EXPECT_NEAR(scaled.energy.value_and_gradient(scaled.x, unused), value * std::pow(factor, 2 + intrinsic), 1e-10);
  }
}

TEST(GaussianContact, curves_scale_as_length_in_the_plane) {
  std::mt19937 generator(3);
  Sample<2> sample = make_sample<2>(10, generator);
  EXPECT_EQ(sample.energy.exponent, 1);
  Eigen::Matrix2Xd unused = Eigen::Matrix2Xd::Zero(2, 10);
  const double value = sample.energy.value_and_gradient(sample.x, unused);
  sample.x *= 2;
  for (double& eps2 : sample.energy.squared_bandwidth) eps2 *= 4;
  for (auto& pair : sample.energy.pairs) pair.weight *= 4;  // lengths of both
  EXPECT_NEAR(sample.energy.value_and_gradient(sample.x, unused), 2 * value, 1e-10);
}

template <int Dim>
void expect_same_pairs_as_brute_force(std::mt19937& generator) {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> x(Dim, 200);
  for (Index i = 0; i < x.size(); ++i) x(i) = std::round(uniform(generator) * 8) / 8;  // many ties and coincidences
  for (const double cutoff : {0.125, 0.3, 0.5, 4.0}) {
    std::vector<std::array<Index, 2>> expected;
    for (Index i = 0; i < 200; ++i) {
      for (Index j = i + 1; j < 200; ++j) {
        if ((x.col(i) - x.col(j)).squaredNorm() <= cutoff * cutoff) expected.push_back({i, j});
      }
    }
    EXPECT_EQ(pairs_within<Dim>(x, cutoff), expected);
  }
}

TEST(PairsWithin, matches_brute_force) {
  std::mt19937 generator(4);
  expect_same_pairs_as_brute_force<2>(generator);
  expect_same_pairs_as_brute_force<3>(generator);
  expect_same_pairs_as_brute_force<4>(generator);
  EXPECT_TRUE(pairs_within<3>(Positions(3, 0), 1).empty());
}

}  // namespace
}  // namespace unsnarl
