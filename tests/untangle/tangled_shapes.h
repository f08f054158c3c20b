#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "contact/intersection_finder.h"
#include "scene/shapes.h"

/// Surfaces that cannot come apart by a short step.
namespace unsnarl::shapes {

inline constexpr double tau = 2 * std::numbers::pi;

/// A grid of points f(i / m, j / n), closed in either direction where asked for.
inline Shape unit_grid(Index m, Index n, bool close_u, bool close_v, const std::function<Vec3(double, double)>& f) {
  Shape shape;
  const Index rows = close_u ? m : m + 1, columns = close_v ? n : n + 1;
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j)
      shape.points.push_back(f(static_cast<double>(i) / m, static_cast<double>(j) / n));
  }
  for (Index i = 0; i < m; ++i) {
    for (Index j = 0; j < n; ++j) {
      const auto id = [&](Index a, Index b) { return (a % rows) * columns + b % columns; };
      shape.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      shape.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return shape;
}

/// A sheet of 10 x 10 cells of side 1 at z = 0, and strips of two cells that stand in it, sunk by `depth`.
inline Shape sheet_with_strips(int strips, double depth) {
  Shape shape = grid(10, 10, false, [](double i, double j) { return Vec3(i, j, 0); });
  for (int k = 0; k < strips; ++k)
    shape.add(grid(2, 1, false, [](double i, double j) { return Vec3(0.4 * i, 0, j); }),
              Vec3(1.13 + 1.9 * k, 4.37, -depth));
  return shape;
}

inline Shape sphere(const Vec3& center, double radius, Index n) {
  Shape shape = unit_grid(n, 2 * n, false, true, [&](double u, double v) {
    const double polar = (0.02 + 0.96 * u) * tau / 2;
    return Vec3(center + radius * Vec3(std::sin(polar) * std::cos(tau * v), std::sin(polar) * std::sin(tau * v),
                                       std::cos(polar)));
  });
  return shape;
}

/// Two unit spheres of 2 n x n squares, less their poles, that run through each other a little.
inline Shape two_spheres(Index n) {
  Shape shape = sphere(Vec3(0, 0, 0), 1, n);
  shape.add(sphere(Vec3(1.9, 0.05, 0.02), 1, n));
  return shape;
}

/// A tube around the closed curve c.
inline Shape tube(Index along, Index around, double radius, const std::function<Vec3(double)>& c) {
  return unit_grid(along, around, true, true, [&](double u, double v) {
    const Vec3 p = c(u), tangent = (c(u + 1e-4) - c(u - 1e-4)).normalized();
    const Vec3 side = tangent.cross(Vec3::UnitZ()).normalized(), up = side.cross(tangent);
    return Vec3(p + radius * (std::cos(tau * v) * side + std::sin(tau * v) * up));
  });
}

/// A trefoil too thick for its curve.
inline Shape thick_trefoil() {
  return tube(72, 8, 0.75, [](double t) {
    const double a = tau * t;
    return Vec3(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a), -0.6 * std::sin(3 * a));
  });
}

/// A figure eight swept around a ring, with one full turn.
inline Shape figure_eight_torus() {
  return unit_grid(40, 20, true, true, [](double u, double v) {
    const double s = std::sin(tau * v), d = 0.5 * std::sin(2 * tau * v), a = tau * u;
    const double x = std::cos(a) * s - std::sin(a) * d, z = std::sin(a) * s + std::cos(a) * d;
    return Vec3((3 + x) * std::cos(a), (3 + x) * std::sin(a), z);
  });
}

/// A limb pressed through a sheet.
inline Shape limb_and_sheet() {
  Shape shape = unit_grid(16, 16, false, false, [](double u, double v) { return Vec3(4 * u - 2, 4 * v - 2, 0.003); });
  shape.add(unit_grid(16, 12, false, true, [](double u, double v) {
    return Vec3(3 * u - 1.5 + 0.013, 0.4 * std::cos(tau * v) + 0.007, 0.4 * std::sin(tau * v) + 0.25);
  }));
  return shape;
}

/// A hemisphere without a cap around its pole, opposite points of the equator identified: a Moebius band, one boundary,
/// no orientation. `f` takes opposite points of the sphere to one.
inline Shape punctured_projective_plane(Index rows, Index columns, double hole,
                                        const std::function<Vec3(const Vec3&)>& f) {
  const Vec3 pole = Vec3(0.5, 0.62, 0.6).normalized();
  const Vec3 east = pole.cross(Vec3::UnitX()).normalized(), north = pole.cross(east);
  Shape shape;
  for (Index i = 0; i <= rows; ++i) {
    const double polar = hole + (0.25 * tau - hole) * i / rows;
    for (Index j = 0; j < (i < rows ? columns : columns / 2); ++j) {
      const double angle = tau * j / columns;
      shape.points.push_back(
          f(std::cos(polar) * pole + std::sin(polar) * (std::cos(angle) * east + std::sin(angle) * north)));
    }
  }
  const auto id = [&](Index i, Index j) { return i * columns + j % (i < rows ? columns : columns / 2); };
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      shape.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      shape.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return shape;
}

inline Shape punctured_cross_cap() {
  return punctured_projective_plane(
      14, 40, 0.4, [](const Vec3& p) { return Vec3(p[0] * p[2], p[1] * p[2], 0.5 * (p[2] * p[2] - p[0] * p[0])); });
}

inline Shape punctured_roman_surface() {
  return punctured_projective_plane(14, 40, 0.4,
                                    [](const Vec3& p) { return Vec3(p[1] * p[2], p[2] * p[0], p[0] * p[1]); });
}

/// Reorders vertices and triangles so that those for which `fixed` says so come last.
inline Patch patch_with_fixed(const Shape& shape, const std::function<bool(const Vec3&)>& fixed) {
  Shape sorted;
  std::vector<Index> id(shape.points.size());
  Index free_count = 0;
  for (const bool last : {false, true}) {
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      if (fixed(shape.points[i]) != last) continue;
      id[i] = static_cast<Index>(sorted.points.size());
      sorted.points.push_back(shape.points[i]);
    }
    if (!last) free_count = static_cast<Index>(sorted.points.size());
  }
  for (const Triangle& t : shape.triangles) sorted.triangles.push_back({id[t[0]], id[t[1]], id[t[2]]});
  const auto is_active = [&](const Triangle& t) { return *std::min_element(t.begin(), t.end()) < free_count; };
  const auto middle = std::stable_partition(sorted.triangles.begin(), sorted.triangles.end(), is_active);
  Patch patch = patch_of(sorted);
  patch.free_count = free_count;
  patch.active_count = static_cast<Index>(middle - sorted.triangles.begin());
  return patch;
}

inline std::size_t count_pairs(const Patch& patch) {
  return IntersectionFinder(patch.triangles, patch.active_count).find(patch.x).size();
}

}  // namespace unsnarl::shapes
