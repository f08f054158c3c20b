#include "scene/diagnose.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/shapes.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

Diagnosis diagnosis_of(const Surface& surface, const std::vector<std::uint8_t>& fixed = {},
                       const FindOptions& find = {}) {
  const PreparedSurface prepared = prepare(surface, find);
  IntersectionFinder finder(prepared.triangles(), prepared.passing());
  return diagnose(surface, prepared, fixed, finder);
}

Surface appended(Surface surface, const Surface& other, double shift) {
  const auto first = static_cast<std::int32_t>(surface.view().vertex_count());
  for (std::size_t k = 0; k < other.positions.size(); ++k)
    surface.positions.push_back(other.positions[k] + (k % 3 == 0 ? shift : 0));
  for (std::size_t f = 0; f < other.view().face_count(); ++f) {
    const auto corners = other.view().face(f);
    for (const std::int32_t v : corners) surface.corners.push_back(first + v);
    surface.offsets.push_back(surface.offsets.back() + static_cast<std::int32_t>(corners.size()));
  }
  return surface;
}

TEST(Diagnose, an_embedded_surface_has_nothing) {
  const Diagnosis diagnosis = diagnosis_of(shapes::bumpy_sheet(4, 0.5).surface());
  EXPECT_TRUE(diagnosis.pairs.empty());
  EXPECT_TRUE(diagnosis.obstructions.empty());
  EXPECT_TRUE(diagnosis.obstructed.empty());
  EXPECT_EQ(diagnosis.topology.vertices, 25u);
  EXPECT_EQ(diagnosis.topology.faces, 32u);
  EXPECT_EQ(diagnosis.topology.components, 1u);
  EXPECT_EQ(diagnosis.topology.boundary_edges, 16u);
}

TEST(Diagnose, crossings_are_no_obstruction) {
  const Shape shape = shapes::crossing_bumps(8, 0.4);
  const Diagnosis diagnosis = diagnosis_of(shape.surface());
  EXPECT_TRUE(diagnosis.pairs == shapes::pairs_of(shape));
  EXPECT_TRUE(diagnosis.obstructions.empty());
  EXPECT_TRUE(diagnosis.obstructed.empty());
}

TEST(Diagnose, what_may_intersect_is_no_obstruction) {
  const Surface bottle = make_sample("klein_bottle", 24);
  FindOptions find;
  find.allowed.part_of_face.assign(bottle.view().face_count(), 0);
  find.allowed.part_of_face.front() = 1;
  find.allowed.parts = {{0, 0}, {0, 1}, {1, 1}};
  const Diagnosis diagnosis = diagnosis_of(bottle, {}, find);
  EXPECT_TRUE(diagnosis.pairs.empty());
  EXPECT_TRUE(diagnosis.obstructions.empty());
  find.allowed.parts = {{0, 0}};
  EXPECT_EQ(diagnosis_of(bottle, {}, find).obstructions.size(), 1u);
  const Surface twice{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 2, 1, 0}, {}};
  find.allowed = {{0, 1}, {{0, 1}}};
  EXPECT_TRUE(diagnosis_of(twice, {}, find).obstructions.empty());
  find.allowed.parts = {{0, 0}};
  EXPECT_EQ(diagnosis_of(twice, {}, find).obstructions.size(), 1u);
}

TEST(Diagnose, a_closed_non_orientable_component_is_named_by_its_first_face) {
  for (const char* name : {"klein_bottle", "boy_surface"}) {
    const Surface closed = make_sample(name, 24);
    const Surface sheet = make_sample("folded_sheet", 24);
    const Surface scene = appended(sheet, closed, 50);
    const auto first = static_cast<std::int32_t>(sheet.view().face_count());
    const Diagnosis diagnosis = diagnosis_of(scene);
    ASSERT_EQ(diagnosis.obstructions.size(), 1u) << name;
    EXPECT_EQ(diagnosis.obstructions[0].kind, Obstruction::Kind::closed_non_orientable);
    EXPECT_EQ(diagnosis.obstructions[0].faces, std::vector<std::int32_t>{first});
    EXPECT_NE(diagnosis.obstructions[0].message.find(std::to_string(first)), std::string::npos);
    // All its own pairs, and no other one.
    EXPECT_FALSE(diagnosis.obstructed.empty());
    EXPECT_LT(diagnosis.obstructed.size(), diagnosis.pairs.size());
    EXPECT_TRUE(std::includes(diagnosis.pairs.begin(), diagnosis.pairs.end(), diagnosis.obstructed.begin(),
                              diagnosis.obstructed.end()));
    const Index component = diagnosis.components.count() - 1;
    for (const IntersectingPair& pair : diagnosis.pairs) {
      const bool own = diagnosis.components.component_of_triangle[pair.a] == component &&
                       diagnosis.components.component_of_triangle[pair.b] == component;
      EXPECT_EQ(std::binary_search(diagnosis.obstructed.begin(), diagnosis.obstructed.end(), pair), own);
    }
  }
}

TEST(Diagnose, non_orientable_with_a_boundary_is_no_obstruction) {
  EXPECT_TRUE(diagnosis_of(make_sample("mobius_extended", 24)).obstructions.empty());
  EXPECT_TRUE(diagnosis_of(make_sample("klein_bottle_punctured", 24)).obstructions.empty());
}

