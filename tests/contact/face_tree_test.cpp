#include "contact/face_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "contact/intersection_finder.h"
#include "geometry/box.h"

namespace unsnarl {
namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

Pairs pairs_of(const FaceTree& tree) {
  std::vector<Pairs> found(tree.task_count());
  tree.self_pairs([&](Index task, Index i, Index j) { found[task].push_back({i, j}); });
  Pairs pairs;
  for (const Pairs& list : found) pairs.insert(pairs.end(), list.begin(), list.end());
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs overlapping_boxes(const Positions& x, const std::vector<Triangle>& triangles, double margin = 0) {
  Pairs pairs;
  for (Index i = 0; i < static_cast<Index>(triangles.size()); ++i)
    for (Index j = i + 1; j < static_cast<Index>(triangles.size()); ++j)
      if (box_of(x, triangles[i]).inflated(margin).overlaps(box_of(x, triangles[j]).inflated(margin)))
        pairs.push_back({i, j});
  return pairs;
}

Pairs intersecting(const Positions& x, const std::vector<Triangle>& triangles) {
  Pairs pairs;
  PairClass kind;
  for (Index i = 0; i < static_cast<Index>(triangles.size()); ++i)
    for (Index j = i + 1; j < static_cast<Index>(triangles.size()); ++j)
      if (intersects(x, triangles[i], triangles[j], kind)) pairs.push_back({i, j});
  return pairs;
}

struct Mesh {
  Positions x;
  std::vector<Triangle> triangles;
};

Mesh soup(Index n, double size, unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  Mesh mesh;
  mesh.x.resize(3, 3 * n);
  for (Index t = 0; t < n; ++t) {
    const Vec3 p(unit(), unit(), unit());
    for (Index k = 0; k < 3; ++k) mesh.x.col(3 * t + k) = p + size * Vec3(unit(), unit(), unit());
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

// The wall of an extruded shape, along a slanted axis: needles of length 10 side by side around a circle, every fifth
// leaning into the next ones.
Mesh slanted_needles(Index n) {
  const Vec3 axis = Vec3(1, 1.1, 0.9).normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
  Mesh mesh;
  mesh.x.resize(3, 2 * n);
  for (Index k = 0; k < n; ++k) {
    const double angle = 6.283185307179586 * k / n, lean = k % 5 == 0 ? 0.004 : 0;
    mesh.x.col(2 * k) = std::cos(angle) * u + std::sin(angle) * v;
    mesh.x.col(2 * k + 1) = std::cos(angle + lean) * u + std::sin(angle + lean) * v + 10 * axis;
  }
  for (Index k = 0; k < n; ++k) {
    const Index l = (k + 1) % n;
    mesh.triangles.push_back({2 * k, 2 * l, 2 * k + 1});
    mesh.triangles.push_back({2 * l, 2 * l + 1, 2 * k + 1});
  }
  return mesh;
}

TEST(FaceTree, pairs_are_those_of_overlapping_boxes) {
  const Mesh mesh = soup(400, 0.15, 1);
  FaceTree tree(mesh.triangles);
  tree.update(mesh.x);
  EXPECT_TRUE(pairs_of(tree) == overlapping_boxes(mesh.x, mesh.triangles));
  tree.update(mesh.x, 0.02);
  EXPECT_TRUE(pairs_of(tree) == overlapping_boxes(mesh.x, mesh.triangles, 0.02));
}

TEST(FaceTree, follows_the_motion) {
  const Mesh mesh = soup(300, 0.15, 2);
  FaceTree tree(mesh.triangles);
  tree.update(mesh.x);
  const Mesh moved = soup(300, 0.2, 3);
  tree.update(moved.x);
  EXPECT_TRUE(pairs_of(tree) == overlapping_boxes(moved.x, mesh.triangles));
}

TEST(FaceTree, nothing_in_nothing) {
  const std::vector<Triangle> none;
  FaceTree tree(none);
  tree.update(Positions(3, 0));
  EXPECT_TRUE(pairs_of(tree).empty());
}

TEST(FaceTree, boxes_are_turned_along_slanted_needles) {
  const Mesh mesh = slanted_needles(400);
  FaceTree tree(mesh.triangles);
  tree.update(mesh.x);
  const Pairs found = pairs_of(tree), upright = overlapping_boxes(mesh.x, mesh.triangles);
  EXPECT_LT(10 * found.size(), upright.size()) << "turning the boxes brings nothing";
  const Pairs expected = intersecting(mesh.x, mesh.triangles);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
}

// What has a corner in the box has to be found; without turned boxes, what is found are the boxes that overlap it.
TEST(FaceTree, queries_follow_the_motion) {
  for (const bool has_needles : {false, true}) {
    const Mesh mesh = has_needles ? slanted_needles(400) : soup(400, 0.15, 1);
    FaceTree tree(mesh.triangles);
    Positions x = mesh.x;
    int hits = 0;
    tree.update(x);
    const auto check = [&] {
      for (Index v = 0; v < x.cols(); v += 37) {
        Box box;
        box.extend(Vec3(x.col(v)));
        box = box.inflated(0.1);
        std::vector<std::uint8_t> found(mesh.triangles.size(), 0);
        tree.query(box, [&](Index t) { ++found[t]; });
        for (std::size_t t = 0; t < found.size(); ++t) {
          const bool near = box_of(x, mesh.triangles[t]).overlaps(box);
          bool inside = false;
          for (Index corner : mesh.triangles[t])
            inside |=
                (x.col(corner).array() >= box.lo.array()).all() && (x.col(corner).array() <= box.hi.array()).all();
          EXPECT_LE(found[t], near || has_needles);
          EXPECT_GE(found[t], has_needles ? inside : near);
          hits += inside;
        }
      }
    };
    check();
    std::vector<Index> moved;
    for (Index t = 0; t < static_cast<Index>(mesh.triangles.size()); ++t) {
      const Triangle& corners = mesh.triangles[t];
      if (std::any_of(corners.begin(), corners.end(), [](Index v) { return v < 30; })) moved.push_back(t);
    }
    for (Index v = 0; v < 30; ++v) x.col(v) += Vec3(0.5, -0.3, 0.7);
    tree.update(x, moved);
    check();
    EXPECT_GT(hits, 10);
    tree.query(Box(), [](Index) { ADD_FAILURE() << "an empty box overlaps nothing"; });
  }
}

TEST(FaceTree, turned_boxes_lose_no_intersection) {
  const Mesh mesh = slanted_needles(150);
  // A motion that leaves the direction of the needles.
  std::mt19937_64 engine(4);
  Positions moved = mesh.x;
  for (Index v = 0; v < moved.cols(); ++v)
    for (int k = 0; k < 3; ++k) moved(k, v) += 0.5 * (static_cast<double>(engine() >> 11) * 0x1p-53);
  IntersectionFinder finder(mesh.triangles);
  for (const Positions& x : {mesh.x, moved}) {
    Pairs found;
    for (const IntersectingPair& pair : finder.find(x)) found.push_back({pair.a, pair.b});
    EXPECT_TRUE(found == intersecting(x, mesh.triangles));
  }
  EXPECT_FALSE(intersecting(moved, mesh.triangles).empty());
}

// Needles in one slanted plane whose tips end on the short sides of others: what touches in one point is apart by the
// rounding of the turned boxes, on either side.
TEST(FaceTree, turned_boxes_of_touching_faces_overlap) {
  const Vec3 u(7, 7, 8), v(89, -73, -14);  // at right angles, so that they are the axes of the boxes
  std::mt19937 random(5);
  Mesh mesh;
  mesh.x.resize(3, 6 * 60);
  for (Index t = 0; t < 60; ++t) {
    const double a = static_cast<double>(random() % 20000), b = static_cast<double>(random() % 3000);
    const auto at = [&](double along, double across) { return Vec3((a + along) * u + (b + across) * v); };
    mesh.x.col(6 * t) = at(0, 0);
    mesh.x.col(6 * t + 1) = at(0, 2);
    mesh.x.col(6 * t + 2) = at(3000, t % 2 == 0 ? 0 : 2);
    mesh.x.col(6 * t + 3) = at(0, 1);  // touches the first in the middle of its short side
    mesh.x.col(6 * t + 4) = at(-3000, 0);
    mesh.x.col(6 * t + 5) = at(-3000, 2);
    mesh.triangles.push_back({6 * t, 6 * t + 1, 6 * t + 2});
    mesh.triangles.push_back({6 * t + 3, 6 * t + 4, 6 * t + 5});
  }
  Pairs found;
  for (const IntersectingPair& pair : IntersectionFinder(mesh.triangles).find(mesh.x))
    found.push_back({pair.a, pair.b});
  const Pairs expected = intersecting(mesh.x, mesh.triangles);
  EXPECT_GE(expected.size(), 60u);
  EXPECT_TRUE(found == expected);
}

}  // namespace
}  // namespace unsnarl
