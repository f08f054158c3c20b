// The nearest free place, in families of motions whose free parameters are known.
#include "rigid/free_place.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace unsnarl {
namespace {

constexpr double margin = 0.05;

TEST(NearestFreePlace, is_the_one_of_least_displacement_whatever_the_parameter) {
  const std::vector<MotionFamily> families = {{10, 10, 1}, {100, 100, 0.01}};
  const std::array<double, 2> free_from = {2, 50};  // displacements 2 and 0.5
  const auto is_free = [&](std::size_t k, double parameter) { return parameter >= free_from[k]; };
  const auto place = nearest_free_place(families, is_free, {margin});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->family, 1u);
  EXPECT_GE(place->parameter, 50 * (1 + margin));
  EXPECT_LT(place->parameter, 51 * (1 + margin));
}

TEST(NearestFreePlace, keeps_no_clearance_where_that_is_not_free) {
  const std::vector<MotionFamily> families = {{10, 10}};
  const auto wide = [](std::size_t, double parameter) { return parameter >= 1.5 && parameter <= 5; };
  const auto found = nearest_free_place(families, wide, {4});
  ASSERT_TRUE(found);
  EXPECT_GE(found->parameter, 1.5);
  EXPECT_LE(found->parameter, 5);
}

TEST(NearestFreePlace, a_thorough_search_looks_into_the_step_beyond_the_best_place) {
  // The first family is free from a bit before a step on, the second from a bit behind the step before.
  double step = FreePlaceConstants::first_step;
  while (step < 0.2) step *= FreePlaceConstants::growth;
  const double next = FreePlaceConstants::growth * step;
  const std::vector<MotionFamily> families = {{1, 1}, {1, 1}};
  const std::array<double, 2> free_from = {0.9 * next, 1.1 * step};
  const auto is_free = [&](std::size_t k, double parameter) { return parameter >= free_from[k]; };
  EXPECT_EQ(nearest_free_place(families, is_free, {margin})->family, 0u);
  EXPECT_EQ(nearest_free_place(families, is_free, {margin, true})->family, 1u);
}

TEST(NearestFreePlace, there_may_be_none) {
  const std::vector<MotionFamily> families = {{1, 1}, {1, 1, 0}};
  EXPECT_FALSE(nearest_free_place(families, [](std::size_t, double) { return false; }, {margin}));
  EXPECT_FALSE(
      nearest_free_place(families, [](std::size_t, double) { return true; }, {margin, false, [] { return true; }}));
  EXPECT_FALSE(nearest_free_place({}, [](std::size_t, double) { return true; }, {margin}));
}

TEST(LatticeDirections, name_every_neighbour_of_a_cell_once_but_for_the_sign) {
  const std::vector<Vec3> directions = lattice_directions();
  EXPECT_EQ(directions.size(), 13u);
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NE(directions[i], directions[j]);
      EXPECT_NE(directions[i], -directions[j]);
    }
}

TEST(SomeContacts, are_spread_over_the_list) {
  std::vector<IntersectingPair> contacts(1000);
  for (Index k = 0; k < 1000; ++k) contacts[k] = {k, k + 1, PairClass::disjoint};
  const auto some = some_contacts(contacts);
  EXPECT_LE(some.size(), FreePlaceConstants::most_contacts);
  EXPECT_GT(some.back().a, 900);
  EXPECT_EQ(some_contacts(std::span(contacts).first(3)).size(), 3u);
}

}  // namespace
}  // namespace unsnarl
