// Scenes around parts that must not move (paper §4.2), and components repaired each as if alone, judged by CGAL.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "pipeline/judged.h"
#include "scene/shapes.h"
#include "unsnarl/parts.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

using shapes::Shape;

std::vector<std::uint8_t> component_flags(const Surface& surface, std::int32_t component) {
  return vertices_of_faces(surface, faces_in_parts(surface, {}, {.components = {component}}));
}

/// Whether flagged vertices are bit-identical; and some other has moved.
void expect_only_others_moved(const Surface& surface, const RepairResult& result,
                              const std::vector<std::uint8_t>& fixed) {
  std::size_t fixed_moved = 0, others_moved = 0;
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    const bool same = std::equal(&surface.positions[3 * v], &surface.positions[3 * v] + 3, &result.positions[3 * v]);
    (fixed[v] ? fixed_moved : others_moved) += !same;
  }
  EXPECT_EQ(fixed_moved, 0u);
  EXPECT_GT(others_moved, 0u);
}

TEST(FixedParts, balls_give_way_to_an_anchor) {
  const Surface surface = make_sample("anchored_balls", 20);
  RepairOptions options;
  options.fixed = component_flags(surface, 0);
  const RepairResult result = repair(surface, options);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(judged(surface, result.positions).empty());
  expect_only_others_moved(surface, result, options.fixed);
}

TEST(FixedParts, a_fixed_vertex_fixes_those_welded_to_it) {
  // The lower sheet's corners are written anew for every face, and only the first writing of each is fixed.
  const Surface whole = shapes::crossing_bumps(10, 0.3).surface();
  const std::size_t lower_faces = whole.view().face_count() / 2;
  Surface soup;
  for (const std::int32_t v : whole.corners) {
    soup.corners.push_back(static_cast<std::int32_t>(soup.corners.size()));
    for (int k = 0; k < 3; ++k) soup.positions.push_back(whole.positions[3 * static_cast<std::size_t>(v) + k]);
  }
  std::vector<std::uint8_t> seen(whole.view().vertex_count(), 0);
  RepairOptions options;
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    std::uint8_t& known = seen[static_cast<std::size_t>(whole.corners[c])];
    options.fixed.push_back(c < 3 * lower_faces && !known);
    known = 1;
  }
  const RepairResult result = repair(soup, options);
  ASSERT_EQ(result.status, Status::embedded) << to_string(result.status);
  std::vector<std::uint8_t> lower(soup.corners.size(), 0);
  std::fill_n(lower.begin(), 3 * lower_faces, 1);
  expect_only_others_moved(soup, result, lower);
}

TEST(FixedParts, fixed_faces_through_each_other_are_named_and_block_nothing) {
  // Two fixed squares through each other, a sheet through both, and a crossing far away.
  Shape shape = shapes::crossed_squares();
  const std::size_t fixed_vertices = shape.points.size();
  shape.add(shapes::bumpy_sheet(12, 0.9), {0.13, 0.21, -0.7});
  shape.add(shapes::crossing_bumps(8, 0.3), {30, 0, 0});
  const Surface surface = shape.surface();
  RepairOptions options;
  options.fixed.assign(surface.view().vertex_count(), 0);
  std::fill_n(options.fixed.begin(), fixed_vertices, 1);
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::obstructed) << to_string(result.status);
  ASSERT_EQ(result.report.obstructions.size(), 1u);
  EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::fixed_faces);
  for (const IntersectingPair& pair : judged(surface, result.positions)) {
    EXPECT_LT(pair.a, 4);
    EXPECT_LT(pair.b, 4);
  }
  expect_only_others_moved(surface, result, options.fixed);
}

