#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/block_surface.h"
#include "samples/lattice_noise.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"
#include "samples/sphere_grid.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Turns what lies beyond a joint about it, blended over a short stretch as skin weights are. Nothing below the chest.
void bend_at(Surface& surface, const Vec3& joint, const Vec3& along, const Vec3& axis, double degrees,
             const std::vector<double>& rest_reach, const std::vector<double>& rest_height) {
  for (std::size_t v = 0; v < rest_reach.size(); ++v) {
    Eigen::Map<Vec3> p(&surface.positions[3 * v]);
    const double weight =
        smooth_step((rest_reach[v] - joint.dot(along)) / 1.6 + 0.5) * smooth_step((rest_height[v] - 2) / 2);
    if (weight == 0) continue;
    p = joint + rotation_about(axis, weight * degrees * pi / 180) * Vec3(p - joint);
  }
}

/// A doll in T-pose, posed as by a skeleton: one arm hangs, the other is bent until the forearm is in the belly.
Surface posed_limb(int resolution, const SampleValues& values) {
  std::vector<Block> blocks;
  const auto add = [&](int x0, int x1, int y0, int y1) {
    for (int x = x0; x < x1; ++x)
      for (int y = y0; y < y1; ++y)
        for (int z = -1; z < 1; ++z) blocks.push_back({x, y, z});
  };
  add(0, 5, 0, 6);                     // torso
  add(0, 2, -6, 0), add(3, 5, -6, 0);  // legs
  add(-6, 0, 4, 6), add(5, 11, 4, 6);  // arms
  add(2, 3, 6, 7), add(1, 4, 7, 10);   // neck, head
  Surface surface = sample_blocks(blocks, std::max(1, resolution / 17), FaceKind::quads, 0.62);
  // Bends are weighted by where a vertex was at rest, outer joints first.
  std::vector<double> right(surface.positions.size() / 3), left(right.size()), height(right.size());
  for (std::size_t v = 0; v < right.size(); ++v) {
    right[v] = surface.positions[3 * v];
    left[v] = -right[v];
    height[v] = surface.positions[3 * v + 1];
  }
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  bend_at(surface, {7.8, 5, 0}, x, (-z + 0.15 * x).normalized(), values["elbow"], right, height);
  bend_at(surface, {5.4, 5, 0}, x, -z, values["shoulder"], right, height);
  bend_at(surface, {-0.4, 5, 0}, -x, z, 55, left, height);
  for (double& coordinate : surface.positions) coordinate *= 0.1;
  return surface;
}

/// Cushions of quads pushed into each other, and a strap through them.
Surface overlapping_quads(int resolution, const SampleValues& values) {
  const double overlap = values["overlap"];
  MeshBuilder builder;
  const auto cushion = [&](const Vec3& centre, double turned) {
    const Eigen::Matrix3d turn = rotation_about(Vec3(0.2, 1, 0.1).normalized(), turned);
    builder.append(sample_sphere(std::max(2, resolution / 4), FaceKind::quads, [&](const Vec3& d) {
      // A superellipsoid: x^4 + y^2 + z^4 = 1, flattened.
      const double r =
          portable::pow(portable::pow(d[0], 4) + d[1] * d[1] * d[1] * d[1] + portable::pow(d[2], 4), -0.25);
      return Vec3(centre + turn * Vec3(r * d[0], 0.45 * r * d[1], r * d[2]));
    }));
  };
  cushion(Vec3::Zero(), 0.2);
  cushion({0.3, 0.9 * (1 - overlap), 0.1}, 0.9);
  builder.append(sample_grid(
      {{-1.5, 1.5, resolution}, {-0.25, 0.25, std::max(3, resolution / 6)}, FaceKind::quads},
      [](double u, double v) { return Vec3(u, 0.5 + 0.35 * portable::cos(2.2 * u) + 0.1 * v, v + 0.15 * u); }));
  return builder.take();
}

