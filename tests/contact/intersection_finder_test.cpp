// Against oracles: intersections_oracle_test.cpp. Here: what the interface promises, on cases made by hand and on one
// that is large enough for several tasks.
#include "contact/intersection_finder.h"
#include "geometry/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "contact/stop_check.h"

namespace unsnarl {
namespace {

Positions columns(std::initializer_list<Vec3> points) {
  Positions x(3, static_cast<Index>(points.size()));
  Index v = 0;
  for (const Vec3& p : points) x.col(v++) = p;
  return x;
}

TEST(IntersectionFinder, classes_by_what_the_faces_share) {
  const Positions x =
      columns({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}, {2, 1, 1}, {1, 2, 0}, {3, 0, 0}});
  const Triangle base = {0, 1, 2};
  const auto kind_of = [&](const Triangle& other) {
    PairClass kind = PairClass::disjoint, turned = PairClass::disjoint;
    EXPECT_TRUE(intersects(x, base, other, kind));
    EXPECT_TRUE(intersects(x, other, base, turned));
    EXPECT_EQ(kind, turned);
    return kind;
  };
  EXPECT_EQ(kind_of({3, 4, 5}), PairClass::disjoint);
  EXPECT_EQ(kind_of({0, 3, 4}), PairClass::one_vertex);
  EXPECT_EQ(kind_of({0, 1, 6}), PairClass::folded);
  EXPECT_EQ(kind_of({2, 1, 0}), PairClass::duplicate);
  EXPECT_EQ(kind_of({3, 3, 4}), PairClass::degenerate);
  EXPECT_EQ(kind_of({0, 7, 7}), PairClass::degenerate);
  PairClass kind;
  EXPECT_FALSE(intersects(x, base, {1, 0, 3}, kind)) << "neighbours over an edge";
  EXPECT_FALSE(intersects(x, {0, 1, 3}, {0, 2, 4}, kind)) << "neighbours at a vertex";
}

// Two wavy sheets of 2 * 70^2 faces each that run through each other.
struct WavySheets {
  Positions x;
  std::vector<Triangle> triangles;

  explicit WavySheets(double height) {
    constexpr Index n = 70, row = n + 1;
    x.resize(3, 2 * row * row);
    for (Index s = 0; s < 2; ++s)
      for (Index i = 0; i <= n; ++i)
        for (Index j = 0; j <= n; ++j)
          x.col((s * row + i) * row + j) =
              Vec3(i + 0.31 * s, j + 0.17 * s, s * height + (s ? 1 : -1) * std::sin(0.21 * i) * std::cos(0.17 * j));
    for (Index s = 0; s < 2; ++s)
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
          const Index a = (s * row + i) * row + j;
          triangles.push_back({a, a + row, a + row + 1});
          triangles.push_back({a, a + row + 1, a + 1});
        }
  }
};

TEST(IntersectionFinder, sorted_and_the_same_at_any_thread_count) {
  const WavySheets sheets(0.5);
  std::vector<IntersectingPair> expected;
  for (const std::size_t threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const auto found = IntersectionFinder(sheets.triangles).find(sheets.x);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    if (threads == 1) expected = found;
    EXPECT_TRUE(found == expected) << threads << " threads";
  }
  EXPECT_GT(expected.size(), 100u);
}

TEST(IntersectionFinder, visits_what_it_finds_without_a_list_of_all) {
  const WavySheets sheets(0.5);
  const auto expected = IntersectionFinder(sheets.triangles).find(sheets.x);
  IntersectionFinder finder(sheets.triangles);
  std::vector<IntersectingPair> visited, kept;
  std::size_t largest = 0;
  finder.visit(sheets.x, {.keep = {},
                          .take =
                              [&](std::span<const IntersectingPair> pairs) {
                                largest = std::max(largest, pairs.size());
                                visited.insert(visited.end(), pairs.begin(), pairs.end());
                              },
                          .stop = {}});
  std::sort(visited.begin(), visited.end());
  EXPECT_TRUE(visited == expected);
  EXPECT_LE(largest, 1024u);
  const auto is_even = [](const IntersectingPair& pair) { return pair.a % 2 == 0; };
  finder.visit(
      sheets.x,
      {.keep = is_even,
       .take = [&](std::span<const IntersectingPair> pairs) { kept.insert(kept.end(), pairs.begin(), pairs.end()); },
       .stop = {}});
  EXPECT_EQ(kept.size(), static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(), is_even)));
  EXPECT_TRUE(finder.find(sheets.x) == expected);
}

