#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "unsnarl/surface.h"

/// Small surfaces, chosen by what is true of them.
namespace unsnarl::meshes {

using Ids = std::vector<std::int32_t>;

inline void append(Surface& surface, const Surface& other) {
  const auto first = static_cast<std::int32_t>(surface.view().vertex_count());
  surface.positions.insert(surface.positions.end(), other.positions.begin(), other.positions.end());
  for (const std::int32_t v : other.corners) surface.corners.push_back(first + v);
}

inline Surface joined(Surface a, const Surface& b) {
  append(a, b);
  return a;
}

template <class Map>
Surface mapped(Surface surface, Map&& map) {
  for (std::size_t v = 0; v < surface.view().vertex_count(); ++v) map(&surface.positions[3 * v]);
  return surface;
}

inline Surface translated(const Surface& surface, double dx, double dy, double dz) {
  return mapped(surface, [&](double* p) { p[0] += dx, p[1] += dy, p[2] += dz; });
}

/// Triangulated n x m quads; columns and rows may close up, rows with a half turn. `point(u, v, p)` with u, v in [0,
/// 1].
template <class Point>
Surface grid(int n, int m, bool closed_u, bool closed_v, Point&& point, bool flip_v = false) {
  const int columns = closed_u ? n : n + 1, rows = closed_v ? m : m + 1;
  Surface surface;
  surface.positions.resize(static_cast<std::size_t>(3 * columns * rows));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      point(static_cast<double>(i) / n, static_cast<double>(j) / m, &surface.positions[3 * (i * rows + j)]);
  const auto id = [&](int i, int j) {
    if (closed_u && i == n) {
      i = 0;
      if (flip_v) j = m - j;
    }
    return i * rows + (closed_v ? (j + m) % m : j);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j)
      for (const int v : {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j), id(i + 1, j + 1), id(i, j + 1)})
        surface.corners.push_back(v);
  return surface;
}

/// Open tube of radius 0.3 along x from -1 to 1.
inline Surface tube(int around = 12, int along = 16, double radius = 0.3) {
  return grid(along, around, false, true, [&](double u, double v, double* p) {
    const double angle = 2 * std::numbers::pi * v;
    p[0] = 2 * u - 1, p[1] = radius * std::cos(angle), p[2] = radius * std::sin(angle);
  });
}

/// Closed torus around z; embedded while tube < 1.
inline Surface torus(int around = 24, int across = 10, double tube_radius = 0.35) {
  return grid(around, across, true, true, [&](double u, double v, double* p) {
    const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v, r = 1 + tube_radius * std::cos(b);
    p[0] = r * std::cos(a), p[1] = r * std::sin(a), p[2] = tube_radius * std::sin(b);
  });
}

/// Two tori of which one dips a little into the other from above: shallow crossings of separate components.
inline Surface touching_tori() {
  return joined(torus(), translated(mapped(torus(), [](double* p) { std::swap(p[1], p[2]); }), 0.9, 0.011, 1.6));
}

/// A flat strip bent back so that its end dips through its own middle.
inline Surface curled_strip() {
  return grid(40, 6, false, false, [](double u, double v, double* p) {
    const double angle = 1.55 * 2 * std::numbers::pi * u, r = 1 - 0.25 * u + 0.3 * u * u;
    p[0] = r * std::cos(angle), p[1] = 0.8 * v + 0.03 * u, p[2] = r * std::sin(angle);
  });
}

/// A sheet with one vertex pushed through a second sheet below it.
inline Surface dented_sheets() {
  const auto sheet = [](double height, bool dent) {
    return grid(10, 10, false, false, [=](double u, double v, double* p) {
      const double r2 = (u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5);
      p[0] = u, p[1] = v, p[2] = height - (dent ? 0.2 * std::exp(-60 * r2) : 0);
    });
  };
  return joined(sheet(0.1, true), translated(sheet(0, false), 0.013, 0.017, 0));
}

/// Closed and non-orientable, so that it has no embedding.
inline Surface klein_bottle() {
  // A ring closed with a flip of the other, closed direction, in the shape of a figure 8 turned once around.
  Surface surface = grid(
      24, 12, true, true,
      [](double u, double v, double* p) {
        const double a = 2 * std::numbers::pi * u, b = 2 * std::numbers::pi * v;
        const double r = 2 + std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
        p[0] = r * std::cos(a), p[1] = r * std::sin(a),
        p[2] = std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b);
      },
      true);
  return surface;
}

/// Quads and pentagons, mostly neither flat nor convex, each with some corners of its own and some of others.
inline Surface polygon_soup(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned n) { return static_cast<std::int32_t>(random() % n); };
  Surface surface;
  const std::int32_t vertices = 8 + below(10), faces = 3 + below(4);
  for (std::int32_t k = 0; k < 3 * vertices; ++k) surface.positions.push_back(0.001 * below(4000));
  surface.offsets = {0};
  for (std::int32_t f = 0; f < faces; ++f) {
    Ids face;
    while (face.size() < 4 + f % 2u)
      if (const std::int32_t v = below(static_cast<unsigned>(vertices));
          std::find(face.begin(), face.end(), v) == face.end())
        face.push_back(v);
    surface.corners.insert(surface.corners.end(), face.begin(), face.end());
    surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
  }
  return surface;
}

}  // namespace unsnarl::meshes
