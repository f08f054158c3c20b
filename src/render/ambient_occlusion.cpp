#include "render/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

/// One direction of the blur: neighbours count as far as they lie near the pixel's tangent plane.
void blur(std::span<const Eigen::Vector3f> points, std::span<const Eigen::Vector3f> normals, int width, int height,
          int dx, int dy, float plane_distance, std::span<const float> in, std::span<float> out) {
  constexpr int reach = 4;  ///< The blur takes in neighbours up to this far away (unit: pixels)
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      if (points[i][2] == 0) continue;
      float sum = 0, weights = 0;
      for (int k = -reach; k <= reach; ++k) {
        const int u = x + k * dx, v = y + k * dy;
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const std::size_t j = static_cast<std::size_t>(v) * width + u;
        if (points[j][2] == 0) continue;
        const float away = std::abs(normals[i].dot(points[j] - points[i])) / (plane_distance * -points[i][2]);
        const float weight = std::max(0.0F, 1 - away) + 1e-4F;
        sum += weight * in[j];
        weights += weight;
      }
      out[i] = sum / weights;
    }
}

}  // namespace

std::vector<float> ambient_occlusion(std::span<const Eigen::Vector3f> points, std::span<const Eigen::Vector3f> normals,
                                     int width, int height, double pixel_tangent,
                                     const AmbientOcclusionOptions& options) {
  std::vector<float> visible(points.size(), 1.0F), blurred(points.size(), 1.0F);
  const auto radius_tangent = static_cast<float>(options.radius_pixels * pixel_tangent);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const Eigen::Vector3f& p = points[i];
      if (p[2] == 0) continue;
      const float radius = radius_tangent * -p[2];
      // A turn of its own for each pixel of a 4 x 4 tile, which the blur evens out again.
      const double turn = 2.4 * ((x & 3) * 4 + (y & 3)) * 0.3927;
      float blocked = 0;
      for (int k = 0; k < options.samples; ++k) {
        const double share = (k + 0.5) / options.samples, angle = turn + 2 * EIGEN_PI * 5 * share;
        const int u = x + static_cast<int>(std::lround(options.radius_pixels * share * portable::cos(angle)));
        const int v = y + static_cast<int>(std::lround(options.radius_pixels * share * portable::sin(angle)));
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const Eigen::Vector3f& q = points[static_cast<std::size_t>(v) * width + u];
        if (q[2] == 0) continue;
        const Eigen::Vector3f d = q - p;
        const float squared = d.squaredNorm();
        const float fade = std::max(0.0F, 1 - squared / (radius * radius));
        const float height_above = normals[i].dot(d) - 0.02F * radius;
        if (height_above > 0) blocked += fade * height_above / std::sqrt(squared + 1e-4F * radius * radius);
      }
      visible[i] = std::clamp(
          1 - static_cast<float>(2 * options.strength) * blocked / static_cast<float>(options.samples), 0.0F, 1.0F);
    }
  const float plane_distance = 0.25F * radius_tangent;
  blur(points, normals, width, height, 1, 0, plane_distance, visible, blurred);
  blur(points, normals, width, height, 0, 1, plane_distance, blurred, visible);
  return visible;
}

}  // namespace unsnarl
