// What must be true of find_intersections whatever the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>

#include "oracle/intersections_oracle.h"
#include "property/meshes.h"
#include "unsnarl/intersections.h"

namespace unsnarl {
namespace {

std::vector<oracle::OracleTriangle> triangles_of(const Surface& surface) {
  std::vector<oracle::OracleTriangle> triangles;
  for (std::size_t f = 0; f < surface.view().face_count(); ++f) {
    const auto face = surface.view().face(f);
    triangles.push_back({face[0], face[1], face[2]});
  }
  return triangles;
}

std::vector<Surface> test_meshes() {
  return {meshes::tube(),         meshes::torus(),         meshes::touching_tori(),
          meshes::curled_strip(), meshes::dented_sheets(), meshes::klein_bottle()};
}

/// An order of n things that is the same everywhere.
meshes::Ids shuffled(std::size_t n, unsigned seed) {
  meshes::Ids order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<std::int32_t>(k);
  std::mt19937 random(seed);
  for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[random() % k]);
  return order;
}

TEST(IntersectionsProperties, agree_with_cgal) {
  for (const Surface& surface : test_meshes())
    EXPECT_TRUE(find_intersections(surface, {.weld = Weld::none}) ==
                oracle::intersections_by_cgal(surface.positions, triangles_of(surface)));
  EXPECT_TRUE(find_intersections(meshes::torus()).empty());
  EXPECT_FALSE(find_intersections(meshes::touching_tori()).empty());
}

TEST(IntersectionsProperties, follow_the_relabelling_of_faces_and_vertices) {
  for (const Surface& surface : test_meshes()) {
    const auto vertices = shuffled(surface.view().vertex_count(), 1), faces = shuffled(surface.view().face_count(), 2);
    Surface relabelled;
    relabelled.positions.resize(surface.positions.size());
    for (std::size_t v = 0; v < vertices.size(); ++v)
      std::copy_n(&surface.positions[3 * v], 3, &relabelled.positions[3 * vertices[v]]);
    relabelled.corners.resize(surface.corners.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)  // corners turned, and every other face turned over
        relabelled.corners[3 * faces[f] + (f % 2 ? (k + f) % 3 : 2 - k)] = vertices[surface.corners[3 * f + k]];
    auto expected = find_intersections(surface);
    for (IntersectingPair& pair : expected) {
      pair.a = faces[pair.a], pair.b = faces[pair.b];
      if (pair.a > pair.b) std::swap(pair.a, pair.b);
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_TRUE(find_intersections(relabelled) == expected);
  }
}

TEST(IntersectionsProperties, are_the_same_at_any_thread_count) {
  for (const Surface& surface : test_meshes()) {
    const auto expected = find_intersections(surface, {.threads = 1});
    for (const int threads : {2, 4}) EXPECT_TRUE(find_intersections(surface, {.threads = threads}) == expected);
  }
}

TEST(IntersectionsProperties, are_sorted_unique_and_counted) {
  for (const Surface& surface : test_meshes()) {
    const auto pairs = find_intersections(surface);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    EXPECT_TRUE(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end());
    EXPECT_EQ(count_by_class(pairs).total(), pairs.size());
  }
}

TEST(IntersectionsProperties, seams_are_no_intersections_unless_asked) {
  // Every triangle with vertices of its own, as in STL.
  const Surface torus = meshes::torus();
  Surface split;
  for (const std::int32_t v : torus.corners) {
    split.corners.push_back(static_cast<std::int32_t>(split.corners.size()));
    split.positions.insert(split.positions.end(), &torus.positions[3 * v], &torus.positions[3 * v] + 3);
  }
  EXPECT_TRUE(find_intersections(split).empty());
  EXPECT_TRUE(find_intersections(split, {.weld = Weld::all}).empty());
  EXPECT_FALSE(find_intersections(split, {.weld = Weld::none}).empty());
}

TEST(IntersectionsProperties, polygons_are_reported_by_their_own_ids) {
  // Two quads that cross, and one apart from them.
  Surface surface;
  surface.positions = {0,   0,   0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, -1, 1.3, 1.1, -1,
                       1.3, 1.1, 1, 1, 1, 1, 9, 0, 0, 9, 1, 0, 9, 1, 1,  9,   0,   1};
  surface.corners = {8, 9, 10, 11, 0, 1, 2, 3, 4, 5, 6, 7};
  surface.offsets = {0, 4, 8, 12};
  const auto pairs = find_intersections(surface);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_TRUE((pairs[0] == IntersectingPair{1, 2, PairClass::disjoint}));
}

TEST(IntersectionsProperties, senseless_input_is_refused) {
  Surface surface = meshes::tube();
  surface.corners[5] = static_cast<std::int32_t>(surface.view().vertex_count());
  EXPECT_THROW(find_intersections(surface), std::invalid_argument);
  surface.corners[5] = -1;
  EXPECT_THROW(find_intersections(surface), std::invalid_argument);
  surface = meshes::tube();
  surface.positions[7] = std::nan("");
  EXPECT_THROW(find_intersections(surface), std::invalid_argument);
}

TEST(IntersectionsProperties, nothing_in_nothing) {
  EXPECT_TRUE(find_intersections(Surface{}).empty());
}

}  // namespace
}  // namespace unsnarl
