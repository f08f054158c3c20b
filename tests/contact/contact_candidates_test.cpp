#include "contact/contact_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "contact/stop_check.h"

namespace unsnarl {
namespace {

using Key = std::array<Index, 5>;

/// The same for every order in which a stencil can be written.
Key key_of(const Stencil& s) {
  std::array<Index, 4> v = s.v;
  if (s.kind == StencilKind::vertex_face) {
    std::sort(v.begin() + 1, v.end());
  } else {
    if (v[0] > v[1]) std::swap(v[0], v[1]);
    if (v[2] > v[3]) std::swap(v[2], v[3]);
    if (v[0] > v[2]) {
      std::swap(v[0], v[2]);
      std::swap(v[1], v[3]);
    }
  }
  return {static_cast<Index>(s.kind), v[0], v[1], v[2], v[3]};
}

struct Soup {
  Positions x;
  std::vector<Triangle> triangles;
};

/// Triangles over few vertices: many share vertices and edges, some are equal or degenerate.
Soup random_soup(std::uint64_t seed, Index vertices, int count) {
  std::mt19937_64 engine(seed);
  Soup soup;
  soup.x.resize(3, vertices);
  for (Index v = 0; v < vertices; ++v)
    for (int k = 0; k < 3; ++k) soup.x(k, v) = static_cast<double>(engine() >> 11) * 0x1p-53;
  for (int t = 0; t < count; ++t) {
    Triangle f;
    for (Index& v : f) v = static_cast<Index>(engine() % static_cast<std::uint64_t>(vertices));
    soup.triangles.push_back(f);
  }
  return soup;
}

/// Calls visit(stencil) for every stencil with a moving vertex; edges meet in both orders.
template <class Visit>
void for_all_stencils(const Soup& soup, const std::vector<std::uint8_t>& moves, Visit&& visit) {
  const auto visit_moving = [&](const Stencil& s) {
    if (std::any_of(s.v.begin(), s.v.end(), [&](Index v) { return moves[v] != 0; })) visit(s);
  };
  std::set<Index> used;
  for (const Triangle& f : soup.triangles) used.insert(f.begin(), f.end());
  for (Index v : used) {
    for (const Triangle& f : soup.triangles) {
      if (f[0] != v && f[1] != v && f[2] != v) visit_moving({StencilKind::vertex_face, {v, f[0], f[1], f[2]}});
    }
  }
  const EdgeTable table = build_edges(soup.triangles);
  for (const Edge& e : table.edges) {
    for (const Edge& g : table.edges) {
      if (e[0] != g[0] && e[0] != g[1] && e[1] != g[0] && e[1] != g[1])
        visit_moving({StencilKind::edge_edge, {e[0], e[1], g[0], g[1]}});
    }
  }
}

/// Where vertices go nowhere in particular: what may come near is known exactly.
std::set<Key> brute_force(const Soup& soup, const std::vector<double>& radius, const std::vector<double>& around,
                          const std::vector<std::uint8_t>& moves) {
  std::set<Key> result;
  for_all_stencils(soup, moves, [&](const Stencil& s) {
    if (closest(s, soup.x).distance <= radius_of(s, radius) + approach(s, around)) result.insert(key_of(s));
  });
  return result;
}

MotionBounds standing(Index vertex_count) {
  MotionBounds bounds;
  bounds.reset(vertex_count);
  return bounds;
}

/// Coordinates in [-size, size].
Vec3 random_vector(std::mt19937_64& engine, double size) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = size * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1);
  return p;
}

TEST(ContactCandidates, agree_with_brute_force) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Soup soup = random_soup(seed, 25, 30);
    std::vector<std::uint8_t> moves(25, 0);
    for (Index v = 0; v < 25; ++v) moves[v] = seed % 3 == 0 || v % 4 == 0;
    ContactCandidates candidates(soup.triangles, 25);
    for (double longest : {0.02, 0.2, 0.3}) {
      std::vector<double> radius(25, longest);
      if (longest == 0.3)
        for (Index v = 0; v < 25; ++v) radius[v] *= v % 4 / 3.0;
      // None, everyone as far, everyone else.
      for (int kind = 0; kind < 3; ++kind) {
        MotionBounds bounds = standing(25);
        for (Index v = 0; v < 25; ++v) bounds.around[v] = kind == 0 ? 0 : kind == 1 ? 0.05 : 0.01 * ((v * 7) % 11);
        std::vector<NearStencil> found;
        candidates.gather(soup.x, radius, bounds, moves, found);
        std::set<Key> keys;
        for (const NearStencil& s : found) {
          keys.insert(key_of(s.stencil));
          EXPECT_DOUBLE_EQ(s.distance, closest(s.stencil, soup.x).distance);
        }
        EXPECT_EQ(keys, brute_force(soup, radius, bounds.around, moves)) << "seed " << seed << " radius " << longest;
      }
    }
  }
}

