// Surfaces that are to lie inside each other: which way they go, and what is said of it.
#include "unsnarl/nesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "unsnarl/parts.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

/// Components of a sample as surfaces, by their numbers.
Nesting nesting_of(const Surface& surface, std::vector<std::vector<std::int32_t>> chains) {
  Nesting nesting;
  nesting.surface_of_vertex.assign(surface.view().vertex_count(), -1);
  const std::vector<std::int32_t> component_of = component_of_faces(surface);
  for (std::size_t f = 0; f < component_of.size(); ++f)
    for (const std::int32_t v : surface.view().face(f)) nesting.surface_of_vertex[v] = component_of[f];
  nesting.chains = std::move(chains);
  return nesting;
}

std::vector<NestedPair> pairs_of(const Surface& surface, const std::vector<double>& positions, const Nesting& nesting) {
  const Surface moved = {positions, surface.corners, surface.offsets};
  return nested_pairs(surface, positions, find_intersections(moved), nesting);
}

/// Spheres of radius 0.9 and 1, the smaller one `shift` off.
Surface two_spheres(double shift, int resolution = 28) {
  Surface all = make_sample("crossing_shells", resolution, {{"shift", shift}, {"waves", 0}}), two;
  const std::size_t vertices = all.view().vertex_count() / 3 * 2, faces = all.view().face_count() / 3 * 2;
  two.positions.assign(all.positions.begin(), all.positions.begin() + static_cast<std::ptrdiff_t>(3 * vertices));
  two.corners.assign(all.corners.begin(), all.corners.begin() + static_cast<std::ptrdiff_t>(3 * faces));
  return two;
}

/// 40, 53, 60 % of the area of the inner one are outside; without nesting the last two end outside altogether.
TEST(Nesting, the_inner_surface_goes_in_even_where_most_of_it_is_outside) {
  for (const double shift : {0.29, 0.5, 0.65}) {
    const Surface surface = two_spheres(shift);
    const Nesting nesting = nesting_of(surface, {{0, 1}});
    const RepairResult plain = repair(surface), nested = repair_nested(surface, nesting);
    ASSERT_EQ(plain.status, Status::embedded);
    ASSERT_EQ(nested.status, Status::embedded);
    const NestedPair before = pairs_of(surface, plain.positions, nesting)[0],
                     after = pairs_of(surface, nested.positions, nesting)[0];
    EXPECT_EQ(before.is_nested, shift < 0.6);  // without a word on nesting, the nearer way is taken
    EXPECT_TRUE(after.is_nested);
    EXPECT_GT(after.wrong_before, 150u);
    EXPECT_EQ(after.wrong_after, 0u);
    EXPECT_LT(nested.report.displacement_max_rel, 1.05 * plain.report.displacement_max_rel);
    EXPECT_EQ(nested.report.regions[0].strategy, "nesting");
  }
}

TEST(Nesting, what_is_held_stays_and_the_other_goes_all_the_way) {
  const Surface surface = two_spheres(0.5);
  const Nesting nesting = nesting_of(surface, {{0, 1}});
  for (const std::int32_t held : {0, 1}) {
    RepairOptions options;
    for (const std::int32_t s : nesting.surface_of_vertex) options.fixed.push_back(s == held);
    const RepairResult result = repair_nested(surface, nesting, options);
    ASSERT_EQ(result.status, Status::embedded);
    EXPECT_TRUE(pairs_of(surface, result.positions, nesting)[0].is_nested);
    for (std::size_t i = 0; i < result.positions.size(); ++i) {
      if (options.fixed[i / 3]) {
        ASSERT_EQ(result.positions[i], surface.positions[i]);
      }
    }
  }
}

TEST(Nesting, three_surfaces_that_all_cross_end_in_order) {
  const Surface surface = make_sample("crossing_shells", 40);
  const Nesting nesting = nesting_of(surface, {{0, 1, 2}});
  RepairOptions options;
  options.find.threads = 1;
  const RepairResult one = repair_nested(surface, nesting, options);
  options.find.threads = 2;
  const RepairResult two = repair_nested(surface, nesting, options);
  EXPECT_EQ(one.positions, two.positions);
  ASSERT_EQ(one.status, Status::embedded);
  const std::vector<NestedPair> pairs = pairs_of(surface, one.positions, nesting);
  ASSERT_EQ(pairs.size(), 2u);
  for (const NestedPair& pair : pairs) EXPECT_TRUE(pair.is_nested) << pair.inner << " in " << pair.outer;
}

/// Faces on faces: neither way is nearer.
TEST(Nesting, equal_surfaces_end_the_inner_one_inside) {
  Surface surface = two_spheres(0);
  const std::size_t half = surface.positions.size() / 2;
  for (std::size_t i = 0; i < half; ++i) surface.positions[i] = surface.positions[half + i];
  for (const auto& chain : {std::vector<std::int32_t>{0, 1}, {1, 0}}) {
    const Nesting nesting = nesting_of(surface, {chain});
    const RepairResult result = repair_nested(surface, nesting);
    ASSERT_EQ(result.status, Status::embedded);
    EXPECT_TRUE(pairs_of(surface, result.positions, nesting)[0].is_nested);
  }
}

