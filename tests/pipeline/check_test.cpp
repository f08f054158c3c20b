#include "unsnarl/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "scene/shapes.h"

namespace unsnarl {
namespace {

// Two crossing bumps, the same far away with a deeper crossing, and a sheet that meets nothing.
Surface two_places() {
  shapes::Shape shape = shapes::crossing_bumps(10, 0.4);
  shape.add(shapes::crossing_bumps(10, 1.2), {50, 0, 0});
  shape.add(shapes::bumpy_sheet(3, 0), {0, 50, 0});
  return shape.surface();
}

TEST(Check, finds_what_find_intersections_finds) {
  const Surface surface = two_places();
  const CheckReport found = check(surface);
  EXPECT_EQ(found.pairs, find_intersections(surface));
  EXPECT_EQ(found.counts.total(), found.pairs.size());
  for (const IntersectingPair& pair : found.pairs)
    for (const std::int32_t f : {pair.a, pair.b})
      EXPECT_TRUE(std::binary_search(found.faces.begin(), found.faces.end(), f));
  EXPECT_EQ(found.triangulation, std::to_string(surface.view().face_count()) + " triangles as they are");
}

TEST(Check, places_are_listed_with_most_pairs_first) {
  const CheckReport found = check(two_places());
  ASSERT_EQ(found.places.size(), 2u);
  EXPECT_GT(found.places[0].pairs, found.places[1].pairs);
  EXPECT_EQ(found.places[0].pairs + found.places[1].pairs, found.pairs.size());
  EXPECT_EQ(found.places[0].faces.size() + found.places[1].faces.size(), found.faces.size());
  EXPECT_GT(found.places[0].bounds.min[0], 40);
  EXPECT_LT(found.places[1].bounds.max[0], 10);
}

TEST(Check, components_and_their_pairs) {
  const Surface surface = two_places();
  const CheckReport found = check(surface);
  ASSERT_EQ(found.components.size(), 5u);
  EXPECT_EQ(found.topology.components, 5u);
  EXPECT_EQ(found.intersecting_components, 4u);
  EXPECT_EQ(found.pairs_within_components, 0u);
  EXPECT_EQ(found.closed_non_orientable, 0u);
  EXPECT_EQ(found.components[0].pairs_with_others, found.places[1].pairs);
  const ComponentFindings& sheet = found.components[4];
  EXPECT_EQ(sheet.faces, 18u);
  EXPECT_EQ(sheet.vertices, 16u);
  EXPECT_EQ(sheet.first_face, static_cast<std::int32_t>(surface.view().face_count()) - 18);
  EXPECT_EQ(sheet.pairs_within + sheet.pairs_with_others, 0u);
  EXPECT_EQ(sheet.bounds.min, (std::array{-1.5, 48.5, 0.0}));
  EXPECT_EQ(sheet.bounds.max, (std::array{1.5, 51.5, 0.0}));
}

TEST(Check, vertices_of_components_are_those_of_the_mesh) {
  // A square of two triangles with corners of their own along the diagonal, and a triangle that meets none of them.
  const Surface surface{{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 9, 0, 0, 9, 1, 0, 8, 0, 0, 7, 7, 7},
                        {0, 1, 2, 3, 4, 5, 6, 7, 8},
                        {}};
  const CheckReport found = check(surface);
  ASSERT_EQ(found.components.size(), 2u);
  EXPECT_EQ(found.components[0].vertices, 6u);
  EXPECT_EQ(found.components[1].vertices, 3u);
}

TEST(Check, lists_the_first_pairs_and_counts_all) {
  const Surface surface = two_places();
  const CheckReport all = check(surface);
  for (const std::size_t listed : {std::size_t{0}, std::size_t{1}, all.pairs.size() / 3, 2 * all.pairs.size()}) {
    const CheckReport found = check(surface, {}, {.pairs_listed = listed});
    const std::size_t count = std::min(listed, all.pairs.size());
    EXPECT_EQ(found.pairs, std::vector(all.pairs.begin(), all.pairs.begin() + static_cast<std::ptrdiff_t>(count)));
    EXPECT_EQ(found.counts.by_class, all.counts.by_class);
    EXPECT_EQ(found.faces, all.faces);
    ASSERT_EQ(found.places.size(), all.places.size());
    EXPECT_EQ(found.places[0].pairs, all.places[0].pairs);
    EXPECT_EQ(found.places[0].faces, all.places[0].faces);
    EXPECT_EQ(found.components[0].pairs_with_others, all.components[0].pairs_with_others);
    EXPECT_EQ(found.intersecting_components, all.intersecting_components);
  }
}

/// Triangles that all run through the line of those before: every two intersect.
Surface bundle(std::int32_t count) {
  Surface surface;
  for (std::int32_t t = 0; t < count; ++t) {
    const double angle = 3 * static_cast<double>(t) / count, shift = 1e-3 * t;
    surface.positions.insert(surface.positions.end(), {-std::cos(angle), -std::sin(angle), shift - 9, std::cos(angle),
                                                       std::sin(angle), shift - 9, 0, 0, shift + 9});
    for (std::int32_t k = 0; k < 3; ++k) surface.corners.push_back(3 * t + k);
  }
  return surface;
}

TEST(Check, a_limit_ends_it) {
  const Surface surface = bundle(800);
  EXPECT_EQ(check(surface, {}, {.pairs_listed = 0}).counts.total(), 800u * 799 / 2);
  for (const CheckLimits& limits : {CheckLimits{.time_limit_s = 1e-9}, CheckLimits{.memory_limit_mb = 1e-9}}) {
    try {
      check(surface, {}, limits);
      ADD_FAILURE() << "no limit";
    } catch (const LimitReached& reached) {
      EXPECT_EQ(reached.status(), limits.time_limit_s > 0 ? Status::time_limit : Status::memory_limit);
    }
  }
  EXPECT_THROW(check(surface, {}, {.time_limit_s = -1}), std::invalid_argument);
}

TEST(Check, an_empty_surface_has_nothing) {
  const CheckReport found = check({});
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_TRUE(found.places.empty());
  EXPECT_TRUE(found.components.empty());
}

TEST(Check, refuses_what_makes_no_sense) {
  Surface surface = two_places();
  surface.corners[4] = 100000;
  EXPECT_THROW(check(surface), std::invalid_argument);
}

}  // namespace
}  // namespace unsnarl
