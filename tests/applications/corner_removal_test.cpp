#include "applications/isotopy/corner_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "geometry/splitmix.h"

namespace unsnarl {
namespace {

const std::function<bool()> never = [] { return false; };

using Place = std::array<std::int64_t, 2>;

/// Twice the area, in whole numbers.
std::int64_t area(const Place& a, const Place& b, const Place& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_in_triangle(const Place& p, const Place& a, const Place& b, const Place& c) {
  const std::int64_t u = area(a, b, p), v = area(b, c, p), w = area(c, a, p);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Two triangles share an area unless a side of one parts them.
bool share_an_area(const std::array<Place, 3>& a, const std::array<Place, 3>& b) {
  const auto is_parted = [](const std::array<Place, 3>& one, const std::array<Place, 3>& other) {
    for (int k = 0; k < 3; ++k) {
      const Place &p = one[k], &q = one[(k + 1) % 3];
      const std::int64_t inside = area(p, q, one[(k + 2) % 3]);
      if (inside == 0) continue;
      const bool parts = std::all_of(other.begin(), other.end(), [&](const Place& r) {
        const std::int64_t side = area(p, q, r);
        return inside > 0 ? side <= 0 : side >= 0;
      });
      if (parts) return true;
    }
    return false;
  };
  const auto is_flat = [](const std::array<Place, 3>& t) { return area(t[0], t[1], t[2]) == 0; };
  return !is_flat(a) && !is_flat(b) && !is_parted(a, b) && !is_parted(b, a);
}

struct Scene {
  std::vector<Place> places;
  Corners corners;
};

Scene scene(const std::vector<std::vector<Place>>& polygons) {
  Scene made;
  for (const std::vector<Place>& polygon : polygons) {
    const auto first = static_cast<Index>(made.places.size()), n = static_cast<Index>(polygon.size());
    for (Index k = 0; k < n; ++k) {
      made.places.push_back(polygon[k]);
      made.corners.polygon.push_back(static_cast<Index>(made.corners.count.size()));
      made.corners.before.push_back(first + (k + n - 1) % n);
      made.corners.after.push_back(first + (k + 1) % n);
    }
    made.corners.count.push_back(n);
  }
  made.corners.x.resize(2, static_cast<Index>(made.places.size()));
  for (std::size_t k = 0; k < made.places.size(); ++k)
    made.corners.x.col(static_cast<Index>(k)) = Vec2(double(made.places[k][0]), double(made.places[k][1]));
  made.corners.is_corner.assign(made.places.size(), 1);
  made.corners.is_kept.assign(made.places.size(), 0);
  return made;
}

/// A counter-clockwise polygon around the origin, its corners at all distances.
std::vector<Place> random_star(std::uint64_t seed, int n) {
  std::vector<Place> polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * 3.14159265358979 * k / n;
    const double r = 1000 + 9000 * splitmix_number((seed * 1000 + static_cast<std::uint64_t>(k)) * splitmix_step);
    polygon.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
  }
  return polygon;
}

/// Carries removals out: no other corner lies in the triangle of any. Returns how many corners each polygon has left.
std::vector<Index> expect_free(Scene& s, const std::vector<CornerRemoval>& removals) {
  Corners& c = s.corners;
  for (const CornerRemoval& removal : removals) {
    const auto [a, b, e] = removal;
    EXPECT_EQ(c.is_corner[b], 1);
    EXPECT_EQ(c.before[b], a);
    EXPECT_EQ(c.after[b], e);
    for (Index w = 0; w < static_cast<Index>(s.places.size()); ++w) {
      const bool is_other = c.is_corner[w] != 0 && w != a && w != b && w != e;
      const bool is_flat = area(s.places[a], s.places[b], s.places[e]) == 0;
      EXPECT_FALSE(is_other && !is_flat && is_in_triangle(s.places[w], s.places[a], s.places[b], s.places[e]))
          << b << " " << w;
    }
    c.is_corner[b] = 0;
    c.after[a] = e;
    c.before[e] = a;
    --c.count[c.polygon[b]];
  }
  return c.count;
}

TEST(CornerRemoval, takes_simple_polygons_down_to_triangles) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scene s = scene({random_star(seed, 40)});
    EXPECT_EQ(expect_free(s, remove_corners(s.corners, never)), std::vector<Index>{3}) << seed;
  }
}

TEST(CornerRemoval, stops_at_what_lies_in_a_polygon) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    // Beside the tips of five long spikes of a star, which must stay.
    std::vector<Place> star = random_star(seed, 40);
    std::vector<std::vector<Place>> polygons(1);
    for (std::size_t k = 0; k < star.size(); k += 8) {
      const double angle = 2 * 3.14159265358979 * static_cast<double>(k) / 40;
      star[k] = {std::llround(20000 * std::cos(angle)), std::llround(20000 * std::sin(angle))};
      const std::int64_t x = star[k][0] * 9 / 10, y = star[k][1] * 9 / 10;
      polygons.push_back({{x, y}, {x + 8, y}, {x, y + 8}});
    }
    polygons[0] = star;
    Scene s = scene(polygons);
    const std::vector<Index> left = expect_free(s, remove_corners(s.corners, never));
    EXPECT_GE(left[0], 5) << seed;
    EXPECT_LT(left[0], 40) << seed;
    // Ears are of the polygon as if it were alone.
    Scene alone = scene(polygons);
    EXPECT_EQ(remove_ears(alone.corners, 0, 1, never).size(), 37U) << seed;
  }
}

