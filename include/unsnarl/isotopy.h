#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/curves.h"
#include "unsnarl/repair.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct IsotopyOptions {
  /// Points of every curve in the rings in the middle, at least, [16, 100000]; 0: 200. There are more where curves have
  /// more.
  int points = 0;
  /// Numbers of a curve of the start and of the one of the end that it becomes. The others are paired so that curves
  /// lie in each other alike on both sides, and middles are near.
  std::vector<std::array<std::int32_t, 2>> pairs;
  double time_limit_s = 0;  ///< wall-clock seconds; 0: none
};

/// The curves at one height. The first ring has the points of the start, the last those of the end.
struct IsotopyRing {
  double time = 0;                          ///< in [0, 1], ascending
  std::vector<std::vector<double>> curves;  ///< x and y in turns, one list a curve
};

/// An edge of the surface from a ring to the next one: a point of each.
struct IsotopyRung {
  std::int32_t lower = 0, upper = 0;
};

/// The place on the start or on the end of a point of the rings in the middle.
struct IsotopyPlace {
  std::int32_t edge = 0;  ///< starts at the point of this number
  double fraction = 0;    ///< of it, [0, 1)
};

/// The construction that made an isotopy.
enum class IsotopyMethod : std::uint8_t {
  annulus,            ///< an annulus between the curves that is embedded as it was laid
  untangled_annulus,  ///< one that was untangled with every ring's height held (paper §4.5)
  shortening,         ///< corners of both were removed until an annulus between what was left was embedded
};
std::string_view to_string(IsotopyMethod method);

struct Isotopy {
  /// embedded, or cancelled or time_limit with nothing else in it.
  Status status = Status::no_progress;
  IsotopyMethod method = IsotopyMethod::annulus;
  double shortened = 0;  ///< part of the way to triangles that was gone, by length, [0, 1]; 0: none
  /// How far the shapes depart in between: the least ratio of a curve's length, and of its area, to what is evenly
  /// between those of the start and of the end.
  double length_kept = 1, area_kept = 1;
  /// The curve of the end that each of the start becomes. Rings have the curves in the order of the start.
  std::vector<std::int32_t> partner;
  std::vector<IsotopyRing> rings;
  /// One entry a ring but the last, in it one list a curve: the edges from this ring to the next, around the curve.
  /// From one to the next one point goes on by one, or both do; then all four lie in a plane but for rounding, and a
  /// cut has no point between.
  std::vector<std::vector<std::vector<IsotopyRung>>> rungs;
  /// One a curve: of the rings in the middle, which are those of the annulus. All rings but the first and the last are
  /// in the middle, unless curves were shortened: below are then rings of fewer and fewer points of the start, above
  /// rings of more and more points of the end.
  std::vector<int> points;
  /// One list a curve, one entry a point of the rings in the middle.
  std::vector<std::vector<IsotopyPlace>> on_start, on_end;
  /// The annuli that the curves sweep, triangles: vertices ring by ring, in a ring curve by curve; z = time * `height`.
  /// A cut at any height is one closed polygon a curve, and as the surface is embedded all of them are simple and
  /// disjoint.
  Surface surface;
  double height = 0;  ///< the diagonal of the bounding box of start and end
  double seconds = 0;
};

/// An isotopy in the plane between two sets of closed curves that cross neither themselves nor each other (paper §4.5):
/// annuli between the curves in space, z being time, which are untangled while every ring keeps its height. Where that
/// leaves intersections, both sides are first made simpler by removing corners, no farther than needed. That the
/// surface is embedded is decided by exact arithmetic. docs/isotopy.md explains how. The same input gives the same
/// result on every run (time limits and cancellation aside).
///
/// Throws std::invalid_argument, naming the curve: for open curves, another number of curves, curves that cross, curves
/// that run around the other way (no isotopy of the plane reverses them), curves that lie in each other otherwise at
/// the end than at the start (none can enter or leave another), coordinates that are not finite, options out of range.
Isotopy planar_isotopy(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options = {},
                       Context* context = nullptr);

/// The curve of the end that each of the start becomes (IsotopyOptions::pairs). Throws as planar_isotopy does, but for
/// curves that run around the other way.
std::vector<std::int32_t> isotopy_partners(std::span<const Curve> start, std::span<const Curve> end,
                                           std::span<const std::array<std::int32_t, 2>> pairs = {});

/// The curves at a time in [0, 1]: cuts of the surface, points in order.
std::vector<Curve> isotopy_slice(const Isotopy& isotopy, double time);

/// An SVG file that shows the curves on the way from start to end and back. frames: [2, 1000] drawings each way, evenly
/// in time.
std::string isotopy_animation_svg(const Isotopy& isotopy, int frames = 60);
/// The curves at a time as an SVG file, all of one size; coordinates have six digits, or all of them where curves would
/// cross as they are read back.
std::string isotopy_frame_svg(const Isotopy& isotopy, double time);

}  // namespace unsnarl