TEST(EachComponent, is_repaired_as_if_alone) {
  const Surface sheet = make_sample("folded_sheet", 16), limb = make_sample("helicoid_overlapping", 20);
  for (const double apart : {0.3, 100.0}) {
    Surface both = sheet;
    const auto first = static_cast<std::int32_t>(sheet.view().vertex_count());
    for (std::size_t i = 0; i < limb.positions.size(); ++i)
      both.positions.push_back(limb.positions[i] + (i % 3 == 0 ? apart : 0.0));
    Surface moved = limb;
    moved.positions.assign(both.positions.begin() + 3 * first, both.positions.end());
    if (both.offsets.empty())
      for (std::size_t i = 0; i <= sheet.corners.size(); i += 3) both.offsets.push_back(static_cast<std::int32_t>(i));
    for (std::size_t f = 0; f < limb.view().face_count(); ++f) {
      for (const std::int32_t v : limb.view().face(f)) both.corners.push_back(v + first);
      both.offsets.push_back(static_cast<std::int32_t>(both.corners.size()));
    }
    RepairOptions options;
    options.each_component = true;
    const RepairResult result = repair(both, options);
    const RepairResult alone = repair(sheet), other = repair(moved);
    EXPECT_TRUE(std::equal(alone.positions.begin(), alone.positions.end(), result.positions.begin()));
    EXPECT_TRUE(std::equal(other.positions.begin(), other.positions.end(), result.positions.begin() + 3 * first));
    const std::vector<IntersectingPair> left = judged(both, result.positions);
    EXPECT_EQ(result.report.after.total() == 0, left.empty());
    ASSERT_EQ(result.report.components.size(), 2u);
    for (const ComponentReport& component : result.report.components) {
      EXPECT_GT(component.pairs_before, 0u);
      EXPECT_EQ(component.pairs_after, 0u);
    }
    if (apart > 50) {
      EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
      EXPECT_TRUE(result.report.obstructions.empty());
    } else {
      EXPECT_FALSE(left.empty()) << "the two should run through each other";
      EXPECT_EQ(result.status, Status::obstructed) << to_string(result.status);
      ASSERT_EQ(result.report.obstructions.size(), 1u);
      EXPECT_EQ(result.report.obstructions[0].kind, Obstruction::Kind::between_components);
    }
  }
}

TEST(EachComponent, is_repaired_as_if_alone_by_the_method_of_the_paper_too) {
  const Surface sheet = make_sample("folded_sheet", 12);
  Surface two = sheet;
  const auto count = static_cast<std::int32_t>(sheet.view().vertex_count());
  for (std::size_t i = 0; i < sheet.positions.size(); ++i)
    two.positions.push_back(sheet.positions[i] + (i % 3 == 2 ? 0.0625 : 0.0));
  for (std::size_t f = 0; f < sheet.view().face_count(); ++f) {
    for (const std::int32_t v : sheet.view().face(f)) two.corners.push_back(v + count);
    two.offsets.push_back(static_cast<std::int32_t>(two.corners.size()));
  }
  RepairOptions options;
  options.paper.emplace();
  const RepairResult alone = repair(sheet, options);
  ASSERT_NE(alone.positions, sheet.positions);
  options.each_component = true;
  const RepairResult result = repair(two, options);
  EXPECT_TRUE(std::equal(alone.positions.begin(), alone.positions.end(), result.positions.begin()));
  ASSERT_EQ(result.report.components.size(), 2u);
  for (const ComponentReport& component : result.report.components) {
    EXPECT_GT(component.pairs_before, 0u);
    EXPECT_EQ(component.pairs_after, 0u);
  }
}

/// Adds vertices and triangles (their corners counted from the first of those) to a surface of polygons.
void add_triangles(const std::vector<double>& positions, const std::vector<std::int32_t>& corners, Surface& surface) {
  const auto count = static_cast<std::int32_t>(surface.view().vertex_count());
  surface.positions.insert(surface.positions.end(), positions.begin(), positions.end());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    surface.corners.push_back(count + corners[c]);
    if (c % 3 == 2) surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  }
}

