#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "scene/patch.h"
#include "scene/scene.h"
#include "scene/scene_index.h"
#include "unsnarl/surface.h"

/// Small surfaces that run through themselves, and what tests ask of them.
namespace unsnarl::shapes {

struct Shape {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  Shape& add(const Shape& other, const Vec3& offset = Vec3::Zero()) {
    const Index first = static_cast<Index>(points.size());
    for (const Vec3& p : other.points) points.push_back(p + offset);
    for (const Triangle& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return *this;
  }
  Positions positions() const {
    Positions x(3, static_cast<Index>(points.size()));
    for (std::size_t v = 0; v < points.size(); ++v) x.col(static_cast<Index>(v)) = points[v];
    return x;
  }
  Surface surface() const {
    Surface surface;
    for (const Vec3& p : points) surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
    for (const Triangle& t : triangles) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
    return surface;
  }
};

/// A grid of m x n cells over f(i, j), closed in the second direction where asked for.
/// A box from 0 to `size`, of 8 vertices and 12 triangles; its normals point outward.
inline Shape box(const Vec3& size) {
  Shape shape;
  for (int i = 0; i < 8; ++i) shape.points.emplace_back(i & 1 ? size[0] : 0, i & 2 ? size[1] : 0, i & 4 ? size[2] : 0);
  for (const auto& q :
       {std::array<Index, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    shape.triangles.insert(shape.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
  return shape;
}

inline Shape grid(Index m, Index n, bool closed, const std::function<Vec3(double, double)>& f) {
  Shape shape;
  const Index columns = closed ? n : n + 1;
  for (Index i = 0; i <= m; ++i)
    for (Index j = 0; j < columns; ++j) shape.points.push_back(f(i, j));
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < n; ++j) {
      const auto id = [&](Index a, Index b) { return a * columns + b % columns; };
      shape.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      shape.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return shape;
}

/// A flat sheet of n x n cells of side 1 around the origin with a bump of the given height and width in its middle.
inline Shape bumpy_sheet(Index n, double height, double width = 2) {
  return grid(n, n, false, [=](double i, double j) {
    const double x = i - 0.5 * n, y = j - 0.5 * n;
    return Vec3(x, y, height * std::exp(-(x * x + y * y) / (width * width)));
  });
}

/// Two sheets one above the other whose bumps run through each other by `depth`.
inline Shape crossing_bumps(Index n, double depth) {
  Shape shape = bumpy_sheet(n, 1 + 0.5 * depth);
  shape.add(bumpy_sheet(n, -1 - 0.5 * depth), {0.31, 0.17, 2});
  return shape;
}

/// Two sheets of cells of side 1 / n whose wide bumps run through each other.
inline Shape crossing_wide_bumps(Index n, double depth) {
  const auto sheet = [&](double height) {
    return grid(40 * n, 40 * n, false, [=](double i, double j) {
      const double x = i / n - 20, y = j / n - 20;
      return Vec3(x, y, height * std::exp(-(x * x + y * y) / 36));
    });
  };
  Shape shape = sheet(1 + 0.5 * depth);
  return shape.add(sheet(-1 - 0.5 * depth), {0.31, 0.17, 2});
}

/// A tube of radius r and length m along x.
inline Shape tube(Index m, Index around, double r) {
  return grid(m, around, true, [=](double i, double j) {
    const double angle = 6.283185307179586 * j / around;
    return Vec3(i - 0.5 * m, r * std::cos(angle), r * std::sin(angle));
  });
}

/// A vertical rectangle through the horizontal one at z = 0; both one cell.
inline Shape crossed_squares() {
  Shape shape = grid(1, 1, false, [](double i, double j) { return Vec3(4 * i - 2, 4 * j - 2, 0); });
  return shape.add(
      grid(1, 1, false, [](double i, double j) { return Vec3(0.1 + 0.2 * i, 2 * j - 0.97, 2 * i - 1.03); }));
}

/// A flat square of side 2 in four triangles around its middle, vertex 0.
inline Shape square_fan() {
  return {{{0, 0, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
}

inline Scene scene_of(const Shape& shape) {
  return make_scene(shape.positions(), shape.triangles, {});
}

/// All of it free.
inline Patch patch_of(const Shape& shape) {
  Patch patch;
  patch.free_count = static_cast<Index>(shape.points.size());
  patch.active_count = static_cast<Index>(shape.triangles.size());
  patch.rest = patch.x = shape.positions();
  patch.triangles = shape.triangles;
  for (Index v = 0; v < patch.free_count; ++v) patch.vertices.push_back(v);
  for (Index t = 0; t < patch.active_count; ++t) patch.faces.push_back(t);
  patch.edge_length = mean_edge_length(patch.rest, patch.triangles);
  return patch;
}

/// Only the first vertices are free, and used by the first triangles.
inline Patch patch_of(const Shape& shape, Index free_count, Index active_count) {
  Patch patch = patch_of(shape);
  patch.free_count = free_count;
  patch.active_count = active_count;
  return patch;
}

inline std::vector<IntersectingPair> pairs_at(const Positions& x, const std::vector<Triangle>& triangles) {
  return IntersectionFinder(triangles).find(x);
}
inline std::vector<IntersectingPair> pairs_of(const Shape& shape) {
  return pairs_at(shape.positions(), shape.triangles);
}

inline Box box_around(const Vec3& p, double half) {
  Box box;
  box.extend(p);
  return box.inflated(half);
}

/// Triangles that the index finds near the box, ascending.
inline std::vector<Index> found_by(const SceneIndex& index, const Box& box) {
  std::vector<Index> found;
  index.query(box, found);
  std::sort(found.begin(), found.end());
  return found;
}

/// Triangles whose boxes overlap it, ascending.
inline std::vector<Index> overlapping(const Scene& scene, const Box& box) {
  std::vector<Index> found;
  for (Index t = 0; t < scene.triangle_count(); ++t)
    if (box_of(scene.x, scene.triangles[t]).overlaps(box)) found.push_back(t);
  return found;
}

}  // namespace unsnarl::shapes