/// Strips rooted in a scalp, through it and through each other.
Surface hair_cards(int resolution, const SampleValues& values) {
  const int cards = values.whole("cards");
  MeshBuilder builder;
  builder.append(sample_sphere(std::max(2, resolution / 3), FaceKind::quads,
                               [](const Vec3& d) { return Vec3(d.cwiseProduct(Vec3(0.85, 1.05, 0.95))); }));
  for (int k = 0; k < cards; ++k) {
    const auto id = static_cast<std::uint32_t>(k);
    // Roots spread over the upper cap by the golden angle.
    const double angle = k * pi * (3 - std::sqrt(5.0)), s = 0.95 * std::sqrt((k + 0.5) / cards);
    const Vec3 out(s * portable::cos(angle), std::sqrt(1 - s * s), s * portable::sin(angle));
    const Vec3 side = out.cross(Vec3(0.3, 1, 0.2)).normalized();
    const Vec3 fall = (Vec3(0, -1, 0) + 0.6 * out).normalized();
    const double curl = 0.25 * (hashed_unit(21, id) - 0.5), lift = 0.15 + 0.25 * hashed_unit(22, id);
    builder.append(
        sample_grid({{0, 1.3, resolution / 2}, {-0.11, 0.11, 2}, k % 3 == 0 ? FaceKind::triangles : FaceKind::quads},
                    [&](double t, double w) {
                      const double bow = t * (1.3 - t);
                      return Vec3(0.97 * out.cwiseProduct(Vec3(0.85, 1.05, 0.95)) + bow * lift * out + 0.8 * t * fall +
                                  curl * t * t * side + w * (1 - 0.5 * t) * (side + 0.5 * curl * t * out));
                    }));
  }
  return builder.take();
}

/// Paper fig. 17: high-frequency noise on a plane square.
Surface crumpled_sheet(int resolution, const SampleValues& values) {
  const double cells = values["frequency"], amplitude = values["amplitude"] / cells;
  const auto seed = static_cast<std::uint32_t>(values.whole("seed"));
  return sample_grid({{-1, 1, resolution}, {-1, 1, resolution}}, [&](double u, double v) {
    Vec3 noise;
    for (int k = 0; k < 3; ++k) {
      const double x = (u + 1) * cells / 2 + 0.31 * k, y = (v + 1) * cells / 2 + 0.57 * k;
      const auto layer = 8 * seed + 2 * static_cast<std::uint32_t>(k);
      noise[k] = lattice_noise(x, y, layer) + 0.5 * lattice_noise(2 * x, 2 * y, layer + 1);
    }
    return Vec3(Vec3(u, 0, v) + 2 * amplitude * noise);
  });
}

}  // namespace

std::vector<SampleMaker> modelled_samples() {
  return {
      {{"posed_limb",
        "doll posed by a skeleton, its forearm pressed into the belly: closed, genus 0, quads",
        {{"shoulder", 62, 0, 90, "angle at the shoulder, in degrees"},
         {"elbow", 95, 0, 150, "angle at the elbow, in degrees"}}},
       51,
       posed_limb},
      {{"overlapping_quads",
        "two cushions pushed into each other and a strap through both: quads",
        {{"overlap", 0.45, 0, 1, "depth of the cushions in each other, in cushion heights"}}},
       48,
       overlapping_quads},
      {{"hair_cards",
        "open strips rooted in a scalp, through it and through each other: triangles and quads",
        {{"cards", 60, 1, 1000, "number of strips", true}}},
       36,
       hair_cards},
      {{"crumpled_sheet",
        "plane square with high-frequency noise in all directions: a dense network of short double curves",
        {{"amplitude", 0.5, 0, 3, "height of the noise, in lengths of its cells"},
         {"frequency", 12, 2, 200, "cells of the noise along a side"},
         {"seed", 1, 0, 1e6, "seed of the noise", true}}},
       40,
       crumpled_sheet},
  };
}

}  // namespace unsnarl
