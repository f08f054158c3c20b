#include <cmath>
#include <numbers>

#include "geometry/portable_math.h"
#include "samples/lattice_noise.h"
#include "samples/parameter_grid.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

using std::numbers::pi;

/// Paper fig. 12: x^2 = y^2 z. The double line ends in a pinch point in the middle of the sheet.
Surface whitney_umbrella(int resolution, const SampleValues& values) {
  const double reach = values["reach"];
  // The two sides of the double line are sampled at different heights: the range of v is not symmetric.
  return sample_grid({{-1, 1.02, steps_for(2, resolution, 2 * reach, 8)}, {-reach, 1.03 * reach, resolution}},
                     [](double u, double v) { return Vec3(u * v, v * v, u); });
}

/// Paper fig. 11: pages that share the vertices of one spine, each bent so far that it runs through its neighbours.
Surface book(int resolution, const SampleValues& values) {
  const int pages = values.whole("pages");
  const double swing = values["swing"];
  const int along = resolution, out = std::max(4, resolution * 2 / 3);
  MeshBuilder builder;
  std::vector<Index> spine;
  const double height = 1.4;
  for (int i = 0; i <= along; ++i) spine.push_back(builder.add_vertex(Vec3(0, height * (double(i) / along - 0.5), 0)));
  for (int page = 0; page < pages; ++page) {
    std::vector<Index> column = spine;
    for (int j = 1; j <= out; ++j) {
      std::vector<Index> next;
      for (int i = 0; i <= along; ++i) {
        const double s = double(j) / out, y = height * (double(i) / along - 0.5);
        // Fanned over a half turn, each page swinging with a phase of its own.
        const double own = hashed_unit(5, static_cast<std::uint32_t>(page));
        const double angle = pi * (page + 0.5) / pages +
                             swing * portable::sin(pi * s) * portable::sin(2.4 * y + 2 * pi * own) * (0.6 + 0.8 * own);
        next.push_back(
            builder.add_vertex(Vec3(s * portable::cos(angle), y * (1 - 0.015 * page * s), s * portable::sin(angle))));
      }
      for (int i = 0; i < along; ++i) builder.add_cell(column[i], next[i], next[i + 1], column[i + 1], FaceKind::quads);
      column = std::move(next);
    }
  }
  return builder.take();
}

/// A sheet along a nodal cubic: it loops back and passes through itself.
Surface folded_sheet(int resolution, const SampleValues& values) {
  const double loop = values["loop"], slant = 0.12;
  const double half = std::sqrt(loop) * 1.5;
  const auto curve = [&](double t) { return Vec3(t * t * t - loop * t, t * t, 0); };
  return sample_grid(
      {{-half, 1.04 * half, resolution}, {-1, 1, steps_for(2, resolution, 4.5, 6)}, FaceKind::quads},
      [&](double t, double v) { return Vec3(curve(t) + Vec3(0.1 * portable::sin(2 * v), 0, v + slant * t)); });
}

/// The same with holes cut out of it: genus 0, several boundaries.
Surface perforated_fold(int resolution, const SampleValues& values) {
  const int holes = values.whole("holes");
  const double half = 1.6;
  ParameterGrid grid{{-half, 1.04 * half, resolution}, {-1, 1, steps_for(2, resolution, 4.5, 10)}};
  grid.keep = [&](double t, double v) {
    for (int k = 0; k < holes; ++k) {
      const double middle = half * (2.0 * (k + 0.5) / holes - 1);
      const double along = (t - middle) * holes / (1.5 * half), across = v / 0.6;
      if (along * along + across * across < 0.45 * 0.45) return false;
    }
    return true;
  };
  return sample_grid(grid, [](double t, double v) {
    return Vec3(t * t * t - 1.3 * t, t * t + 0.2 * portable::cos(1.5 * v), 1.1 * v + 0.13 * t);
  });
}

/// A wound sheet whose windings run through each other.
Surface spiral_sheet(int resolution, const SampleValues& values) {
  const double turns = values["turns"], wave = values["wave"];
  const double length = 2 * pi * turns;
  return sample_grid({{0, length, resolution}, {0, 1, steps_for(1, resolution, length * 0.65, 6)}, FaceKind::quads},
                     [&](double t, double v) {
                       const double gap = 0.14,
                                    r = 0.35 + gap * t / (2 * pi) + wave * gap * portable::sin(1.7 * t + 2.1 * v);
                       return Vec3(r * portable::cos(t), v + 0.02 * portable::sin(t), r * portable::sin(t));
                     });
}

/// A spiral staircase that turns back and comes down through its own way up.
Surface helicoid_overlapping(int resolution, const SampleValues& values) {
  const double turns = values["turns"];
  const double end = 2 * pi * turns;
  return sample_grid({{0, end, resolution}, {0.15, 1, steps_for(0.85, resolution, end * 0.6, 5)}},
                     [&](double t, double r) {
                       const double rise = 0.9 * portable::sin(pi * t / end * 1.9) + 0.05 * r * portable::cos(3 * r);
                       return Vec3(r * portable::cos(t), rise, r * portable::sin(t));
                     });
}

/// The discriminant of quartics: two cuspidal edges and a double curve run into one point.
Surface swallowtail(int resolution, const SampleValues& values) {
  const double reach = values["reach"];
  return sample_grid(
      {{-1, 0.7, steps_for(1.7, resolution, 2.4 * reach, 8)}, {-reach, 1.02 * reach, resolution}},
      [](double u, double v) { return Vec3(-2 * u * v - 4 * v * v * v, u, u * v * v + 3 * v * v * v * v); });
}

}  // namespace

std::vector<SampleMaker> sheet_samples() {
  return {
      {{"whitney_umbrella",
        "Whitney umbrella: a sheet whose double line ends in a cross-cap singularity",
        {{"reach", 1.2, 0.5, 3, "half the width of the sheet across the double line"}}},
       44,
       whitney_umbrella},
      {{"book",
        "pages welded on one spine, running through each other: non-manifold",
        {{"pages", 7, 3, 40, "number of pages", true}, {"swing", 0.7, 0, 3, "how far the pages swing, in radians"}}},
       20,
       book},
      {{"folded_sheet",
        "sheet that loops back through itself: one double curve from boundary to boundary",
        {{"loop", 1.0, 0.1, 4, "size of the loop"}}},
       64,
       folded_sheet},
      {{"perforated_fold",
        "sheet with holes that loops back through itself: genus 0 with several boundaries",
        {{"holes", 3, 1, 8, "number of holes", true}}},
       64,
       perforated_fold},
      {{"spiral_sheet",
        "wound sheet whose windings wave through each other: many double curves close together",
        {{"turns", 3.5, 2, 10, "number of windings"},
         {"wave", 0.8, 0, 2, "how far the sheet waves, in gaps between windings"}}},
       140,
       spiral_sheet},
      {{"helicoid_overlapping",
        "helicoid strip that rises and comes down through itself",
        {{"turns", 2.5, 1.5, 8, "number of turns"}}},
       110,
       helicoid_overlapping},
      {{"swallowtail",
        "swallowtail: two creases and a double curve that end in one singular point",
        {{"reach", 0.75, 0.3, 1.5, "half the width of the sheet"}}},
       52,
       swallowtail},
  };
}

}  // namespace unsnarl
