#include "samples/regular_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "bench/map_automorphisms.h"
#include "unsnarl/samples.h"

namespace unsnarl {
namespace {

struct RegularMap {
  std::string sample;
  std::vector<Triangle> faces;
  std::size_t vertices, edges, valence, directed_edges;
};

std::vector<RegularMap> both_maps() {
  return {{"klein_map", klein_map_faces(), 24, 84, 7, 168}, {"dyck_map", dyck_map_faces(), 12, 48, 8, 96}};
}

TEST(RegularMaps, have_the_counts_of_their_genus) {
  for (const RegularMap& map : both_maps()) {
    SCOPED_TRACE(map.sample);
    std::set<Edge> edges;
    std::vector<std::size_t> valence(map.vertices, 0);
    for (const Triangle& t : map.faces)
      for (std::size_t k = 0; k < 3; ++k) {
        edges.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
        ++valence.at(static_cast<std::size_t>(t[k]));
      }
    EXPECT_EQ(edges.size(), map.edges);
    EXPECT_EQ(map.faces.size(), 2 * map.edges / 3);
    EXPECT_EQ(valence, std::vector<std::size_t>(map.vertices, map.valence));
    EXPECT_EQ(static_cast<int>(map.vertices) - static_cast<int>(map.edges) + static_cast<int>(map.faces.size()), -4);
  }
}

// Schlaefli symbol, genus and the order of the group single them out: R3.1 and R3.2 in Conder's list.
TEST(RegularMaps, have_as_many_automorphisms_as_flags) {
  for (const RegularMap& map : both_maps()) {
    const auto vertices = static_cast<Index>(map.vertices);
    std::set<VertexMap> group;
    for (const bool mirrored : {false, true}) {
      const auto automorphisms = map_automorphisms(map.faces, vertices, mirrored);
      EXPECT_EQ(automorphisms.size(), map.directed_edges) << map.sample;
      group.insert(automorphisms.begin(), automorphisms.end());
    }
    EXPECT_EQ(group.size(), 2 * map.directed_edges) << map.sample;
    std::set<std::set<Index>> faces;
    for (const Triangle& t : map.faces) faces.insert({t.begin(), t.end()});
    for (const VertexMap& g : group)
      for (const Triangle& t : map.faces) EXPECT_TRUE(faces.contains({g[t[0]], g[t[1]], g[t[2]]}));
  }
}

TEST(RegularMaps, are_faced_outwards_without_noise) {
  for (const RegularMap& map : both_maps()) {
    const Surface surface = make_sample(map.sample, 0, {{"noise", 0}});
    EXPECT_EQ(surface.view().face_count(), map.faces.size());
    double volume = 0;
    for (const Triangle& t : map.faces) {
      const auto p = [&](Index v) { return Vec3(&surface.positions[3 * static_cast<std::size_t>(v)]); };
      volume += p(t[0]).dot(p(t[1]).cross(p(t[2]))) / 6;
    }
    EXPECT_GT(volume, 0.1) << map.sample;
  }
}

TEST(RegularMaps, change_with_the_seed_and_stay_in_their_box) {
  for (const RegularMap& map : both_maps()) {
    const Surface one = make_sample(map.sample, 0, {{"random", 1}}),
                  two = make_sample(map.sample, 0, {{"random", 1}, {"seed", 2}});
    EXPECT_NE(one.positions, two.positions);
    EXPECT_EQ(one.positions, make_sample(map.sample, 100, {{"random", 1}, {"noise", 0.5}}).positions);
    for (const double coordinate : one.positions) EXPECT_LE(std::abs(coordinate), 1);
  }
}

}  // namespace
}  // namespace unsnarl
