#include "mesh/components.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

Index vertex_count(const std::vector<Triangle>& triangles) {
  Index n = 0;
  for (const Triangle& t : triangles) n = std::max({n, t[0] + 1, t[1] + 1, t[2] + 1});
  return n;
}

/// Finds the components of a surface whose faces are these triangles.
Components components_of(const std::vector<Triangle>& triangles) {
  Surface surface;
  surface.positions.assign(3 * static_cast<std::size_t>(vertex_count(triangles)), 0);
  for (const Triangle& t : triangles) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
  return find_components(surface, weld(surface, Weld::none), triangles, build_edges(triangles));
}

Component only_component(const std::vector<Triangle>& triangles) {
  const Components found = components_of(triangles);
  EXPECT_EQ(found.count(), 1);
  return found.list.at(0);
}

TEST(Components, torus_is_closed_and_orientable) {
  const Component torus = only_component(torus_triangles(6, 5));
  EXPECT_TRUE(torus.closed());
  EXPECT_TRUE(torus.orientable);
  EXPECT_FALSE(torus.obstructed());
  EXPECT_EQ(torus.euler_characteristic(), 0);
  EXPECT_EQ(torus.vertices, 30);
}

TEST(Components, turned_triangles_do_not_make_it_non_orientable) {
  std::vector<Triangle> triangles = torus_triangles(6, 5);
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i][0], triangles[i][1]);
  EXPECT_TRUE(only_component(triangles).orientable);
}

TEST(Components, klein_bottle_is_obstructed) {
  const Component bottle = only_component(klein_bottle_triangles(6, 5));
  EXPECT_TRUE(bottle.closed());
  EXPECT_FALSE(bottle.orientable);
  EXPECT_TRUE(bottle.obstructed());
  EXPECT_EQ(bottle.euler_characteristic(), 0);
}

TEST(Components, moebius_strip_has_a_boundary_and_may_be_embedded) {
  const Component strip = only_component(moebius_triangles(7, 2));
  EXPECT_FALSE(strip.closed());
  EXPECT_FALSE(strip.orientable);
  EXPECT_FALSE(strip.obstructed());
  EXPECT_EQ(strip.boundary_edges, 14);
  EXPECT_EQ(strip.euler_characteristic(), 0);
}

TEST(Components, are_numbered_by_their_first_faces) {
  std::vector<Triangle> triangles = {{7, 8, 9}, {0, 1, 2}, {8, 9, 10}, {2, 3, 4}};
  const Components found = components_of(triangles);
  ASSERT_EQ(found.count(), 2);
  EXPECT_EQ(found.component_of_triangle, (std::vector<Index>{0, 1, 0, 1}));
  EXPECT_EQ(found.component_of_vertex[5], -1);
  EXPECT_EQ(found.component_of_vertex[10], 0);
  EXPECT_EQ(found.list[1].first_triangle, 1);
  EXPECT_EQ(found.list[1].vertices, 5);
  EXPECT_EQ(count_non_manifold_vertices(triangles, 12, build_edges(triangles)), 1u);  // vertex 2: a bow tie
}

TEST(Components, three_sheets_on_one_edge_are_not_manifold) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const Component component = only_component(triangles);
  EXPECT_EQ(component.non_manifold_edges, 1);
  EXPECT_EQ(component.boundary_edges, 6);
  EXPECT_FALSE(component.closed());
  EXPECT_EQ(count_non_manifold_vertices(triangles, 5, build_edges(triangles)), 0u);
}

TEST(Components, duplicates_are_found_in_any_order_of_corners) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {3, 1, 0}, {2, 0, 1}, {0, 1, 3}, {2, 1, 0}, {4, 5, 6}};
  EXPECT_EQ(duplicate_triangles(triangles), (std::vector<std::vector<Index>>{{0, 2, 4}, {1, 3}}));
}

TEST(Components, every_corner_of_a_face_has_one) {
  const std::vector<double> positions(27, 0.0);
  // A polygon of which one corner is in no triangle, one without corners, and one without triangles.
  const std::vector<std::int32_t> corners = {3, 0, 1, 2, 6, 7}, offsets = {0, 4, 4, 6};
  const SurfaceView surface{positions, corners, offsets};
  const WeldMap as_it_is{.vertex_of = {0, 1, 2, 3, 4, 5, 6, 7, 8}, .first = {0, 1, 2, 3, 4, 5, 6, 7, 8}, .count = 9};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const Components found = find_components(surface, as_it_is, triangles, build_edges(triangles));
  EXPECT_EQ(found.component_of_vertex, (std::vector<Index>{0, 0, 0, 0, -1, -1, 1, 1, -1}));
  EXPECT_EQ(found.component_of_triangle, (std::vector<Index>{0}));
  ASSERT_EQ(found.count(), 2);
  EXPECT_EQ(found.list[0].vertices, 3);
  EXPECT_EQ(found.list[0].euler_characteristic(), 1);
  EXPECT_EQ(found.list[1].first_triangle, -1);
  EXPECT_FALSE(found.list[1].closed());
  EXPECT_EQ(component_of_face(surface, as_it_is, found, 0), 0);
  EXPECT_EQ(component_of_face(surface, as_it_is, found, 1), -1);
  EXPECT_EQ(component_of_face(surface, as_it_is, found, 2), 1);
}

}  // namespace
}  // namespace unsnarl
