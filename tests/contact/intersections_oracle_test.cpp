// The detector against two oracles that share no code with it, on random meshes over lattices of tiny integers: there
// touching, coplanar, folded, duplicate and zero-area faces are the rule and not the exception.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "contact/intersection_finder.h"
#include "oracle/intersections_oracle.h"

namespace unsnarl {
namespace {

/// A random mesh with corners on {0 .. lattice_size - 1}^3.
struct LatticeMesh {
  std::vector<std::int64_t> coordinates;
  std::vector<Triangle> triangles;
};

struct LatticeRecipe {
  int lattice_size = 4;
  int vertices = 8;
  int triangles = 8;
  bool repeated_corners = false;  ///< faces may use a vertex twice
};

LatticeMesh random_mesh(std::mt19937& random, const LatticeRecipe& recipe) {
  LatticeMesh mesh;
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int k = 0; k < 3 * recipe.vertices; ++k) mesh.coordinates.push_back(below(recipe.lattice_size));
  while (static_cast<int>(mesh.triangles.size()) < recipe.triangles) {
    const Triangle t = {below(recipe.vertices), below(recipe.vertices), below(recipe.vertices)};
    const bool repeated = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (!repeated || recipe.repeated_corners) mesh.triangles.push_back(t);
  }
  return mesh;
}

template <class Map>
Positions positions_of(const LatticeMesh& mesh, Map&& map) {
  Positions x(3, mesh.coordinates.size() / 3);
  for (Index v = 0; v < x.cols(); ++v)
    for (int axis = 0; axis < 3; ++axis) x(axis, v) = map(axis, mesh.coordinates[3 * v + axis]);
  return x;
}
Positions positions_of(const LatticeMesh& mesh) {
  return positions_of(mesh, [](int, std::int64_t c) { return static_cast<double>(c); });
}

std::vector<IntersectingPair> by_cgal(const Positions& x, const std::vector<Triangle>& triangles) {
  return oracle::intersections_by_cgal({x.data(), static_cast<std::size_t>(x.size())}, triangles);
}

std::string describe(const LatticeMesh& mesh, const std::vector<IntersectingPair>& pairs) {
  std::ostringstream text;
  for (const IntersectingPair& pair : pairs) {
    text << pair_class_names[static_cast<std::size_t>(pair.kind)];
    for (const Index f : {pair.a, pair.b}) {
      text << " | face " << f << ":";
      for (const Index v : mesh.triangles[f]) {
        const std::int64_t* c = &mesh.coordinates[3 * v];
        text << " " << v << " (" << c[0] << " " << c[1] << " " << c[2] << ")";
      }
    }
    text << "\n";
  }
  return text.str();
}

/// The pairs only one of the two lists holds.
std::string difference(const LatticeMesh& mesh, const std::vector<IntersectingPair>& found,
                       const std::vector<IntersectingPair>& expected) {
  std::vector<IntersectingPair> missed, invented;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missed));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(invented));
  return "missed:\n" + describe(mesh, missed) + "invented:\n" + describe(mesh, invented);
}

/// Meshes of 2 to 40 faces on lattices of 2 to 4 points a side.
const std::array<LatticeRecipe, 5> recipes = {{
    {.lattice_size = 2, .vertices = 6, .triangles = 6},
    {.lattice_size = 3, .vertices = 6, .triangles = 8},
    {.lattice_size = 4, .vertices = 8, .triangles = 10},
    {.lattice_size = 4, .vertices = 30, .triangles = 40},
    {.lattice_size = 3, .vertices = 5, .triangles = 2},
}};

TEST(IntersectionsOracle, oracles_agree_with_each_other) {
  std::mt19937 random(1);
  for (LatticeRecipe recipe : recipes)
    for (int round = 0; round < 40; ++round) {
      recipe.repeated_corners = round % 4 == 0;
      const LatticeMesh mesh = random_mesh(random, recipe);
      const auto cgal = by_cgal(positions_of(mesh), mesh.triangles);
      const auto brute = oracle::intersections_by_brute_force(mesh.coordinates, mesh.triangles);
      ASSERT_TRUE(cgal == brute) << difference(mesh, cgal, brute);
    }
}

TEST(IntersectionsOracle, finder_agrees_on_lattices) {
  std::mt19937 random(2);
  PairCounts seen;
  for (const LatticeRecipe& recipe : recipes)
    for (int round = 0; round < 1500; ++round) {
      const LatticeMesh mesh = random_mesh(random, recipe);
      const auto expected = oracle::intersections_by_brute_force(mesh.coordinates, mesh.triangles);
      const auto found = IntersectionFinder(mesh.triangles).find(positions_of(mesh));
      ASSERT_TRUE(found == expected) << difference(mesh, found, expected);
      for (const IntersectingPair& pair : expected) ++seen[pair.kind];
    }
  for (std::size_t kind = 0; kind < pair_class_count; ++kind)
    EXPECT_GT(seen.by_class[kind], 100u) << "the meshes hardly show class " << pair_class_names[kind];
}