TEST(EachComponent, quads_hold_along_both_diagonals) {
  RepairOptions options;
  options.find.both_diagonals = true;
  const Surface limb = make_sample("posed_limb", 16);
  ASSERT_FALSE(limb.offsets.empty());
  const RepairResult alone = repair(limb, options);
  ASSERT_EQ(alone.status, Status::embedded);
  for (const double apart : {128.0, 0.05}) {
    Surface two = limb;
    const auto count = static_cast<std::int32_t>(limb.view().vertex_count());
    for (std::size_t i = 0; i < limb.positions.size(); ++i)
      two.positions.push_back(limb.positions[i] + (i % 3 == 0 ? apart : 0));
    for (std::size_t f = 0; f < limb.view().face_count(); ++f) {
      for (const std::int32_t v : limb.view().face(f)) two.corners.push_back(v + count);
      two.offsets.push_back(static_cast<std::int32_t>(two.corners.size()));
    }
    options.each_component = true;
    const RepairResult result = repair(two, options);
    EXPECT_EQ(result.status, apart > 1 ? Status::embedded : Status::obstructed) << to_string(result.status);
    Surface moved = two;
    moved.positions = result.positions;
    EXPECT_EQ(find_intersections(moved, options.find).empty(), apart > 1);
    EXPECT_TRUE(std::equal(alone.positions.begin(), alone.positions.end(), result.positions.begin()));
  }
}

TEST(FixedParts, what_cannot_be_parted_keeps_no_polygon_of_others_from_settling) {
  const Surface limb = make_sample("posed_limb", 16);
  // Triangles of which a fixed edge runs through a fixed one; and a fixed tetrahedron around the fixed end of a chain.
  Surface crossed = limb, locked = limb;
  add_triangles({100, 0, 0, 101, 0, 0, 100.5, 0, 1, 100.5, -1, -1, 100.5, 1, -1, 100.5, 0, 0.5},
                {0, 1, 2, 3, 4, 5, 0, 4, 3}, crossed);
  add_triangles({100, 0,     0,   101, 0,     0,   100, 1,     0, 100, 0,   1, 100.2, 0.2,
                 0.2, 100.2, 0.9, 0.9, 100.3, 0.9, 0.9, 100.2, 2, 2,   100, 2, 2},
                {0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3, 4, 5, 6, 5, 6, 7, 3, 7, 8}, locked);
  // A quad that runs through a fixed triangle along one diagonal or the other, whatever its free vertices do.
  Surface torn = limb;
  torn.positions.insert(torn.positions.end(), {98, 0,     0,    103,  0,     0,   100.5, -1,    1, 100.5, 1,
                                               1,  100.5, -0.1, -0.1, 100.5, 0.1, -0.1,  100.5, 0, 0.2});
  const auto count = static_cast<std::int32_t>(limb.view().vertex_count());
  for (const std::int32_t corner : {2, 0, 3, 1}) torn.corners.push_back(count + corner);
  torn.offsets.push_back(static_cast<std::int32_t>(torn.corners.size()));
  for (const std::int32_t corner : {4, 5, 6, 4, 5, 0}) torn.corners.push_back(count + corner);
  for (const std::int32_t corners : {3, 0})
    torn.offsets.push_back(static_cast<std::int32_t>(torn.corners.size()) - corners);
  const std::size_t first = limb.view().vertex_count();
  for (const bool each : {false, true}) {
    RepairOptions options;
    options.find.both_diagonals = true;
    options.each_component = each;
    options.fixed.assign(first + 6, 0);
    for (const std::size_t v : {0, 1, 3, 4, 5}) options.fixed[first + v] = 1;
    const RepairResult result = repair(crossed, options);
    EXPECT_EQ(result.status, Status::obstructed) << to_string(result.status);
    EXPECT_EQ(result.report.after.total(), 1u) << each;
    options.fixed.assign(first + 9, 0);
    for (const std::size_t v : {0, 1, 2, 3, 4, 7, 8}) options.fixed[first + v] = 1;
    EXPECT_EQ(repair(locked, options).report.after.total(), 1u) << each;
    options.fixed.assign(first + 7, 0);
    for (const std::size_t v : {0, 3, 4, 5, 6}) options.fixed[first + v] = 1;
    options.max_displacement_rel = 0.002;
    EXPECT_EQ(repair(torn, options).report.after.total(), 1u) << each;
  }
}

