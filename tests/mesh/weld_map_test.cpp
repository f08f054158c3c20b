#include "mesh/weld_map.h"

#include <gtest/gtest.h>

#include "mesh/lens.h"
#include "mesh/shapes.h"

namespace unsnarl {
namespace {

using namespace shapes;

void expect_consistent(const Surface& s, const WeldMap& id) {
  ASSERT_EQ(id.vertex_of.size(), s.positions.size() / 3);
  ASSERT_EQ(static_cast<std::size_t>(id.count), id.first.size());
  EXPECT_EQ(id.merged, id.vertex_of.size() - id.first.size());
  Index next = 0;
  for (std::size_t v = 0; v < id.vertex_of.size(); ++v) {
    ASSERT_LE(id.vertex_of[v], next);
    if (id.vertex_of[v] == next) {
      EXPECT_EQ(id.first[next++], static_cast<Index>(v));
    }
  }
}

Index count_of(const Surface& s, Weld kind = Weld::seams, double tolerance = 0) {
  const WeldMap id = weld(s, kind, tolerance);
  expect_consistent(s, id);
  return id.count;
}

TEST(WeldMap, none_keeps_every_vertex) {
  EXPECT_EQ(count_of(exploded(cube()), Weld::none), 24);
}

TEST(WeldMap, corners_of_a_soup_become_the_octahedron) {
  const Surface s = exploded(octahedron());
  EXPECT_EQ(count_of(s), 6);
  const WeldMap id = weld(s);
  for (std::size_t v = 0; v < id.vertex_of.size(); ++v)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(s.positions[3 * v + k], s.positions[3 * id.first[id.vertex_of[v]] + k]);
}

TEST(WeldMap, six_separate_quads_become_a_cube) {
  EXPECT_EQ(count_of(exploded(cube())), 8);
}

TEST(WeldMap, minus_zero_is_zero) {
  Surface s = exploded(cube());
  for (std::size_t i = 0; i < s.positions.size(); i += 2)
    if (s.positions[i] == 0) s.positions[i] = -0.0;
  EXPECT_EQ(count_of(s), 8);
  EXPECT_EQ(count_of(s, Weld::all), 8);
}

TEST(WeldMap, closed_solids_that_touch_stay_apart) {
  Surface s = cube();
  append(s, cube(), 1, 0, 0);  // share a face by position
  append(s, cube(), 0, 1, 1);  // an edge
  EXPECT_EQ(count_of(s), 24);
  EXPECT_EQ(count_of(s, Weld::all), 18);
}

TEST(WeldMap, soup_of_cubes_touching_in_a_face_stays_two_cubes) {
  Surface s = exploded(cube());
  append(s, exploded(cube()), 1, 0, 0);
  EXPECT_EQ(count_of(s), 16);
}

TEST(WeldMap, soup_of_cubes_touching_in_an_edge_stays_two_cubes) {
  Surface s = exploded(cube());
  append(s, exploded(cube()), 1, 1, 0);
  EXPECT_EQ(count_of(s), 16);
}

TEST(WeldMap, soup_of_cubes_touching_in_a_corner_stays_two_cubes) {
  Surface s = exploded(cube());
  append(s, exploded(cube()), 1, 1, 1);
  EXPECT_EQ(count_of(s), 16);
}

TEST(WeldMap, two_copies_of_a_solid_stay_two) {
  Surface s = exploded(octahedron());
  append(s, exploded(octahedron()));
  EXPECT_EQ(count_of(s), 12);
}

/// A strip of quads in the plane z = 0, front and back as separate sheets.
Surface card(Index n, bool soup) {
  Surface front, back;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j < 2; ++j) {
      add_vertex(front, i, j, 0);
      add_vertex(back, i, j, 0);
    }
  for (Index i = 0; i < n; ++i) {
    add_face(front, {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    add_face(back, {2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2});
  }
  Surface s = soup ? exploded(front) : front;
  append(s, soup ? exploded(back) : back);
  return s;
}

TEST(WeldMap, two_sided_card_is_not_glued) {
  EXPECT_EQ(count_of(card(4, false)), 20);
}
TEST(WeldMap, two_sided_card_as_soup_becomes_two_sheets) {
  EXPECT_EQ(count_of(card(4, true)), 20);
}

TEST(WeldMap, two_sided_card_hanging_on_one_edge_is_not_glued) {
  // Front and back share the vertices of one end, so that they are one shell.
  Surface s = card(4, false);
  for (Index& v : s.corners)
    if (v == 10 || v == 11) v -= 10;
  EXPECT_EQ(count_of(s), 20);  // 18 and the two that are not used now
}

TEST(WeldMap, seam_of_a_sheet_is_glued_also_where_orientations_differ) {
  for (const bool flipped : {false, true}) {
    Surface s;
    for (int i = 0; i < 2; ++i) {
      add_vertex(s, 0, 0, 0);
      add_vertex(s, 0, 1, 0);
      add_vertex(s, i == 0 ? -1 : 1, 0, 0);
    }
    add_face(s, {0, 2, 1});
    add_face(s, flipped ? std::vector<Index>{3, 5, 4} : std::vector<Index>{3, 4, 5});
    EXPECT_EQ(count_of(s), 4);
  }
}

/// Pages that meet in one edge, of one face or of two (with a vertex of two faces, so that ids say what is connected).
Surface pages_on_a_spine(int pages, int faces_of_a_page) {
  Surface s;
  for (int i = 0; i < pages; ++i) {
    const Index a = add_vertex(s, 0, 0, 0), b = add_vertex(s, 0, 0, 1), c = add_vertex(s, 1, i, 0.5);
    add_face(s, i % 2 == 0 ? std::vector<Index>{a, b, c} : std::vector<Index>{b, a, c});
    if (faces_of_a_page == 2) add_face(s, {c, b, add_vertex(s, 2, 2 * i, 1)});
  }
  return s;
}

TEST(WeldMap, pages_of_a_soup_are_welded_to_their_spine) {
  for (const int pages : {3, 4, 5, 12}) EXPECT_EQ(count_of(pages_on_a_spine(pages, 1)), 2 + pages);
}

TEST(WeldMap, sheets_stay_apart_where_seams_are_ambiguous) {
  for (const int pages : {3, 4, 5, 12}) EXPECT_EQ(count_of(pages_on_a_spine(pages, 2)), 4 * pages);
  EXPECT_EQ(count_of(pages_on_a_spine(2, 2)), 6);
}

TEST(WeldMap, edges_of_one_shell_find_their_partners_first) {
  // Two cubes cut open along the edge in which they touch.
  Surface s;
  for (const double d : {0.0, 1.0}) append(s, cube(), d, d, 0);
  // Vertices 3 and 7 of the first cube, 0 and 4 of the second (ids 8 and 12): copies for one face each.
  const Index copies[] = {add_vertex(s, 1, 1, 0), add_vertex(s, 1, 1, 1), add_vertex(s, 1, 1, 0),
                          add_vertex(s, 1, 1, 1)};
  const auto use_copies = [&](Index face, Index first, Index second, const Index* copy) {
    for (Index k = s.offsets[face]; k < s.offsets[face + 1]; ++k) {
      if (s.corners[k] == first) s.corners[k] = copy[0];
      if (s.corners[k] == second) s.corners[k] = copy[1];
    }
  };
  use_copies(3, 3, 7, copies);
  use_copies(8, 8, 12, copies + 2);
  const WeldMap map = weld(s);
  EXPECT_EQ(map.count, 16);
  EXPECT_EQ(map.vertex_of[3], map.vertex_of[16]);
  EXPECT_NE(map.vertex_of[3], map.vertex_of[8]);
}

TEST(WeldMap, pinched_interior_is_not_glued) {
  // Two pyramids whose apexes meet, joined by nothing else: interior vertices, hence apart.
  Surface s;
  for (int side = 0; side < 2; ++side) {
    const Index apex = add_vertex(s, 0, 0, 0);
    const double z = side == 0 ? 1 : -1;
    const Index a = add_vertex(s, 1, 0, z);
    add_vertex(s, 0, 1, z);
    add_vertex(s, -1, -1, z);
    for (Index k = 0; k < 3; ++k) add_face(s, {apex, a + k, a + (k + 1) % 3});
  }
  EXPECT_EQ(count_of(s), 8);
  EXPECT_EQ(count_of(s, Weld::all), 7);
}

TEST(WeldMap, sheet_wrapped_twice_keeps_both_layers) {
  const Index n = 8;  // quads a turn, sampled on the same points in both turns
  Surface s;
  for (Index i = 0; i <= 2 * n; ++i)
    for (Index j = 0; j < 3; ++j) add_vertex(s, std::cos((i % n) * 0.7), std::sin((i % n) * 0.7), j);
  for (Index i = 0; i < 2 * n; ++i)
    for (Index j = 0; j < 2; ++j) add_face(s, {3 * i + j, 3 * i + 3 + j, 3 * i + 4 + j, 3 * i + 1 + j});
  // The ends of the sheet meet each other (a closed double loop), the layers stay apart.
  EXPECT_EQ(count_of(s), 6 * n);
}

TEST(WeldMap, vertices_of_one_shell_without_a_common_open_edge_stay_apart) {
  // A strip of three quads bent to a ring whose ends touch in one corner.
  Surface s;
  s.positions = {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 0, 1, 0, 0, 2};
  for (Index i = 0; i < 3; ++i) add_face(s, {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  EXPECT_EQ(count_of(s), 8);
  EXPECT_EQ(count_of(s, Weld::all), 7);
}

TEST(WeldMap, inner_vertices_edges_and_fans_of_one_shell_stay_apart) {
  for (const LensPinch pinch : {LensPinch::vertices, LensPinch::edges, LensPinch::fans, LensPinch::all}) {
    const Surface s = lens(6, pinch);
    EXPECT_EQ(count_of(s), static_cast<Index>(s.positions.size() / 3));
    EXPECT_LT(count_of(s, Weld::all), static_cast<Index>(s.positions.size() / 3));
  }
}

TEST(WeldMap, the_ends_of_an_edge_of_length_zero_are_two_vertices) {
  for (const LensPinch pinch : {LensPinch::ends_of_an_edge, LensPinch::fan_in_a_point}) {
    const Surface s = lens(6, pinch);
    EXPECT_EQ(count_of(s), static_cast<Index>(s.positions.size() / 3));
  }
  // An open one is a point of the boundary: a fan whose apex was split.
  Surface s;
  s.positions = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0};
  add_face(s, {0, 2, 3});
  add_face(s, {1, 0, 3, 4});
  EXPECT_EQ(count_of(s), 4);
}

TEST(WeldMap, charts_that_meet_in_a_point_are_one_surface) {
  // A disc of six quads in three charts of two: their borders meet in the middle, of which each has a copy.
  Surface s;
  const auto rim = [&](int k) { return add_vertex(s, std::cos(k % 6 * 1.047), std::sin(k % 6 * 1.047), 0); };
  for (int chart = 0; chart < 3; ++chart) {
    const Index middle = add_vertex(s, 0, 0, 0), a = rim(2 * chart), b = rim(2 * chart + 1), c = rim(2 * chart + 2);
    add_face(s, {middle, a, b});
    add_face(s, {middle, b, c});
  }
  EXPECT_EQ(count_of(s), 7);
}

TEST(WeldMap, collapsed_cross_section_of_a_tube_stays_a_ring) {
  Surface s;
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 5; ++j) {
      const double r = i == 1 ? 0 : 1;
      add_vertex(s, r * std::cos(j * 1.257), r * std::sin(j * 1.257), i);
    }
  for (Index i = 0; i < 2; ++i)
    for (Index j = 0; j < 5; ++j) add_face(s, {5 * i + j, 5 * i + (j + 1) % 5, 5 * i + 5 + (j + 1) % 5, 5 * i + 5 + j});
  EXPECT_EQ(count_of(s), 15);
}

TEST(WeldMap, parts_of_a_soup_that_meet_in_single_border_vertices_are_joined) {
  // The border x = 0 is one edge on one side and two on the other.
  Surface s;
  s.positions = {-1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
  add_face(s, {0, 1, 2});
  add_face(s, {3, 4, 5});
  add_face(s, {6, 7, 8});
  EXPECT_EQ(count_of(s), 5);
  // With ids that say what is connected, parts that merely touch stay apart.
  s.corners = {0, 1, 2, 3, 4, 5, 5, 4, 8};
  const WeldMap id = weld(s);
  EXPECT_NE(id.vertex_of[1], id.vertex_of[3]);
  EXPECT_NE(id.vertex_of[2], id.vertex_of[8]);
}

TEST(WeldMap, tolerance_joins_near_corners) {
  Surface s = exploded(cube());
  for (std::size_t i = 0; i < s.positions.size(); ++i) s.positions[i] += 1e-7 * static_cast<double>(i);
  EXPECT_EQ(count_of(s), 24);
  EXPECT_EQ(count_of(s, Weld::seams, 2e-5), 8);
  EXPECT_EQ(count_of(s, Weld::all, 2e-5), 8);
  EXPECT_EQ(count_of(s, Weld::all, 1e-8), 24);
}

TEST(WeldMap, tolerance_works_across_cells_and_far_from_the_origin) {
  Surface s;
  add_vertex(s, 1e9, -0.001, 0);
  add_vertex(s, 1e9, 0.001, 0);
  add_vertex(s, 1e9, 0.1, 0);
  EXPECT_EQ(count_of(s, Weld::all, 0.01), 2);
}

TEST(WeldMap, nothing_in) {
  EXPECT_EQ(count_of(Surface{}), 0);
}

}  // namespace
}  // namespace unsnarl
