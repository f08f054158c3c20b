#include <algorithm>
#include <cmath>
#include <numbers>

#include "samples/block_surface.h"
#include "samples/lattice_noise.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"
#include "samples/sphere_grid.h"

namespace unsnarl {
namespace {

constexpr double pi = std::numbers::pi;

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A torso with one arm, posed as by a skeleton: the arm swings down and inwards until the hand is in the belly.
Surface posed_limb(int resolution, const SampleValues& values) {
  std::vector<Block> blocks;
  for (int y = 0; y < 5; ++y)
    for (int x = -1; x < 1; ++x)
      for (int z = -1; z < 1; ++z) blocks.push_back({x, y, z});
  for (int x = 1; x < 5; ++x) blocks.push_back({x, 4, 0});
  Surface surface = sample_blocks(blocks, std::max(2, resolution / 10), FaceKind::quads, 0.6);
  const Vec3 shoulder(1.0, 4.4, 0.5);
  const double swing = values["swing"] * pi / 180;
  for (std::size_t v = 0; v < surface.positions.size(); v += 3) {
    Eigen::Map<Vec3> p(&surface.positions[v]);
    const double weight = smooth_step((p[0] - 0.9) / 1.2);
    const Eigen::Matrix3d turn = (Eigen::AngleAxisd(-0.35 * weight, Vec3::UnitY()) *
                                  Eigen::AngleAxisd(-swing * weight, Vec3::UnitZ()))
                                     .toRotationMatrix();
    p = shoulder + turn * (p - shoulder);
  }
  return surface;
}

/// Cushions of quads pushed into each other, and a strap through them.
Surface overlapping_quads(int resolution, const SampleValues& values) {
  const double overlap = values["overlap"];
  MeshBuilder builder;
  const auto cushion = [&](const Vec3& centre, double turned) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(turned, Vec3(0.2, 1, 0.1).normalized()).toRotationMatrix();
    builder.append(sample_sphere(std::max(2, resolution / 4), FaceKind::quads, [&](const Vec3& d) {
      // A superellipsoid: x^4 + y^2 + z^4 = 1, flattened.
      const double r = std::pow(std::pow(d[0], 4) + d[1] * d[1] * d[1] * d[1] + std::pow(d[2], 4), -0.25);
      return Vec3(centre + turn * Vec3(r * d[0], 0.45 * r * d[1], r * d[2]));
    }));
  };
  cushion(Vec3::Zero(), 0.2);
  cushion({0.3, 0.9 * (1 - overlap), 0.1}, 0.9);
  builder.append(sample_grid({{-1.5, 1.5, resolution}, {-0.25, 0.25, std::max(3, resolution / 6)}, FaceKind::quads},
                             [](double u, double v) {
                               return Vec3(u, 0.5 + 0.35 * std::cos(2.2 * u) + 0.1 * v, v + 0.15 * u);
                             }));
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
    const Vec3 out(s * std::cos(angle), std::sqrt(1 - s * s), s * std::sin(angle));
    const Vec3 side = out.cross(Vec3(0.3, 1, 0.2)).normalized();
    const Vec3 fall = (Vec3(0, -1, 0) + 0.6 * out).normalized();
    const double curl = 0.25 * (hashed_unit(21, id) - 0.5), lift = 0.15 + 0.25 * hashed_unit(22, id);
    builder.append(sample_grid(
        {{0, 1.3, resolution / 2}, {-0.11, 0.11, 2}, k % 3 == 0 ? FaceKind::triangles : FaceKind::quads},
        [&](double t, double w) {
          const double bow = t * (1.3 - t);
          return Vec3(0.97 * out.cwiseProduct(Vec3(0.85, 1.05, 0.95)) + bow * lift * out + 0.8 * t * fall + curl * t * t * side +
                      w * (1 - 0.5 * t) * (side + 0.5 * curl * t * out));
        }));
  }
  return builder.take();
}

}  // namespace

std::vector<SampleMaker> modelled_samples() {
  return {
      {{"posed_limb",
        "smooth body posed by a skeleton, its arm pressed into the torso: closed, genus 0, quads",
        {{"swing", 118, 0, 150, "angle at the shoulder, in degrees"}}},
       50,
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
  };
}

}  // namespace unsnarl