TEST(IntersectionFinder, stops_when_asked_and_begins_anew) {
  // Triangles through one line: every two intersect.
  constexpr Index count = 1000;
  Positions x(3, 3 * count);
  std::vector<Triangle> triangles;
  for (Index t = 0; t < count; ++t) {
    const double angle = 3.0 * t / count;
    x.col(3 * t) = Vec3(std::cos(angle), std::sin(angle), 1e-3 * t - 9);
    x.col(3 * t + 1) = Vec3(-std::cos(angle), -std::sin(angle), 1e-3 * t - 9);
    x.col(3 * t + 2) = Vec3(0, 0, 1e-3 * t + 9);
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  IntersectionFinder finder(triangles);
  std::size_t visited = 0;
  int asked = 0;
  const auto always = [&] { return ++asked > 0; };
  EXPECT_THROW(finder.find(x, always), WorkStopped);
  EXPECT_THROW(finder.visit(x, {.keep = {}, .take = [&](auto pairs) { visited += pairs.size(); }, .stop = always}),
               WorkStopped);
  EXPECT_LT(visited, 300000u);
  EXPECT_EQ(asked, 2);
  EXPECT_EQ(finder.find(x, [] { return false; }).size(), count * (count - 1) / 2u);
}

TEST(IntersectionFinder, what_moved_since_the_last_time_is_decided_as_if_anew) {
  WavySheets sheets(1.99);
  const Index active = 9800;
  IntersectionFinder all(sheets.triangles), some(sheets.triangles, active);
  std::uint64_t state = 1;
  const auto random = [&] { return state = state * 6364136223846793005ULL + 1442695040888963407ULL, state >> 33; };
  for (int moved : {0, 1, 10, 0, 300, 4000, 20, 0}) {
    for (int k = 0; k < moved; ++k)
      sheets.x(2, static_cast<Index>(random() % static_cast<std::uint64_t>(sheets.x.cols()))) +=
          0.3 * (static_cast<double>(random() % 1000) / 500 - 1);
    EXPECT_TRUE(all.find(sheets.x) == IntersectionFinder(sheets.triangles).find(sheets.x)) << moved << " moved";
    EXPECT_TRUE(some.find(sheets.x) == IntersectionFinder(sheets.triangles, active).find(sheets.x))
        << moved << " moved";
  }
}

TEST(IntersectionFinder, pairs_of_two_groups_are_left_out) {
  WavySheets sheets(1.99);
  std::vector<Index> group_of(static_cast<std::size_t>(sheets.x.cols()), 0);
  std::fill(group_of.begin() + sheets.x.cols() / 2, group_of.end(), 1);
  const Passing groups(group_of);
  const auto are_of_two = [&](const IntersectingPair& pair) { return !groups.meet(sheets.triangles, pair.a, pair.b); };
  IntersectionFinder all(sheets.triangles), apart(sheets.triangles, groups), followed(sheets.triangles, groups);
  followed.expect_small_steps();
  std::size_t left_out = 0, found = 0;
  std::uint64_t state = 3;
  const auto random = [&] { return state = state * 6364136223846793005ULL + 1442695040888963407ULL, state >> 33; };
  for (const int moved : {0, 3000, 10, 20000, 20000, 20000, 20, 20000}) {
    for (int k = 0; k < moved; ++k)
      sheets.x(static_cast<Index>(random() % 3),
               static_cast<Index>(random() % static_cast<std::uint64_t>(sheets.x.cols()))) +=
          0.3 * (static_cast<double>(random() % 1000) / 500 - 1);
    std::vector<IntersectingPair> expected = all.find(sheets.x);
    left_out += std::erase_if(expected, are_of_two);
    found += expected.size();
    EXPECT_TRUE(apart.find(sheets.x) == expected) << moved << " moved";
    EXPECT_TRUE(followed.find(sheets.x) == expected) << moved << " moved";
  }
  EXPECT_GT(left_out, 1000u);
  EXPECT_GT(found, 500u);
}

// Parts, unlike groups, have vertices in common: pairs that share some are told apart too.
TEST(IntersectionFinder, pairs_of_parts_that_pass_are_left_out) {
  WavySheets sheets(1.99);
  std::vector<Index> part_of;
  for (std::size_t t = 0; t < sheets.triangles.size(); ++t) part_of.push_back(static_cast<Index>(t / 2 % 3));
  const PassingParts parts(3, std::vector<std::array<Index, 2>>{{0, 1}, {2, 2}});
  const Passing passing({}, part_of, parts);
  IntersectionFinder all(sheets.triangles), apart(sheets.triangles, passing),
      others(sheets.triangles, passing.only_what_passes()), followed(sheets.triangles, passing);
  followed.expect_small_steps();
  std::size_t joined = 0;
  std::uint64_t state = 5;
  const auto random = [&] { return state = state * 6364136223846793005ULL + 1442695040888963407ULL, state >> 33; };
  for (const int moved : {0, 3000, 10, 20000, 20000, 20000, 20, 20000}) {
    for (int k = 0; k < moved; ++k)
      sheets.x(static_cast<Index>(random() % 3),
               static_cast<Index>(random() % static_cast<std::uint64_t>(sheets.x.cols()))) +=
          0.3 * (static_cast<double>(random() % 1000) / 500 - 1);
    std::vector<IntersectingPair> expected, passed;
    for (const IntersectingPair& pair : all.find(sheets.x)) {
      const bool pass = parts.pass(part_of[pair.a], part_of[pair.b]);
      joined += pass && pair.kind != PairClass::disjoint;
      (pass ? passed : expected).push_back(pair);
    }
    EXPECT_TRUE(apart.find(sheets.x) == expected) << moved << " moved";
    EXPECT_TRUE(followed.find(sheets.x) == expected) << moved << " moved";
    EXPECT_TRUE(others.find(sheets.x) == passed) << moved << " moved";
  }
  EXPECT_GT(joined, 100u);
}

TEST(IntersectionFinder, from_known_pairs_only_what_moves_is_decided) {
  WavySheets sheets(1.99);
  const std::vector<IntersectingPair> known = IntersectionFinder(sheets.triangles).find(sheets.x);
  IntersectionFinder finder(sheets.triangles), ignorant(sheets.triangles);
  finder.start_from(sheets.x, known);
  ignorant.start_from(sheets.x, {});
  EXPECT_TRUE(finder.find(sheets.x) == known);
  EXPECT_TRUE(ignorant.find(sheets.x).empty()) << "what is said to be known is not decided again";
  for (Index v = 0; v < 40; ++v) sheets.x(2, 50 * v) += v % 2 == 0 ? 2.5 : -2.5;
  const std::vector<IntersectingPair> now = finder.find(sheets.x);
  EXPECT_FALSE(now == known);
  EXPECT_TRUE(now == IntersectionFinder(sheets.triangles).find(sheets.x));
}

TEST(IntersectionFinder, few_active_faces_that_move_over_and_over_are_decided_as_if_anew) {
  WavySheets sheets(0.5);
  const Index active = 600;
  IntersectionFinder finder(sheets.triangles, active);
  finder.expect_small_steps();
  std::uint64_t state = 2;
  const auto random = [&] { return state = state * 6364136223846793005ULL + 1442695040888963407ULL, state >> 33; };
  std::size_t found = 0;
  for (int round = 0; round < 10; ++round) {
    // All of them, but for some rounds; at times someone asks what is near a place.
    const Index moving = round % 4 == 3 ? 20 : active;
    for (Index t = 0; t < moving; ++t)
      sheets.x(2, sheets.triangles[t][random() % 3]) += 0.1 * (static_cast<double>(random() % 1000) / 500 - 1);
    const std::vector<IntersectingPair> pairs = finder.find(sheets.x);
    EXPECT_TRUE(pairs == IntersectionFinder(sheets.triangles, active).find(sheets.x)) << "round " << round;
    found += pairs.size();
    if (round % 3 != 2) continue;
    finder.move(sheets.x);
    const Box box = box_of(sheets.x, sheets.triangles[round]).inflated(0.01);
    std::vector<Index> near;
    finder.query(box, near);
    for (Index t = 0; t < static_cast<Index>(sheets.triangles.size()); ++t) {
      if (box.overlaps(box_of(sheets.x, sheets.triangles[t]))) {
        EXPECT_NE(std::find(near.begin(), near.end(), t), near.end());
      }
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(IntersectionFinder, obstacles_do_not_count_among_themselves) {
  const WavySheets sheets(0.5);
  const auto all = IntersectionFinder(sheets.triangles).find(sheets.x);
  for (const Index active : {0, 4000, 9800}) {
    auto expected = all;
    std::erase_if(expected, [&](const IntersectingPair& pair) { return pair.a >= active; });
    IntersectionFinder finder(sheets.triangles, active);
    EXPECT_TRUE(finder.find(sheets.x) == expected);
  }
}

}  // namespace
}  // namespace unsnarl
