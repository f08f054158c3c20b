#include "mesh/progressive_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "geometry/parallel.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "scene/shapes.h"
#include "untangle/tangled_shapes.h"

namespace unsnarl {
namespace {

std::vector<std::uint8_t> all_free(const shapes::Shape& shape) {
  return std::vector<std::uint8_t>(shape.points.size(), 0);
}

/// Vertices minus edges plus faces.
int euler_characteristic(std::span<const Triangle> triangles) {
  std::set<Index> vertices;
  for (const Triangle& t : triangles) vertices.insert(t.begin(), t.end());
  return static_cast<int>(vertices.size() + triangles.size()) - static_cast<int>(build_edges(triangles).edges.size());
}

/// Edges of one face, as often as there are, and none of more than two.
std::size_t boundary_edges(std::span<const Triangle> triangles) {
  const EdgeTable edges = build_edges(triangles);
  std::size_t count = 0;
  for (Index e = 0; e < edges.triangles_of_edge.size(); ++e) {
    EXPECT_LE(edges.triangles_of_edge[e].size(), 2u);
    count += edges.triangles_of_edge[e].size() == 1;
  }
  return count;
}

Index coarsen_as_far_as_possible(ProgressiveMesh& mesh, const Positions& x) {
  Index removed = 0;
  for (Index now; (now = mesh.coarsen(x)) > 0;) removed += now;
  return removed;
}

TEST(ProgressiveMesh, counts_the_faces_that_are_there) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 2, 6);
  ProgressiveMesh mesh(sheet.triangles, all_free(sheet));
  ASSERT_GT(mesh.coarsen(sheet.positions()), 0);
  const auto ids = static_cast<Index>(sheet.triangles.size());
  EXPECT_EQ(mesh.count_below(ids), mesh.faces().size());
  const auto below = std::count_if(mesh.faces().begin(), mesh.faces().end(), [&](Index t) { return t < ids / 2; });
  EXPECT_EQ(mesh.count_below(ids / 2), static_cast<std::size_t>(below));
  EXPECT_EQ(mesh.count_below(0), 0u);
}

TEST(ProgressiveMesh, undoing_all_rounds_gives_the_same_mesh) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 2, 6);
  const Positions x = sheet.positions();
  ProgressiveMesh mesh(sheet.triangles, all_free(sheet));
  std::vector<std::vector<Triangle>> before;
  for (int round = 0; round < 6; ++round) {
    before.push_back(mesh.triangles());
    ASSERT_GT(mesh.coarsen(x), 0);
  }
  EXPECT_LT(mesh.faces().size(), sheet.triangles.size() / 3);
  while (mesh.round_count() > 0) {
    mesh.refine();
    EXPECT_EQ(mesh.triangles(), before.back());
    before.pop_back();
  }
  EXPECT_TRUE(mesh.refine().empty());
}

TEST(ProgressiveMesh, a_flat_sheet_keeps_its_area_and_its_boundary_its_length) {
  const shapes::Shape sheet = shapes::bumpy_sheet(20, 0);
  const Positions x = sheet.positions();
  ProgressiveMesh mesh(sheet.triangles, all_free(sheet));
  coarsen_as_far_as_possible(mesh, x);
  const std::vector<Triangle> coarse = mesh.triangles();
  EXPECT_LT(coarse.size(), sheet.triangles.size() / 10);
  EXPECT_NEAR(total_area(x, coarse), 400, 1e-9);
  EXPECT_LT(boundary_edges(coarse), 40u) << "vertices of the boundary go too";
  EXPECT_EQ(euler_characteristic(coarse), 1);
}

