#include "render/closeup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace unsnarl {

std::optional<Window> worth_magnifying(const Drawable& drawable, const Camera& camera, int width, int height,
                                       double largest_share) {
  std::vector<std::array<double, 2>> centres;
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
  if (centres.empty()) return {};
  std::nth_element(edges.begin(), edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2), edges.end());
  const double edge = edges[edges.size() / 2];
  const double least = std::max(0.02 * height, 6 * edge);

  std::array<double, 2> low = centres[0], high = centres[0];
  for (const auto& c : centres)
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  Window window{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2,
                std::max(high[0] - low[0], high[1] - low[1]) + 4 * edge};
  window.side = std::max(window.side, least);
  const double largest = largest_share * height;
  if (window.side <= largest) return window;

  if (least > largest) return {};
  const double cell = 0.5 * largest;
  std::map<std::pair<int, int>, int> counts;
  const auto cell_of = [&](const std::array<double, 2>& c) {
    return std::pair(static_cast<int>(std::floor(c[0] / cell)), static_cast<int>(std::floor(c[1] / cell)));
  };
  for (const auto& c : centres) ++counts[cell_of(c)];
  const auto fullest = std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
                         return a.second < b.second;
                       })->first;
  window = {0, 0, largest};
  double members = 0;
  for (const auto& c : centres) {
    if (cell_of(c) != fullest) continue;
    ++members;
    window.x += (c[0] - window.x) / members;
    window.y += (c[1] - window.y) / members;
  }
  return window;
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