TEST(Diagnose, faces_on_the_same_three_vertices) {
  Surface surface = shapes::crossing_bumps(6, 0.4).surface();
  const auto count = static_cast<std::int32_t>(surface.view().face_count());
  const auto repeat = [&](std::size_t f, int turn) {
    const std::vector<std::int32_t> t(surface.corners.begin() + static_cast<std::ptrdiff_t>(3 * f),
                                      surface.corners.begin() + static_cast<std::ptrdiff_t>(3 * f + 3));
    for (int k = 0; k < 3; ++k) surface.corners.push_back(t[turn < 0 ? 2 - k : (k + turn) % 3]);
  };
  repeat(7, 1);
  repeat(7, -1);
  repeat(20, 0);
  const Diagnosis diagnosis = diagnosis_of(surface);
  ASSERT_EQ(diagnosis.obstructions.size(), 2u);
  EXPECT_EQ(diagnosis.obstructions[0].kind, Obstruction::Kind::duplicate_faces);
  EXPECT_EQ(diagnosis.obstructions[0].faces, (std::vector<std::int32_t>{7, count, count + 1}));
  EXPECT_EQ(diagnosis.obstructions[1].faces, (std::vector<std::int32_t>{20, count + 2}));
  EXPECT_EQ(diagnosis.obstructed.size(), 4u);  // 3 + 1
  for (const IntersectingPair& pair : diagnosis.obstructed) EXPECT_EQ(pair.kind, PairClass::duplicate);
  EXPECT_EQ(diagnosis.topology.duplicate_faces, 3u);
}

TEST(Diagnose, faces_that_intersect_in_what_is_fixed_of_them) {
  const Shape shape = shapes::crossed_squares();
  const auto pairs = shapes::pairs_of(shape);
  std::vector<std::uint8_t> fixed(8, 1);
  const Diagnosis all = diagnosis_of(shape.surface(), fixed);
  ASSERT_EQ(all.obstructions.size(), 1u);
  EXPECT_EQ(all.obstructions[0].kind, Obstruction::Kind::fixed_faces);
  EXPECT_TRUE(all.obstructed == pairs);
  std::vector<std::int32_t> faces;
  for (const IntersectingPair& pair : pairs) faces.insert(faces.end(), {pair.a, pair.b});
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  EXPECT_EQ(all.obstructions[0].faces, faces);
  for (std::size_t v = 4; v < 8; ++v) fixed[v] = 0;  // one of the two may move
  EXPECT_TRUE(diagnosis_of(shape.surface(), fixed).obstructions.empty());
  fixed[4] = fixed[5] = 1;  // in part
  EXPECT_TRUE(diagnosis_of(shape.surface(), fixed).obstructions.empty());
  fixed[5] = 0;
  fixed[6] = 1;  // an edge through the other square
  EXPECT_EQ(diagnosis_of(shape.surface(), fixed).obstructions.size(), 1u);
  for (std::size_t v = 0; v < 4; ++v) fixed[v] = 0;  // which may give way
  EXPECT_TRUE(diagnosis_of(shape.surface(), fixed).obstructions.empty());
}

// Being fixed where they are joined keeps no two faces from parting.
TEST(Diagnose, shared_fixed_vertices_are_no_obstruction) {
  // Two that share a vertex, the second through the first; two that share an edge, folded onto each other.
  const Shape fan = {{{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {2, 0, -1}, {2.1, 0, 1}}, {{0, 1, 2}, {0, 3, 4}}};
  const Shape fold = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  for (const auto& [shape, fixed] : {std::pair(fan, std::vector<std::uint8_t>{1, 0, 0, 0, 0}),
                                     std::pair(fan, std::vector<std::uint8_t>{1, 1, 0, 1, 0}),
                                     std::pair(fold, std::vector<std::uint8_t>{1, 1, 0, 0}),
                                     std::pair(fold, std::vector<std::uint8_t>{1, 1, 1, 0})}) {
    const Diagnosis diagnosis = diagnosis_of(shape.surface(), fixed);
    EXPECT_EQ(diagnosis.pairs.size(), 1u);
    EXPECT_TRUE(diagnosis.obstructions.empty());
  }
  EXPECT_EQ(diagnosis_of(fold.surface(), {1, 1, 1, 1}).obstructions.size(), 1u);
}

TEST(Diagnose, counts_what_is_odd_about_a_mesh) {
  const Topology book = diagnosis_of(make_sample("book", 24)).topology;
  EXPECT_GT(book.non_manifold_edges, 0u);
  Surface surface = shapes::bumpy_sheet(2, 0).surface();
  surface.positions.insert(surface.positions.end(), {9, 9, 9});  // unused
  surface.corners.insert(surface.corners.end(), {0, 1, 1});      // without area
  const Topology topology = diagnosis_of(surface).topology;
  EXPECT_EQ(topology.unused_vertices, 1u);
  EXPECT_EQ(topology.zero_area_faces, 1u);
}

}  // namespace
}  // namespace unsnarl