TEST(CornerRemoval, ears_are_the_triangles_of_a_triangulation) {
  const std::vector<Place> star = random_star(7, 40);
  Scene s = scene({star});
  std::int64_t whole = 0, sum = 0;
  for (std::size_t k = 1; k + 1 < star.size(); ++k) whole += area(star[0], star[k], star[k + 1]);
  std::vector<std::uint8_t> there(star.size(), 1);
  for (const CornerRemoval& ear : remove_ears(s.corners, 0, 1, never)) {
    const std::int64_t part = area(s.places[ear.before], s.places[ear.corner], s.places[ear.after]);
    EXPECT_GT(part, 0);
    sum += part;
    there[ear.corner] = 0;
  }
  std::vector<Place> left;
  for (std::size_t k = 0; k < star.size(); ++k)
    if (there[k] != 0) left.push_back(star[k]);
  ASSERT_EQ(left.size(), 3U);
  EXPECT_EQ(sum + area(left[0], left[1], left[2]), whole);
}

TEST(CornerRemoval, kept_corners_stay) {
  Scene s = scene({random_star(3, 40)});
  for (Index v = 0; v < 40; v += 4) s.corners.is_kept[v] = 1;
  const std::vector<CornerRemoval> removals = remove_corners(s.corners, never);
  EXPECT_GT(removals.size(), 10U);
  for (const CornerRemoval& removal : removals) EXPECT_NE(removal.corner % 4, 0);
}

TEST(CornerRemoval, triangles_of_one_round_share_no_area_and_no_corner_that_goes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene s = scene({random_star(seed, 40)});
    const std::vector<CornerRemoval> removals = remove_corners(s.corners, never);
    const std::vector<int> rounds = rounds_of(s.corners.x, removals, never);
    ASSERT_EQ(rounds.size(), removals.size());
    const auto triangle = [&](const CornerRemoval& r) {
      return std::array<Place, 3>{s.places[r.before], s.places[r.corner], s.places[r.after]};
    };
    int together = 0;
    for (std::size_t i = 0; i < removals.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (rounds[i] != rounds[j]) continue;
        ++together;
        EXPECT_FALSE(share_an_area(triangle(removals[i]), triangle(removals[j]))) << seed << " " << i << " " << j;
        for (const auto& [one, other] : {std::pair{removals[i], removals[j]}, std::pair{removals[j], removals[i]}}) {
          EXPECT_NE(one.corner, other.before);
          EXPECT_NE(one.corner, other.after);
        }
      }
    EXPECT_GT(together, 20) << seed;
  }
}

}  // namespace
}  // namespace unsnarl
