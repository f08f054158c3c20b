#include "applications/seifert/handles.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "unsnarl/intersections.h"

namespace unsnarl {
namespace {

FlatDisc rectangle(double width, double height) {
  return {{0, 1, 2, 3}, {Vec2(0, 0), Vec2(width, 0), Vec2(width, height), Vec2(0, height)}};
}

double area(const FlatDisc& disc) {
  double sum = 0;
  for (std::size_t k = 0; k < disc.outline.size(); ++k) {
    const Vec2 &p = disc.outline[k], &q = disc.outline[(k + 1) % disc.outline.size()];
    sum += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  return sum;
}

TEST(HandlePlaces, are_in_the_roomiest_discs_and_apart) {
  const std::vector<FlatDisc> discs{rectangle(1, 1), rectangle(6, 2)};
  const std::vector<HandlePlace> places = handle_places(discs, 9);
  ASSERT_EQ(places.size(), 9U);
  EXPECT_EQ(places[0].disc, 1);
  EXPECT_NEAR(places[0].middle.y(), 1, 0.1);
  std::set<Index> used;
  for (std::size_t i = 0; i < places.size(); ++i) {
    used.insert(places[i].disc);
    for (const Vec2& p : hexagon_of(places[i])) {
      EXPECT_GT(p.minCoeff(), 0);
      EXPECT_LT(p.x(), places[i].disc == 1 ? 6 : 1);
      EXPECT_LT(p.y(), places[i].disc == 1 ? 2 : 1);
    }
    for (std::size_t j = 0; j < i; ++j)
      if (places[i].disc == places[j].disc) {
        EXPECT_GT((places[i].middle - places[j].middle).norm(), places[i].radius + places[j].radius);
      }
  }
  EXPECT_EQ(used.size(), 2U);
  EXPECT_TRUE(handle_places(discs, 0).empty());
}

TEST(CutToHoles, goes_around_all_of_them_once) {
  FlatDisc disc = rectangle(6, 2);
  std::vector<FlatDisc> holes;
  double left = area(disc);
  for (const HandlePlace& place : handle_places(std::vector<FlatDisc>{disc}, 3)) {
    const std::array<Vec2, 6> hexagon = hexagon_of(place);
    FlatDisc& hole = holes.emplace_back();
    hole.outline.assign(hexagon.rbegin(), hexagon.rend());
    hole.corners.resize(6);
    std::iota(hole.corners.begin(), hole.corners.end(), static_cast<Index>(10 * holes.size()));
    left += area(hole);
  }
  cut_to_holes(disc, holes);
  EXPECT_EQ(disc.corners.size(), 4U + 3 * 8);
  EXPECT_EQ(disc.outline.size(), disc.corners.size());
  EXPECT_NEAR(area(disc), left, 1e-12);
}

TEST(AddHandle, is_embedded_and_fills_its_hexagon_with_genus_one) {
  SpanningMesh mesh;
  for (const Vec2& p : hexagon_of({.disc = 0, .middle = Vec2(1, 2), .radius = 3})) mesh.x.emplace_back(p.x(), p.y(), 0);
  add_handle(mesh, {0, 1, 2, 3, 4, 5}, -Vec3::UnitZ());
  std::map<Edge, int> uses;  // of directed edges
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  std::size_t edges = 0;
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    const bool is_boundary = !uses.contains({edge[1], edge[0]});
    edges += is_boundary || edge[0] < edge[1];
    if (is_boundary) {
      EXPECT_EQ(edge[1], (edge[0] + 1) % 6);  // around the hexagon as it was given
    }
  }
  EXPECT_EQ(static_cast<int>(mesh.x.size()) - static_cast<int>(edges) + static_cast<int>(mesh.faces.size()), -1);
  Surface surface;
  for (const Vec3& p : mesh.x) surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
  for (const Triangle& t : mesh.faces) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
  EXPECT_TRUE(find_intersections(surface).empty());
  for (const Vec3& p : mesh.x) EXPECT_LE(p.z(), 0);
}

}  // namespace
}  // namespace unsnarl