TEST(ContactCandidates, miss_nothing_that_comes_near_within_its_bounds) {
  const double radius = 0.05;
  std::size_t listed = 0, listed_by_lengths = 0, came_near = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Soup soup = random_soup(seed + 100, 25, 30);
    std::mt19937_64 engine(seed);
    // Flat surfaces, where many normals are parallel to motions, and parallel edges.
    if (seed % 4 == 3)
      for (Index v = 0; v < 25; ++v) soup.x.col(v) << v % 5, (v * v) % 7, 0;
    std::vector<std::uint8_t> moves(25, 0);
    MotionBounds bounds = standing(25);
    for (Index v = 0; v < 25; ++v) {
      if (seed % 3 != 0 && v % 3 == 0) continue;
      moves[v] = 1;
      // As one, each on its own, some of them in place.
      bounds.along.col(v) = seed % 2 ? Vec3(0.3, 0.1, 0) + random_vector(engine, 0.02) : random_vector(engine, 0.3);
      if (v % 5 == 0) bounds.along.col(v).setZero();
      bounds.around[v] = v % 2 ? 0.05 : 0;
    }
    std::vector<NearStencil> found;
    ContactCandidates candidates(soup.triangles, 25);
    candidates.gather(soup.x, std::vector<double>(25, radius), bounds, moves, found);
    std::set<Key> keys;
    for (const NearStencil& s : found) {
      keys.insert(key_of(s.stencil));
      EXPECT_LE(s.least_distance, radius);
    }
    listed += keys.size();
    std::vector<double> lengths(25);
    for (Index v = 0; v < 25; ++v) lengths[v] = bounds.along.col(v).norm() + bounds.around[v];
    listed_by_lengths += brute_force(soup, std::vector<double>(25, radius), lengths, moves).size();
    // Every vertex goes its own share of the way, many none of it or all, and as far aside as it may.
    Positions x = soup.x;
    for (int sample = 0; sample < 40; ++sample) {
      for (Index v = 0; v < 25; ++v) {
        const double share = std::array{0.0, 1.0, static_cast<double>(engine() % 16) / 15}[engine() % 3];
        x.col(v) =
            soup.x.col(v) + share * bounds.along.col(v) + bounds.around[v] * random_vector(engine, 1).normalized();
      }
      for_all_stencils(soup, moves, [&](const Stencil& s) {
        if (closest(s, x).distance > radius) return;
        ++came_near;
        EXPECT_TRUE(keys.contains(key_of(s))) << "seed " << seed;
      });
    }
  }
  EXPECT_GT(came_near, 1000u);
  EXPECT_LT(listed, listed_by_lengths * 3 / 4);
}

TEST(ContactCandidates, around_some_vertices_list_the_same_as_everywhere) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Soup soup = random_soup(seed + 200, 60, 60);
    std::mt19937_64 engine(seed);
    const std::vector<std::uint8_t> moves(60, 1);
    std::vector<double> radius(60, 0.03);
    if (seed % 2 == 1) radius[seed] = 0.2;
    MotionBounds bounds = standing(60);
    ContactCandidates candidates(soup.triangles, 60);
    std::vector<NearStencil> found;
    candidates.gather(soup.x, radius, bounds, moves, found);
    for (int round = 0; round < 3; ++round) {
      std::vector<Index> vertices;
      std::vector<std::uint8_t> is_around(60, 0);
      for (Index v = 0; v < 60; ++v) {
        if (engine() % 8 != 0) continue;
        vertices.push_back(v);
        is_around[v] = 1;
        soup.x.col(v) += random_vector(engine, 0.1);
        bounds.along.col(v) = random_vector(engine, 0.1);
        bounds.around[v] = 0.02;
      }
      candidates.gather_around(vertices, soup.x, radius, bounds, found);
      std::vector<NearStencil> all;
      ContactCandidates(soup.triangles, 60).gather(soup.x, radius, bounds, is_around, all);
      std::set<Key> keys, expected;
      for (const NearStencil& s : found) keys.insert(key_of(s.stencil));
      for (const NearStencil& s : all) expected.insert(key_of(s.stencil));
      EXPECT_EQ(keys, expected);
      EXPECT_EQ(keys.size(), found.size());
    }
  }
}