TEST(EachComponent, chooses_its_numbers_by_itself) {
  // A folded sheet with coordinates of 1000, and smaller ones near the origin: alone, 32-bit numbers can hold each.
  const Surface sheet = make_sample("folded_sheet", 12);
  Surface all = sheet;
  for (std::size_t i = 0; i < all.positions.size(); i += 3) all.positions[i] += 1000;
  const Surface far = all;
  const auto count = static_cast<std::int32_t>(sheet.view().vertex_count());
  for (std::int32_t k = 0; k < 12; ++k) {
    for (std::size_t i = 0; i < sheet.positions.size(); ++i)
      all.positions.push_back(0.01 * sheet.positions[i] + (i % 3 == 1 ? k : 0));
    for (std::size_t f = 0; f < sheet.view().face_count(); ++f) {
      for (const std::int32_t v : sheet.view().face(f)) all.corners.push_back(v + (k + 1) * count);
      all.offsets.push_back(static_cast<std::int32_t>(all.corners.size()));
    }
  }
  RepairOptions options;
  ASSERT_EQ(repair(far, options).report.precision, Precision::float32);
  options.each_component = true;
  EXPECT_EQ(repair(all, options).report.precision, Precision::float32);
}

TEST(EachComponent, one_that_intersects_along_the_other_diagonals_alone_is_repaired) {
  for (const double up : {1, -1}) {
    // A saddle, and a band from one side of it around to its middle, where it stops between the two diagonals.
    Surface surface;
    surface.positions = {0,    0,  0.5, 1,  0,  -0.5, 1,  1,   0.5, 0,  1,   -0.5, -1, 0,   0.5, -1, 1,
                         -0.5, -1, 0,   -2, -1, 1,    -2, 0.5, 0.4, -2, 0.5, 0.6,  -2, 0.5, 0.5, 0};
    for (std::size_t i = 2; i < surface.positions.size(); i += 3) surface.positions[i] *= up;
    surface.corners = {0, 1, 2, 3, 0, 3, 5, 4, 4, 5, 7, 6, 6, 7, 9, 8, 8, 9, 10};
    surface.offsets = {0, 4, 8, 12, 16, 19};
    RepairOptions options;
    options.each_component = true;
    options.find.both_diagonals = true;
    ASSERT_FALSE(find_intersections(surface, options.find).empty());
    ASSERT_TRUE(find_intersections(surface).empty());
    const RepairResult result = repair(surface, options);
    EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
    surface.positions = result.positions;
    EXPECT_TRUE(find_intersections(surface, options.find).empty());
  }
}

TEST(EachComponent, one_that_intersects_once_rounded_alone_is_repaired) {
  // A sheet folded to 1e-9 of itself, and one far away that needs nothing.
  Surface surface;
  for (const double x : {0.0, 64.0})
    for (const auto& [u, v, z] :
         {std::array{1.0, 0.0, 0.5}, std::array{2.0, 0.0, 0.5}, std::array{1.0, 1.0, 0.5}, std::array{2.0, 1.0, 0.5},
          std::array{2.0, 0.0, x > 0 ? 1.5 : 0.5 + 1e-9}, std::array{2.0, 1.0, x > 0 ? 1.5 : 0.5 + 1e-9}})
      surface.positions.insert(surface.positions.end(), {u + x, v, z});
  for (const std::int32_t first : {0, 6})
    for (const std::int32_t v : {0, 1, 2, 1, 3, 2, 0, 2, 4, 2, 5, 4}) surface.corners.push_back(first + v);
  RepairOptions options;
  options.each_component = true;
  ASSERT_EQ(repair(surface, options).positions, surface.positions);
  options.precision = Precision::float32;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::embedded) << to_string(result.status);
  EXPECT_TRUE(result.report.float32_embedded);
  EXPECT_NE(result.positions, surface.positions);
  EXPECT_TRUE(std::equal(surface.positions.begin() + 18, surface.positions.end(), result.positions.begin() + 18));
}

TEST(EachComponent, leaves_what_only_runs_through_others) {
  const Surface surface = shapes::crossing_bumps(8, 0.3).surface();
  RepairOptions options;
  options.each_component = true;
  const RepairResult result = repair(surface, options);
  EXPECT_EQ(result.status, Status::obstructed);
  EXPECT_TRUE(result.positions == surface.positions);
  EXPECT_EQ(result.report.after.by_class, result.report.before.by_class);
  EXPECT_GT(result.report.after.total(), 0u);
}

}  // namespace
}  // namespace unsnarl
