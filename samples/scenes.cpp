#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "samples/anchor_scene.h"
#include "samples/dressed_figure.h"
#include "samples/lattice_noise.h"
#include "samples/medusa.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"
#include "samples/sphere_grid.h"
#include "samples/tube.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// Paper fig. 8 shows such a scene: a bell, a second one inside, and tentacles through both and through each other.
Surface jellyfish(int resolution, const SampleValues& values) {
  MeshBuilder builder;
  const auto bell = [&](double size, double ruffle, double drop) {
    const int around = resolution;
    builder.append(sample_grid({{0, 2 * pi, around, Seam::closed, 0.37 * size},
                                {0.12, 1.9, steps_for(1.8, around, 2 * pi, 6)},
                                FaceKind::quads},
                               [&](double u, double v) {
                                 const double wave = ruffle * portable::pow(v / 1.9, 4) * portable::sin(7 * u);
                                 const double r = size * (portable::sin(v) + wave);
                                 return Vec3(r * portable::cos(u), size * 0.8 * portable::cos(v) - drop + 0.1 * wave,
                                             r * portable::sin(u));
                               }));
  };
  bell(1.0, 0.13, 0);
  bell(0.86, 0.24, -0.02);  // its ruffles reach through the outer bell
  const int tentacles = values.whole("tentacles");
  for (int k = 0; k < tentacles; ++k) {
    const auto id = static_cast<std::uint32_t>(k);
    const double angle = 2 * pi * (k + 0.6 * hashed_unit(11, id)) / tentacles, start = 0.6 + 0.3 * hashed_unit(12, id);
    const double swing = 0.35 + 0.3 * hashed_unit(13, id), phase = 2 * pi * hashed_unit(14, id);
    const Vec3 out(portable::cos(angle), 0, portable::sin(angle)), side(-portable::sin(angle), 0, portable::cos(angle));
    // From inside the bells, whose walls some of them cross, down into the bundle.
    const auto centre = [=](double t) {
      return Vec3(start * (1 - 0.5 * t) * out + Vec3(0, 0.38 - 2.2 * t, 0) +
                  swing * t * (portable::sin(5 * t + phase) * side + 0.6 * portable::cos(4 * t + phase) * out));
    };
    builder.append(sample_tube({centre, 0, 1, false, [](double t) { return 0.085 - 0.05 * t; },
                                std::max(8, resolution / 2), 6, k % 2 == 0 ? FaceKind::triangles : FaceKind::quads}));
  }
  return builder.take();
}

/// Paper §4.2 repairs such scenes around what must not move: a post, and balls through it and through their neighbours.
Surface anchored_balls(int resolution, const SampleValues& values) {
  const int count = values.whole("count"), steps = std::max(2, resolution / 4);
  const double radius = 0.5, post = 0.35;
  MeshBuilder builder;
  builder.append(sample_sphere(steps, FaceKind::triangles,
                               [&](const Vec3& d) { return Vec3(post * d[0], 1.3 * d[1], post * d[2]); }));
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * k / count, height = 0.11 * (k % 3 - 1);
    const double width = std::sqrt(1 - portable::pow(height / 1.3, 2)) * post;  // of the post at this height
    const Vec3 out(portable::cos(angle), 0, portable::sin(angle));
    const Vec3 centre = (width + radius - values["depth"]) * out + Vec3(0, height, 0);
    const Eigen::Matrix3d turn = rotation_about(Vec3(2, 1, 3).normalized(), 0.3 + 1.1 * k);
    builder.append(
        sample_sphere(steps, FaceKind::triangles, [&](const Vec3& d) { return Vec3(centre + radius * (turn * d)); }));
  }
  return builder.take();
}

