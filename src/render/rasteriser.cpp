#include "render/rasteriser.h"

#include <algorithm>
#include <cmath>

namespace unsnarl {

std::array<float, 3> screen_weights(const std::array<ScreenPoint, 3>& c, float x, float y) {
  const double area = double(c[1].x - c[0].x) * (c[2].y - c[0].y) - double(c[1].y - c[0].y) * (c[2].x - c[0].x);
  if (area == 0) return {0, 0, 0};
  const double w1 = (double(x - c[0].x) * (c[2].y - c[0].y) - double(y - c[0].y) * (c[2].x - c[0].x)) / area;
  const double w2 = (double(c[1].x - c[0].x) * (y - c[0].y) - double(c[1].y - c[0].y) * (x - c[0].x)) / area;
  return {static_cast<float>(1 - w1 - w2), static_cast<float>(w1), static_cast<float>(w2)};
}

void rasterise(std::span<const ScreenPoint> points, std::span<const Triangle> triangles, std::span<const Index> ids,
               VisibilityBuffer& buffer) {
  for (Index id : ids) {
    const Triangle& t = triangles[id];
    const ScreenPoint &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    if (!(a.inverse_depth > 0 && b.inverse_depth > 0 && c.inverse_depth > 0)) continue;
    const float left = std::min({a.x, b.x, c.x}), right = std::max({a.x, b.x, c.x});
    const float top = std::min({a.y, b.y, c.y}), bottom = std::max({a.y, b.y, c.y});
    if (right <= 0 || left >= static_cast<float>(buffer.width) || bottom <= 0 ||
        top >= static_cast<float>(buffer.height))
      continue;
    const double area = double(b.x - a.x) * (c.y - a.y) - double(b.y - a.y) * (c.x - a.x);
    if (area == 0 || !std::isfinite(area)) continue;
    const int x0 = static_cast<int>(std::max(0.0F, std::ceil(left - 0.5F)));
    const int y0 = static_cast<int>(std::max(0.0F, std::ceil(top - 0.5F)));
    const int x1 = static_cast<int>(std::min(static_cast<float>(buffer.width) - 1, std::floor(right - 0.5F)));
    const int y1 = static_cast<int>(std::min(static_cast<float>(buffer.height) - 1, std::floor(bottom - 0.5F)));
    if (x0 > x1) continue;
    const double w1_x = (c.y - a.y) / area, w1_y = -(c.x - a.x) / area;
    const double w2_x = -(b.y - a.y) / area, w2_y = (b.x - a.x) / area;
    const double rise_b = b.inverse_depth - a.inverse_depth, rise_c = c.inverse_depth - a.inverse_depth;
    for (int y = y0; y <= y1; ++y) {
      double w1 = w1_x * (x0 + 0.5 - a.x) + w1_y * (y + 0.5 - a.y);
      double w2 = w2_x * (x0 + 0.5 - a.x) + w2_y * (y + 0.5 - a.y);
      std::size_t at = buffer.at(x0, y);
      for (int x = x0; x <= x1; ++x, ++at, w1 += w1_x, w2 += w2_x) {
        if (w1 < 0 || w2 < 0 || w1 + w2 > 1) continue;
        const auto inverse_depth = static_cast<float>(a.inverse_depth + w1 * rise_b + w2 * rise_c);
        if (inverse_depth <= buffer.inverse_depth[at]) continue;
        buffer.inverse_depth[at] = inverse_depth;
        buffer.triangle[at] = id;
      }
    }
  }
}

}  // namespace unsnarl
