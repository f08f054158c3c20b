#include "render/closeup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace unsnarl {
namespace {

/// A part with fewer of the red faces is not magnified (unit: share of all red faces)
constexpr double least_share = 0.05;

using Point = std::array<double, 2>;

/// A window of this side around the most of these points.
Window around_most(const std::vector<Point>& points, double side) {
  const double cell = 0.5 * side;
  std::map<std::pair<int, int>, int> counts;
  const auto cell_of = [&](const Point& c) {
    return std::pair(static_cast<int>(std::floor(c[0] / cell)), static_cast<int>(std::floor(c[1] / cell)));
  };
  for (const auto& c : points) ++counts[cell_of(c)];
  const auto fullest = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                       })->first;
  Window window = {0, 0, side};
  double members = 0;
  for (const auto& c : points) {
    if (cell_of(c) != fullest) continue;
    ++members;
    window.x += (c[0] - window.x) / members;
    window.y += (c[1] - window.y) / members;
  }
  return window;
}

/// How far apart the centres are along the axis along which they are farther.
double distance(const Window& window, const Point& p) {
  return std::max(std::abs(p[0] - window.x), std::abs(p[1] - window.y));
}

/// The red faces as they are seen, in pixels.
struct RedFaces {
  std::vector<Point> centres;
  double edge = 0;  // median over the faces of their longest edges

  RedFaces(const Drawable& drawable, const Camera& camera, int width, int height) {
    std::vector<double> edges;
    for (std::size_t t = 0; t < drawable.triangles.size(); ++t) {
      if (drawable.red[t] == 0) continue;
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = camera.project(drawable.positions[drawable.triangles[t][k]], width, height);
      centres.push_back({(p[0][0] + p[1][0] + p[2][0]) / 3, (p[0][1] + p[1][1] + p[2][1]) / 3});
      edges.push_back(
          std::max({(p[1] - p[0]).head<2>().norm(), (p[2] - p[1]).head<2>().norm(), (p[0] - p[2]).head<2>().norm()}));
    }
    if (centres.empty()) return;
    std::nth_element(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2), edges.end());
    edge = edges[edges.size() / 2];
  }

  double least_side(int height) const { return std::max(0.02 * height, 6 * edge); }

  /// The window around these of them.
  Window around(std::span<const Point> points, int height) const {
    Point low = points[0], high = points[0];
    for (const Point& c : points)
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], c[k]);
        high[k] = std::max(high[k], c[k]);
      }
    const double side = std::max(high[0] - low[0], high[1] - low[1]) + 4 * edge;
    return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, std::max(side, least_side(height))};
  }
};

}  // namespace

std::optional<Window> worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height,
                                       double largest_share) {
  const RedFaces red(drawable, camera, width, height);
  if (red.centres.empty()) return {};
  const double largest = largest_share * height;
  const Window window = red.around(red.centres, height);
  if (window.side <= largest) return window;
  if (red.least_side(height) > largest) return {};
  return around_most(red.centres, largest);
}

std::vector<Window> all_worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height,
                                         double largest_share, std::size_t most) {
  const std::optional<Window> first = worth_magnifying(drawable, camera, width, height, largest_share);
  if (!first) return {};
  const RedFaces red(drawable, camera, width, height);
  std::vector<Window> windows;
  std::vector<Point> left = red.centres;
  const double largest = largest_share * height;
  for (Window next = *first;; next = around_most(left, largest)) {
    const auto inside = std::stable_partition(left.begin(), left.end(),
                                              [&](const Point& c) { return distance(next, c) > 0.5 * next.side; });
    const auto members = std::span(left).subspan(static_cast<std::size_t>(inside - left.begin()));
    const Window closer = red.around(members, height);
    if (closer.side < next.side) next = closer;
    const bool overlaps = std::any_of(windows.begin(), windows.end(), [&](const Window& window) {
      return distance(window, {next.x, next.y}) < 0.5 * (window.side + next.side);
    });
    const bool has_enough =
        static_cast<double>(members.size()) >= least_share * static_cast<double>(red.centres.size());
    if (windows.empty() || (has_enough && !overlaps)) windows.push_back(next);
    left.erase(inside, left.end());
    if (left.empty() || windows.size() == most) return windows;
  }
}

Camera narrowed(const Camera& camera, const Window& window, int width, int height) {
  Camera narrow = camera;
  const double tangent = 2 * camera.half_height / height;
  narrow.centre_x = camera.centre_x + tangent * (window.x - 0.5 * width);
  narrow.centre_y = camera.centre_y + tangent * (0.5 * height - window.y);
  narrow.half_height = 0.5 * tangent * window.side;
  return narrow;
}

}  // namespace unsnarl
