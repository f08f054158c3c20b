#include "samples/anchor_scene.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/block_surface.h"
#include "samples/parameter_grid.h"
#include "samples/sphere_grid.h"
#include "samples/tube.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// Height of the middle of the arms, which curve up; lengths are in blocks, and the shank stands on the origin.
double height_of_arm(double x) {
  return 0.5 + 0.13 * x * x;
}

/// Shank, arms with flukes, stock and eye: blocks, sheared so that the arms curve up.
Surface anchor(int divisions) {
  std::vector<Block> blocks;
  const auto add = [&](int x0, int x1, int y0, int y1, int z0, int z1) {
    for (int x = x0; x <= x1; ++x)
      for (int y = y0; y <= y1; ++y)
        for (int z = z0; z <= z1; ++z) blocks.push_back({x, y, z});
  };
  add(0, 0, 0, 8, 0, 0);                             // shank
  add(-5, 5, 0, 0, 0, 0);                            // arms
  for (int x : {-5, 5}) add(x, x, 0, 1, -1, 1);      // flukes
  add(0, 0, 7, 7, -3, 3);                            // stock
  add(-1, 1, 9, 9, 0, 0), add(-1, 1, 11, 11, 0, 0);  // eye
  for (int x : {-1, 1}) add(x, x, 10, 10, 0, 0);
  Surface surface = sample_blocks(blocks, divisions, FaceKind::triangles, 0.45);
  for (std::size_t v = 0; v < surface.positions.size() / 3; ++v) {
    Eigen::Map<Vec3> p(&surface.positions[3 * v]);
    p -= Vec3(0.5, 0, 0.5);
    p[1] += height_of_arm(p[0]) - 0.5;
  }
  return surface;
}

Surface crate(const Vec3& centre, int divisions) {
  std::vector<Block> blocks;
  for (int x : {-1, 0})
    for (int y : {-1, 0})
      for (int z : {-1, 0}) blocks.push_back({x, y, z});
  Surface surface = sample_blocks(blocks, divisions, FaceKind::triangles, 0.15);
  const Eigen::Matrix3d turn = rotation_about(Vec3(0.1, 0.2, 1).normalized(), 0.55);
  for (std::size_t v = 0; v < surface.positions.size() / 3; ++v) {
    Eigen::Map<Vec3> p(&surface.positions[3 * v]);
    p = centre + turn * Vec3(p.cwiseProduct(Vec3(0.95, 0.9, 1.1)));
  }
  return surface;
}

Surface ring(const Vec3& centre, const Vec3& axis, double radius, double thickness, int resolution) {
  const Vec3 a = axis.unitOrthogonal(), n = axis.normalized(), b = n.cross(a);
  return sample_tube({[=](double t) { return Vec3(centre + radius * (portable::cos(t) * a + portable::sin(t) * b)); },
                      0, 2 * pi, true, [=](double) { return thickness; }, resolution, std::max(6, resolution / 5)});
}

}  // namespace

Surface anchor_scene(int resolution, const SampleValues& values) {
  const double depth = values["depth"];
  MeshBuilder builder;
  builder.append(anchor(std::max(1, resolution / 16)));
  builder.append(ring({0, 12.1 + depth, 0}, {1, 0, 0.15}, 1.5, 0.28, resolution));         // link
  builder.append(ring({0.6 + depth, 4.4, 0.2}, {-0.25, 1, 0.1}, 1.35, 0.25, resolution));  // hoop
  builder.append(crate({3.1, height_of_arm(3.1) + 1.5 - depth, 0.1}, std::max(1, resolution / 16)));
  const Eigen::Matrix3d lying = rotation_about(Vec3(0.1, 1, -0.3).normalized(), 0.5);
  builder.append(sample_sphere(std::max(2, resolution / 8), FaceKind::triangles, [&](const Vec3& d) {  // barrel
    const double r = portable::pow(d.array().abs().cube().sum(), -1.0 / 3);
    return Vec3(Vec3(-2.2, height_of_arm(2.2) + 1.2 - depth, 0) +
                lying * Vec3(r * d.cwiseProduct(Vec3(0.8, 0.75, 1.25))));
  }));
  builder.append(ring({-3.9, height_of_arm(3.9) - 0.5 - depth, 0.2}, {-1, 1.1, 0.3}, 1.15, 0.38, resolution));  // buoy
  builder.append(sample_grid({{0, 1, 3 * resolution}, {-0.35, 0.35, 4}}, [&](double u, double v) {
    const double turn = 2 * pi * (0.1 + 2.6 * u), radius = 0.95 + 0.45 * portable::sin(17 * u);
    return Vec3(radius * portable::cos(turn), 1.6 + 5.2 * u + v, radius * portable::sin(turn));
  }));
  Surface surface = builder.take();
  for (double& coordinate : surface.positions) coordinate *= 0.2;
  return surface;
}

}  // namespace unsnarl