TEST(ContactCandidates, list_nothing_twice_where_no_triangle_is) {
  Soup soup = random_soup(5, 200, 150);
  const std::vector<std::uint8_t> moves(200, 1);
  ContactCandidates candidates(soup.triangles, 200);
  std::vector<NearStencil> found;
  candidates.gather(soup.x, std::vector<double>(200, 0.1), standing(200), moves, found);
  std::set<Key> keys;
  for (const NearStencil& s : found) keys.insert(key_of(s.stencil));
  EXPECT_EQ(keys.size(), found.size());
}

TEST(ContactCandidates, follow_motion_and_repeat_themselves) {
  Soup soup = random_soup(6, 30, 30);
  const std::vector<std::uint8_t> moves(30, 1);
  ContactCandidates candidates(soup.triangles, 30);
  std::vector<NearStencil> first, again;
  candidates.gather(soup.x, std::vector<double>(30, 0.1), standing(30), moves, first);
  soup.x = soup.x.colwise().reverse().eval();
  candidates.gather(soup.x, std::vector<double>(30, 0.05), standing(30), moves, again);
  std::set<Key> keys;
  for (const NearStencil& s : again) keys.insert(key_of(s.stencil));
  EXPECT_EQ(keys, brute_force(soup, std::vector<double>(30, 0.05), std::vector<double>(30, 0), moves));
  std::vector<NearStencil> repeated;
  candidates.gather(soup.x, std::vector<double>(30, 0.05), standing(30), moves, repeated);
  EXPECT_EQ(again, repeated);
}

TEST(ContactCandidates, know_neighbours) {
  //  3---2   5
  //  | / |  / \      faces (0,1,2), (0,2,3), and (4,6,5) apart
  //  0---1 4---6
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}};
  ContactCandidates candidates(triangles, 7);
  EXPECT_TRUE(candidates.are_neighbours({StencilKind::vertex_face, {3, 0, 1, 2}, {3, 0}}));
  EXPECT_FALSE(candidates.are_neighbours({StencilKind::vertex_face, {4, 0, 1, 2}, {4, 0}}));
  EXPECT_TRUE(candidates.are_neighbours({StencilKind::edge_edge, {0, 1, 2, 3}, {0, 4}}));
  EXPECT_FALSE(candidates.are_neighbours({StencilKind::edge_edge, {1, 2, 4, 5}, {3, 5}}));
}

TEST(ContactCandidates, stop_within_a_long_gathering) {
  // All are near all.
  constexpr Index count = 400;
  Positions x(3, 3 * count);
  std::vector<Triangle> triangles;
  for (Index t = 0; t < count; ++t) {
    const double angle = 3.0 * t / count;
    x.col(3 * t) = Vec3(std::cos(angle), std::sin(angle), 1e-3 * t);
    x.col(3 * t + 1) = Vec3(-std::cos(angle), -std::sin(angle), 1e-3 * t);
    x.col(3 * t + 2) = Vec3(0, 0.1, 9 + 1e-3 * t);
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  ContactCandidates candidates(triangles, 3 * count);
  const std::vector<double> radius(static_cast<std::size_t>(3 * count), 10);
  MotionBounds bounds;
  bounds.reset(3 * count);
  const std::vector<std::uint8_t> moves(3 * count, 1);
  std::vector<NearStencil> found, again;
  candidates.gather(x, radius, bounds, moves, found);
  EXPECT_GT(found.size(), 500000u);
  int asked = 0;
  EXPECT_THROW(candidates.gather(x, radius, bounds, moves, again, [&] { return ++asked > 0; }), WorkStopped);
  EXPECT_EQ(asked, 1);
  candidates.gather(x, radius, bounds, moves, again);
  EXPECT_TRUE(again == found);
}

}  // namespace
}  // namespace unsnarl