TEST(ProgressiveMesh, keeps_the_topology) {
  shapes::Shape torus = shapes::grid(30, 16, true, [](double i, double j) {
    const double u = 2 * M_PI * i / 30, v = 2 * M_PI * j / 16, r = 3 + std::cos(v);
    return Vec3(r * std::cos(u), r * std::sin(u), std::sin(v));
  });
  // The last ring is the first.
  for (Triangle& t : torus.triangles)
    for (Index& v : t) v %= 30 * 16;
  torus.points.resize(30 * 16);
  const Positions x = torus.positions();
  ProgressiveMesh mesh(torus.triangles, all_free(torus));
  const Index removed = coarsen_as_far_as_possible(mesh, x);
  EXPECT_GT(removed, 200);
  const std::vector<Triangle> coarse = mesh.triangles();
  EXPECT_EQ(euler_characteristic(coarse), 0);
  EXPECT_EQ(boundary_edges(coarse), 0u);
}

TEST(ProgressiveMesh, goes_down_to_a_handful_of_faces_of_any_shape_with_or_without_an_orientation) {
  const shapes::Shape torus = shapes::figure_eight_torus(), band = shapes::punctured_cross_cap();
  for (const shapes::Shape& shape : {torus, band}) {
    const Positions x = shape.positions();
    ProgressiveMesh mesh(shape.triangles, all_free(shape));
    const std::size_t boundary = boundary_edges(shape.triangles);
    EXPECT_EQ(boundary > 0, shape.points.size() == band.points.size());
    EXPECT_EQ(euler_characteristic(mesh.triangles()), 0);
    while (mesh.coarsen(x) > 0 || mesh.coarsen(x, CoarsenOptions::any_shape()) > 0) {
    }
    EXPECT_LE(mesh.faces().size(), 60u);
    EXPECT_EQ(euler_characteristic(mesh.triangles()), 0);
    EXPECT_EQ(boundary_edges(mesh.triangles()) > 0, boundary > 0);
    while (!mesh.refine().empty()) {
    }
    EXPECT_EQ(mesh.triangles(), shape.triangles);
  }
}

TEST(ProgressiveMesh, stops_at_what_has_no_smaller_triangulation) {
  // Every edge of a tetrahedron is in a triangle of edges that is no hole: whatever is collapsed would be flat.
  const shapes::Shape tetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  ProgressiveMesh mesh(tetrahedron.triangles, all_free(tetrahedron));
  CoarsenOptions anything;
  anything.least_cosine = -2;
  anything.least_quality = 0;
  anything.largest_offset = 100;
  EXPECT_EQ(mesh.coarsen(tetrahedron.positions(), anything), 0);
}

TEST(ProgressiveMesh, what_stays_and_what_several_fans_share_is_kept) {
  shapes::Shape sheet = shapes::bumpy_sheet(12, 0);
  std::vector<std::uint8_t> ranks = all_free(sheet);
  for (std::size_t v = 0; v < ranks.size(); ++v) ranks[v] = sheet.points[v][0] < 0 ? ProgressiveMesh::stays : 0;
  // A second sheet that hangs on the first by a vertex.
  const Index hinge = 13 * 9 + 6, first = static_cast<Index>(sheet.points.size());
  sheet.add(shapes::bumpy_sheet(4, 0), {3, 0, 1});
  for (Triangle& t : sheet.triangles) std::replace(t.begin(), t.end(), first + 12, hinge);
  ranks.resize(sheet.points.size(), 0);
  ProgressiveMesh mesh(sheet.triangles, ranks);
  coarsen_as_far_as_possible(mesh, sheet.positions());
  std::set<Index> left;
  for (const Triangle& t : mesh.triangles()) left.insert(t.begin(), t.end());
  for (std::size_t v = 0; v < ranks.size(); ++v) {
    EXPECT_TRUE(ranks[v] == 0 || left.contains(static_cast<Index>(v)));
  }
  EXPECT_TRUE(left.contains(hinge));
  EXPECT_LT(left.size(), sheet.points.size() * 3 / 4);
}