/// A block of six faces, whose corners are the images of those of the cube from -1 to 1.
void add_block(MeshBuilder& builder, const DirectionMap& place) {
  std::array<Index, 8> corner{};
  for (int k = 0; k < 8; ++k)
    corner[k] = builder.add_vertex(place(Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    builder.add_face({corner[a], corner[b], corner[c], corner[d]});
}

/// A stool as one puts it together of parts: legs that end in the seat, rungs that end in the legs.
Surface stool(int resolution, const SampleValues& values) {
  const double depth = values["depth"], thickness = 0.16, leg = 0.11, rung = 0.06, slant = 0.16;
  MeshBuilder builder;
  builder.append(sample_sphere(std::max(2, resolution / 4), FaceKind::quads, [&](const Vec3& d) {
    const double round =
        portable::pow(portable::pow(std::sqrt(d[0] * d[0] + d[2] * d[2]), 6) + portable::pow(d[1], 6), 1.0 / 6);
    return Vec3(d[0] / round, thickness * d[1] / round, d[2] / round);
  }));
  const double top = -thickness + depth, length = 1.7;
  const auto on_leg = [&](double side, double end, double height) {  // of its middle line
    const double out = 0.55 + slant * (top - height) / length;
    return Vec3(side * out, height, end * out);
  };
  for (const double end : {-1.0, 1.0})
    add_block(builder, [&](const Vec3& c) {
      const Vec3 middle = on_leg(c[0], end, -1.15);
      const double reach = std::abs(middle[0]) - leg + depth;
      return Vec3(reach * c[0], middle[1] + rung * c[1], middle[2] + rung * c[2]);
    });
  for (const double side : {-1.0, 1.0})
    for (const double end : {-1.0, 1.0})
      add_block(builder, [&](const Vec3& c) {
        const Vec3 middle = on_leg(side, end, top + (c[1] - 1) / 2 * length);
        return Vec3(middle[0] + leg * c[0], middle[1], middle[2] + leg * c[2]);
      });
  return builder.take();
}

/// Closed surfaces that should lie inside each other, as of a head model: most of the inner one is outside, where the
/// shortest way apart puts it beside the others.
Surface crossing_shells(int resolution, const SampleValues& values) {
  const int steps = std::max(2, resolution / 4);
  MeshBuilder builder;
  const auto shell = [&](double radius, double turn, double waves, const Vec3& centre) {
    const Eigen::Matrix3d turned = rotation_about(Vec3(1, 2, 3).normalized(), turn);
    builder.append(sample_sphere(steps, FaceKind::triangles, [&](const Vec3& d) {
      const double height = 1 + waves * portable::sin(6 * d[0]) * portable::sin(6 * d[1]) * portable::cos(6 * d[2]);
      return Vec3(centre + radius * height * (turned * d));
    }));
  };
  shell(0.9, 0.2, 0, {values["shift"], 0.02, 0.01});
  shell(1, 0.7, values["waves"], Vec3::Zero());
  shell(1.05, 1.3, values["waves"], Vec3::Zero());
  return builder.take();
}

}  // namespace

std::vector<SampleMaker> scene_samples() {
  return {
      {{"jellyfish",
        "scene of many objects: two bells and tentacles through each other",
        {{"tentacles", 10, 1, 60, "number of tentacles", true}}},
       56,
       jellyfish},
      {{"anchored_balls",
        "scene to repair around a fixed part: balls through a post, the group 'anchor', and through each other",
        {{"count", 5, 1, 6, "number of balls", true}, {"depth", 0.12, 0.01, 0.3, "how far they stick in the post"}},
        true,
        {"anchor", "ball"}},
       28,
       anchored_balls},
      {{"stool",
        "scene of parts that overlap on purpose: legs that end in a seat, rungs that end in the legs",
        {{"depth", 0.12, 0.01, 0.25, "how far parts reach into others, where the seat has radius 1"}},
        true,
        {"seat", "rung", "rung_2", "leg", "leg_2", "leg_3", "leg_4"}},
       56,
       stool},
      {{"crossing_shells",
        "scene of closed surfaces that should lie inside each other: 'inner' in 'outer' in 'skin', all crossing",
        {{"shift", 0.8, 0, 1.5, "how far the inner one is off, where the outer one has radius 1"},
         {"waves", 0.12, 0, 0.3, "height of the waves of the others, a share of their radius"}},
        true,
        {"inner", "outer", "skin"}},
       56,
       crossing_shells},
      {{"anchor_scene",
        "scene of fixed, rigid and soft parts: an anchor; a link, a hoop, a crate and a barrel; a buoy and a ribbon",
        {{"depth", 0.25, 0, 0.5, "how far they stick in each other, where the shank is 1 thick"}},
        true,
        {"anchor", "link", "hoop", "crate", "barrel", "buoy", "ribbon"}},
       48,
       anchor_scene},
      {{"dressed_figure",
        "scene of a figure, 'body', and a tunic on it, 'tunic', whose folds go through it",
        {{"ease", 0.1, -0.2, 0.5, "distance of the tunic from the figure, where a sleeve is 2 thick"},
         {"folds", 0.3, 0, 0.5, "depth of the folds, where a sleeve is 2 thick"}},
        true,
        {"body", "tunic"}},
       51,
       dressed_figure},
      {{"medusa",
        "bust with snakes for hair, each a component of its own: through the scalp and through each other",
        {{"snakes", 60, 1, 400, "number of snakes", true},
         {"thickness", 1, 0.1, 2, "of the snakes; at 0.25, and without a push, nothing intersects"},
         {"push", 0.16, 0, 0.4, "how far their roots are pushed toward the head, whose height is 2"}}},
       22,
       medusa},
  };
}

}  // namespace unsnarl
