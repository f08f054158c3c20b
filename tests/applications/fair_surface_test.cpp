#include "applications/seifert/fair_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "applications/seifert/link_diagram.h"

namespace unsnarl {
namespace {

constexpr Index around = 24, rings = 13;

/// A tube of radius 1 and length 3 between two circles, whose points come first: no catenoid spans circles so far
/// apart.
SpanningMesh tube() {
  SpanningMesh mesh;
  std::vector<Index> order{0, rings - 1};
  for (Index r = 1; r + 1 < rings; ++r) order.push_back(r);
  std::vector<Index> first(rings);
  for (const Index r : order) {
    first[r] = static_cast<Index>(mesh.x.size());
    for (Index k = 0; k < around; ++k) {
      const double angle = 2 * std::numbers::pi * k / around;
      mesh.x.emplace_back(std::cos(angle), std::sin(angle), 3.0 * r / (rings - 1) - 1.5);
    }
  }
  for (Index r = 0; r + 1 < rings; ++r)
    for (Index k = 0; k < around; ++k) {
      const Index next = (k + 1) % around;
      mesh.faces.push_back({first[r] + k, first[r] + next, first[r + 1] + next});
      mesh.faces.push_back({first[r] + k, first[r + 1] + next, first[r + 1] + k});
    }
  return mesh;
}

double thinnest(const SpanningMesh& mesh) {
  double least = 1;
  for (const Vec3& p : mesh.x) least = std::min(least, p.head<2>().norm());
  return least;
}

/// Edges between faces whose normals differ by more than a right angle.
int folds(const SpanningMesh& mesh) {
  std::map<Edge, Vec3> normals;  // of the faces to the left of directed edges
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k)
      normals[{t[k], t[(k + 1) % 3]}] = (mesh.x[t[1]] - mesh.x[t[0]]).cross(mesh.x[t[2]] - mesh.x[t[0]]);
  int count = 0;
  for (const auto& [edge, normal] : normals) {
    const auto other = normals.find({edge[1], edge[0]});
    count += edge[0] < edge[1] && other != normals.end() && normal.dot(other->second) < 0;
  }
  return count;
}

TEST(Fair, bends_are_smoothed) {
  for (const char* name : {"3_1", "5_2", "6_2"}) {
    SCOPED_TRACE(name);
    const Link link = knot_of_table(name);
    const SpanningMesh start = spanning_start(link, *best_diagram(link, 60), 0.2);
    const auto faired = [&](double bending) {
      return fair(
          start, static_cast<Index>(link.point_count()), 0.2, {.bending = bending}, [](double) {}, [] { return true; });
    };
    EXPECT_LT(folds(faired(FairOptions().bending)), folds(faired(0)));
  }
}

TEST(Fair, boundaries_stay_and_minimal_surfaces_are_found) {
  SpanningMesh near = tube();
  for (Vec3& p : near.x) p.z() *= 0.2;
  const SpanningMesh mesh = fair(
      near, 2 * around, 0.1, {}, [](double) {}, [] { return true; });
  for (Index v = 0; v < 2 * around; ++v) EXPECT_EQ(mesh.x[v], near.x[v]);
  // The catenoid r = c cosh(z / c) through r = 1 at z = 0.3 is 0.953 wide at its waist.
  // Bends make it a little wider.
  EXPECT_NEAR(thinnest(mesh), 0.953, 0.015);
}

}  // namespace
}  // namespace unsnarl