TEST(ProgressiveMesh, a_vertex_is_collapsed_only_onto_one_of_its_rank_or_above) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 0);
  std::vector<std::uint8_t> ranks = all_free(sheet);
  for (std::size_t v = 0; v < ranks.size(); ++v) ranks[v] = sheet.points[v][0] < 0;
  ProgressiveMesh mesh(sheet.triangles, ranks);
  coarsen_as_far_as_possible(mesh, sheet.positions());
  std::array<int, 2> removed = {0, 0};
  while (mesh.round_count() > 0)
    for (const ProgressiveMesh::Removal& removal : mesh.refine()) {
      EXPECT_GE(ranks[removal.parent], ranks[removal.vertex]);
      ++removed[ranks[removal.vertex]];
    }
  EXPECT_GT(removed[0], 100);
  EXPECT_GT(removed[1], 100);
}

TEST(ProgressiveMesh, keeps_vertices_of_a_rank_where_all_others_may_lose_their_shape) {
  const shapes::Shape sheet = shapes::bumpy_sheet(24, 0.2);
  const Positions x = sheet.positions();
  std::vector<std::uint8_t> ranks = all_free(sheet);
  for (std::size_t v = 0; v < ranks.size(); ++v) ranks[v] = sheet.points[v][0] < 0;
  const auto left_of = [&](const CoarsenOptions& any_shape) {
    ProgressiveMesh mesh(sheet.triangles, ranks);
    while (mesh.coarsen(x, any_shape) > 0) {
    }
    std::set<Index> left;
    for (const Triangle& t : mesh.triangles()) left.insert(t.begin(), t.end());
    return left;
  };
  const std::set<Index> all = left_of(CoarsenOptions::any_shape()), kept = left_of(CoarsenOptions::any_shape(1));
  for (std::size_t v = 0; v < ranks.size(); ++v) {
    EXPECT_TRUE(ranks[v] == 0 || kept.contains(static_cast<Index>(v)));
  }
  EXPECT_LT(all.size(), kept.size() / 10);
}

TEST(ProgressiveMesh, records_where_a_vertex_lay_on_the_fan_that_replaced_its_star) {
  const shapes::Shape sheet = shapes::bumpy_sheet(16, 0);
  const Positions x = sheet.positions();
  ProgressiveMesh mesh(sheet.triangles, all_free(sheet));
  mesh.coarsen(x);
  const std::vector<Triangle> coarse = mesh.triangles();
  for (const ProgressiveMesh::Removal& removal : mesh.refine()) {
    Vec3 p = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p += removal.weights[k] * x.col(removal.corners[k]);
    EXPECT_LT((p - x.col(removal.vertex)).norm(), 1e-12);
    EXPECT_EQ(removal.corners[0], removal.parent);
    Triangle corners = removal.corners;
    std::sort(corners.begin(), corners.end());
    EXPECT_TRUE(std::any_of(coarse.begin(), coarse.end(), [&](Triangle t) {
      std::sort(t.begin(), t.end());
      return t == corners;
    }));
    EXPECT_EQ(removal.star.size(),
              static_cast<std::size_t>(std::count_if(mesh.faces().begin(), mesh.faces().end(), [&](Index t) {
                return std::find(mesh[t].begin(), mesh[t].end(), removal.vertex) != mesh[t].end();
              })));
  }
}

TEST(ProgressiveMesh, is_the_same_with_any_number_of_threads) {
  const shapes::Shape sheet = shapes::bumpy_sheet(40, 3, 6);
  const Positions x = sheet.positions();
  std::vector<Triangle> expected;
  for (const std::size_t threads : {1u, 2u, 4u}) {
    const ThreadLimit control(threads);
    ProgressiveMesh mesh(sheet.triangles, all_free(sheet));
    for (int round = 0; round < 5; ++round) mesh.coarsen(x);
    if (threads == 1) expected = mesh.triangles();
    EXPECT_EQ(mesh.triangles(), expected);
  }
}

}  // namespace
}  // namespace unsnarl