TEST(IntersectionsOracle, finder_agrees_where_faces_use_a_vertex_twice) {
  std::mt19937 random(3);
  for (LatticeRecipe recipe : recipes) {
    recipe.repeated_corners = true;
    for (int round = 0; round < 500; ++round) {
      const LatticeMesh mesh = random_mesh(random, recipe);
      const auto expected = oracle::intersections_by_brute_force(mesh.coordinates, mesh.triangles);
      const auto found = IntersectionFinder(mesh.triangles).find(positions_of(mesh));
      ASSERT_TRUE(found == expected) << difference(mesh, found, expected);
    }
  }
}

TEST(IntersectionsOracle, same_answer_after_motions_without_rounding) {
  std::mt19937 random(4);
  // A power of two and an integer shift, within 53 bits: the same configuration, far from the origin or tiny.
  const std::array<std::array<double, 2>, 4> motions = {{{1, 1e9}, {0x1p-20, -7}, {0x1p+300, 0}, {0x1p-300, 0}}};
  for (int round = 0; round < 400; ++round) {
    const LatticeMesh mesh = random_mesh(random, recipes[round % recipes.size()]);
    const auto expected = oracle::intersections_by_brute_force(mesh.coordinates, mesh.triangles);
    for (const auto& [scale, shift] : motions) {
      const double s = scale, t = shift;
      const auto found = IntersectionFinder(mesh.triangles).find(positions_of(mesh, [&](int axis, std::int64_t c) {
        return s * static_cast<double>(c) + t * (axis + 1);
      }));
      ASSERT_TRUE(found == expected) << "scale " << s << " shift " << t << "\n" << difference(mesh, found, expected);
    }
  }
}

TEST(IntersectionsOracle, exact_where_rounding_has_broken_degeneracies) {
  std::mt19937 random(5);
  // Scaling by 0.1 and shifting round every coordinate: what was coplanar is so no more, by a few units in the last
  // place.
  const std::array<std::array<double, 2>, 3> motions = {{{0.1, 0.3}, {1.0 / 3.0, 1000.1}, {1e-9, 1.7}}};
  for (int round = 0; round < 120; ++round) {
    const LatticeMesh mesh = random_mesh(random, recipes[round % 3]);
    for (const auto& [scale, shift] : motions) {
      const double s = scale, t = shift;
      const Positions x = positions_of(
          mesh, [&](int axis, std::int64_t c) { return s * static_cast<double>(c) + t * (1 + 0.1 * axis); });
      const auto expected = by_cgal(x, mesh.triangles);
      const auto found = IntersectionFinder(mesh.triangles).find(x);
      ASSERT_TRUE(found == expected) << "scale " << s << " shift " << t << "\n" << difference(mesh, found, expected);
    }
  }
}

TEST(IntersectionsOracle, exact_where_magnitudes_differ_wildly) {
  std::mt19937 random(6);
  const std::array<double, 6> values = {0, 1, 1 + 0x1p-52, 1e-200, -1e-17, 3e15};
  for (int round = 0; round < 150; ++round) {
    const LatticeMesh mesh = random_mesh(random, {.lattice_size = 6, .vertices = 8, .triangles = 8});
    const Positions x = positions_of(mesh, [&](int, std::int64_t c) { return values[static_cast<std::size_t>(c)]; });
    const auto expected = by_cgal(x, mesh.triangles);
    const auto found = IntersectionFinder(mesh.triangles).find(x);
    ASSERT_TRUE(found == expected) << difference(mesh, found, expected);
  }
}

TEST(IntersectionsOracle, refitted_tree_finds_what_a_new_one_finds) {
  std::mt19937 random(7);
  const LatticeMesh first = random_mesh(random, {.lattice_size = 4, .vertices = 30, .triangles = 40});
  IntersectionFinder finder(first.triangles);
  for (int round = 0; round < 50; ++round) {
    LatticeMesh moved = random_mesh(random, {.lattice_size = 4, .vertices = 30, .triangles = 0});
    moved.triangles = first.triangles;
    const auto found = finder.find(positions_of(moved));
    const auto expected = oracle::intersections_by_brute_force(moved.coordinates, moved.triangles);
    ASSERT_TRUE(found == expected) << difference(moved, found, expected);
  }
}

TEST(IntersectionsOracle, obstacles_are_not_tested_among_themselves) {
  std::mt19937 random(8);
  for (int round = 0; round < 100; ++round) {
    const LatticeMesh mesh = random_mesh(random, {.lattice_size = 3, .vertices = 20, .triangles = 20});
    const Index active_count = round % 21;
    auto expected = oracle::intersections_by_brute_force(mesh.coordinates, mesh.triangles);
    std::erase_if(expected, [&](const IntersectingPair& pair) { return pair.a >= active_count; });
    const auto found = IntersectionFinder(mesh.triangles, active_count).find(positions_of(mesh));
    ASSERT_TRUE(found == expected) << difference(mesh, found, expected);
  }
}

}  // namespace
}  // namespace unsnarl