/// Their orientation says nothing.
TEST(Nesting, surfaces_may_be_inside_out) {
  Surface surface = two_spheres(0.5);
  for (std::size_t f = 0; f < surface.corners.size() / 6; ++f)
    std::swap(surface.corners[3 * f], surface.corners[3 * f + 1]);
  const Nesting nesting = nesting_of(surface, {{0, 1}});
  const RepairResult result = repair_nested(surface, nesting);
  ASSERT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(pairs_of(surface, result.positions, nesting)[0].is_nested);
}

TEST(Nesting, what_crosses_nothing_is_left_and_told) {
  Surface surface = two_spheres(0);
  for (std::size_t i = 0; i < surface.positions.size() / 2; i += 3) surface.positions[i] += 3;  // beside each other
  const Nesting nesting = nesting_of(surface, {{0, 1}});
  const RepairResult result = repair_nested(surface, nesting);
  EXPECT_EQ(result.positions, surface.positions);
  const std::vector<NestedPair> pairs = pairs_of(surface, result.positions, nesting);
  EXPECT_FALSE(pairs[0].is_nested);
  EXPECT_EQ(pairs[0].wrong_after, surface.view().vertex_count() / 2);
  EXPECT_EQ(pairs[0].apart, std::vector<std::int32_t>{0});
  EXPECT_EQ(outcome(result.status, pairs), "not_nested");
  EXPECT_EQ(exit_code_of(result.status, pairs), exit_obstructed);
  const Surface concentric = two_spheres(0);
  const std::vector<NestedPair> right = pairs_of(concentric, concentric.positions, nesting_of(concentric, {{0, 1}}));
  EXPECT_TRUE(right[0].is_nested);
  EXPECT_TRUE(right[0].apart.empty());
  EXPECT_EQ(outcome(Status::embedded, right), "embedded");
  EXPECT_EQ(outcome(Status::reduced, pairs), "reduced");
}

TEST(Nesting, an_order_that_is_the_other_way_round_is_refused_before_any_work) {
  const Surface surface = two_spheres(0);
  const Nesting swapped = nesting_of(surface, {{1, 0}});
  for (const auto& call : {std::function<void()>([&] { check_nesting(surface, swapped); }),
                           std::function<void()>([&] { repair_nested(surface, swapped); })}) {
    try {
      call();
      ADD_FAILURE();
    } catch (const std::invalid_argument& e) {
      EXPECT_STREQ(e.what(),
                   "nested: 1 is to lie inside 0, but holds all of it, and no faces of the two meet; a chain goes from "
                   "the innermost out: is it the wrong way round?");
    }
  }
  // The order may be meant where the two cross: the larger one is made to fit.
  const Surface crossing = two_spheres(0.2);
  const Nesting odd = nesting_of(crossing, {{1, 0}});
  const std::vector<std::string> doubts = check_nesting(crossing, odd);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_NE(doubts[0].find("1 has 1.4 times the volume of 0"), std::string::npos) << doubts[0];
  EXPECT_TRUE(check_nesting(crossing, nesting_of(crossing, {{0, 1}})).empty());
}

TEST(Nesting, faces_that_meet_are_not_nested_although_no_vertex_is_wrong) {
  Surface surface = two_spheres(0);
  const Nesting nesting = nesting_of(surface, {{0, 1}});
  const std::vector<IntersectingPair> met = {
      {0, static_cast<std::int32_t>(surface.view().face_count()) - 1, PairClass::disjoint}};
  const std::vector<NestedPair> pairs = nested_pairs(surface, surface.positions, met, nesting);
  EXPECT_EQ(pairs[0].wrong_after, 0u);
  EXPECT_FALSE(pairs[0].is_nested);
}

TEST(Nesting, what_makes_no_sense_is_refused) {
  Surface surface = two_spheres(0.5, 8);
  const auto expect_refusal = [&](std::vector<std::vector<std::int32_t>> chains, const std::string& words,
                                  const RepairOptions& options = {}) {
    try {
      repair_nested(surface, nesting_of(surface, std::move(chains)), options);
      ADD_FAILURE() << words;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  expect_refusal({{0}}, "needs two surfaces");
  expect_refusal({{0, 2}}, "there is no surface 2");
  expect_refusal({{0, 1, 0}}, "inside itself");
  expect_refusal({{0, 1}, {1, 0}}, "inside itself");
  RepairOptions each;
  each.each_component = true;
  expect_refusal({{0, 1}}, "each_component", each);
  surface.corners.resize(surface.corners.size() - 3);
  expect_refusal({{0, 1}}, "not closed");
  // An open surface may be the innermost.
  const Nesting open_in_closed = nesting_of(surface, {{1, 0}});
  const RepairResult result = repair_nested(surface, open_in_closed);
  EXPECT_EQ(result.status, Status::embedded);
  EXPECT_TRUE(pairs_of(surface, result.positions, open_in_closed)[0].is_nested);
}

}  // namespace
}  // namespace unsnarl
