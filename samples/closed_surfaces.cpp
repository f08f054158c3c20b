#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/block_surface.h"
#include "samples/mesh_builder.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"
#include "samples/sphere_grid.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// A sphere's steps along its equator are four sides of the cube that it is made from.
int cube_divisions(int resolution) {
  return std::max(2, resolution / 4);
}

/// After L. Sacht, A. Jacobson, D. Panozzo, C. Schueller, O. Sorkine-Hornung: "Consistent Volumetric Discretizations
/// Inside Self-Intersecting Surfaces" (2013): top and bottom of a disc are pushed through each other.
Surface flying_saucer(int resolution, const SampleValues& values) {
  const double dent = values["dent"];
  return sample_sphere(cube_divisions(resolution), FaceKind::triangles, [&](const Vec3& d) {
    const double r = std::sqrt(d[0] * d[0] + d[2] * d[2]);
    // Height of the top over the radius; the bottom is its mirror image. Negative within r < dent.
    const double height = d[1] * (0.55 * r - 0.55 * dent);
    return Vec3(d[0], height + 0.02 * d[0] * d[2], d[2]);
  });
}

Surface figure8_torus(int resolution, const SampleValues& values) {
  const int turns = values.whole("turns");
  return sample_grid({{0, 2 * pi, resolution, Seam::closed},
                      {0, 2 * pi, steps_for(6, resolution, 12, 8), Seam::closed},
                      FaceKind::quads},
                     [&](double u, double v) {
                       const double a = turns * u + 0.4, x = portable::sin(v), y = 0.5 * portable::sin(2 * v);
                       const double r = 2 + portable::cos(a) * x - portable::sin(a) * y;
                       return Vec3(r * portable::cos(u), portable::sin(a) * x + portable::cos(a) * y,
                                   r * portable::sin(u));
                     });
}

/// A torus whose tube reaches across the axis. On a round ring all of the tube would meet in two points of the axis.
Surface spindle_torus(int resolution, const SampleValues& values) {
  const double ring = values["ring"], eccentricity = values["eccentricity"];
  return sample_grid({{0, 2 * pi, resolution, Seam::closed}, {0, 2 * pi, resolution / 2, Seam::closed}},
                     [&](double u, double v) {
                       const double r = ring * (1 + eccentricity * portable::cos(2 * u)) + portable::cos(v);
                       return Vec3(r * portable::cos(u), portable::sin(v), r * portable::sin(u));
                     });
}

/// A plate with holes rolled up so far that its ends, handles and all, run through each other.
Surface pretzel(int resolution, const SampleValues& values) {
  const int genus = values.whole("genus");
  std::vector<Block> blocks;
  for (int x = 0; x < 2 * genus + 1; ++x)
    for (int y = 0; y < 3; ++y)
      if (x % 2 == 0 || y != 1) blocks.push_back({x, y, 0});
  const int length = 2 * genus + 1;
  Surface surface = sample_blocks(blocks, std::max(2, resolution / length), FaceKind::quads, 0.45);
  const double bend = values["bend"] * pi / 180;
  const double radius = length / bend;
  for (std::size_t v = 0; v < surface.positions.size(); v += 3) {
    double* p = &surface.positions[v];
    const double angle = (p[0] / length - 0.5) * bend, r = radius + p[2] - 0.5;
    // Tilted a little along the way, so that the ends do not meet face to face.
    const double y = p[1] - 1.5 + 0.25 * angle;
    p[0] = r * portable::sin(angle);
    p[1] = y;
    p[2] = r * portable::cos(angle);
  }
  return surface;
}

/// Spheres on the corners of a triangle, each through the others: with three, double circles that cross in two triple
/// points.
Surface intersecting_spheres(int resolution, const SampleValues& values) {
  const int count = values.whole("count");
  MeshBuilder builder;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * k / count;
    const Vec3 centre = values["distance"] * Vec3(portable::cos(angle), 0.13 * k, portable::sin(angle));
    const Eigen::Matrix3d turn = rotation_about(Vec3(1, 2, 3).normalized(), 0.7 * k);
    builder.append(sample_sphere(std::max(2, resolution / 4), FaceKind::triangles,
                                 [&](const Vec3& d) { return Vec3(centre + turn * d); }));
  }
  return builder.take();
}

/// Rings in a row, each through its neighbour's tube instead of through its hole.
Surface linked_rings(int resolution, const SampleValues& values) {
  const int count = values.whole("count");
  MeshBuilder builder;
  for (int k = 0; k < count; ++k) {
    const Vec3 centre(values["distance"] * k, 0.04 * k, 0.03 * k);
    const Eigen::Matrix3d turn = rotation_about(Vec3::UnitX(), k * pi / 2 + 0.2 * k);
    const double tube = 0.3;
    builder.append(sample_grid({{0, 2 * pi, resolution, Seam::closed},
                                {0, 2 * pi, steps_for(tube, resolution, 1, 6), Seam::closed},
                                k % 2 == 0 ? FaceKind::quads : FaceKind::triangles},
                               [&](double u, double v) {
                                 const double r = 1 + tube * portable::cos(v);
                                 return Vec3(centre + turn * Vec3(r * portable::cos(u), tube * portable::sin(v),
                                                                  r * portable::sin(u)));
                               }));
  }
  return builder.take();
}

}  // namespace

std::vector<SampleMaker> closed_surface_samples() {
  return {
      {{"flying_saucer",
        "disc-like closed surface whose top and bottom pass through each other: genus 0, one double circle",
        {{"dent", 0.5, 0.1, 0.9, "radius of the part that is turned through, saucer radius 1"}}},
       76,
       flying_saucer},
      {{"figure8_torus",
        "figure eight swept around a ring with full turns: orientable, genus 1, one double circle",
        {{"turns", 1, 0, 5, "full turns of the figure eight", true}}},
       72,
       figure8_torus},
      {{"spindle_torus",
        "torus whose tube is thicker than its oval ring: genus 1, a spindle inside with two sharp ends",
        {{"ring", 0.5, 0, 0.95, "mean radius of the ring, tube radius 1"},
         {"eccentricity", 0.5, 0, 1, "how oval the ring is; 0: round, and everything meets in two points"}}},
       64,
       spindle_torus},
      {{"pretzel",
        "plate with holes rolled up until its handles run through each other: genus 2 or as told",
        {{"genus", 2, 1, 6, "number of holes", true},
         {"bend", 410, 30, 600, "angle that the plate is rolled by, in degrees"}}},
       30,
       pretzel},
      {{"intersecting_spheres",
        "spheres through each other: closed components, double circles that meet in triple points",
        {{"count", 3, 2, 12, "number of spheres", true},
         {"distance", 0.65, 0.2, 2, "distance of their centres from the middle, radius 1"}}},
       36,
       intersecting_spheres},
      {{"linked_rings",
        "chain of rings whose tubes pass through each other: genus 1 each",
        {{"count", 3, 2, 12, "number of rings", true},
         {"distance", 1.75, 0.5, 2.5, "distance between neighbours, ring radius 1"}}},
       48,
       linked_rings},
  };
}

}  // namespace unsnarl
