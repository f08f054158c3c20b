#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "unsnarl/curves.h"
#include "unsnarl/repair.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct IsotopyOptions {
  /// Points of every curve between the first and the last ring; 0: as many as the longer of each pair, 200 at least.
  /// At least as many as either, [16, 100000].
  int points = 0;
  double time_limit_s = 0;  ///< wall-clock seconds; 0: none
};

/// The curves at one height. The first ring has the points of the start, the last those of the end, the rings between
/// equally many each (Isotopy::points).
struct IsotopyRing {
  double time = 0;                          ///< in [0, 1], ascending
  std::vector<std::vector<double>> curves;  ///< x and y in turns, one list a curve
};

/// Where a point of the rings between lies on the start and on the end.
struct IsotopyPlace {
  std::int32_t edge = 0;  ///< starts at the point of this number
  double fraction = 0;    ///< of it, [0, 1)
};

struct Isotopy {
  /// embedded, or cancelled or time_limit with nothing else in it.
  Status status = Status::no_progress;
  std::vector<IsotopyRing> rings;
  std::vector<int> points;  ///< one a curve: of the rings between
  /// One list a curve, one entry a point of the rings between.
  std::vector<std::vector<IsotopyPlace>> on_start, on_end;
  /// The annuli that the curves sweep, triangles: vertices ring by ring, in a ring curve by curve; z = time * `height`.
  /// A cut at any height is one closed polygon a curve, and as the surface is embedded all of them are simple and
  /// disjoint.
  Surface surface;
  double height = 0;  ///< the diagonal of the bounding box of start and end
  double seconds = 0;
};

/// An isotopy in the plane between two sets of closed curves that cross neither themselves nor each other (paper §4.5):
/// curve k of the start becomes curve k of the end. Both sides are made round by shortening them under bounds that keep
/// all apart, then joined; of the rings only those stay that the surface needs to be embedded, which is decided by
/// exact arithmetic. docs/isotopy.md explains how. The same input gives the same result on every run (time limits and
/// cancellation aside).
///
/// Throws std::invalid_argument, naming the curve: for open curves, another number of curves, curves that cross, curves
/// that run around the other way (no isotopy of the plane reverses them), curves within others, coordinates that are
/// not finite, options out of range.
Isotopy planar_isotopy(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options = {},
                       Context* context = nullptr);

/// The curves at a time in [0, 1]: cuts of the surface, points in order.
std::vector<Curve> isotopy_slice(const Isotopy& isotopy, double time);

/// An SVG file in which the curves move from start to end and back; frames: [2, 1000] keyframes at most.
std::string isotopy_animation_svg(const Isotopy& isotopy, int frames = 60);
/// The curves at a time as an SVG file, all of one size; coordinates have six digits, or all of them where curves would
/// cross as they are read back.
std::string isotopy_frame_svg(const Isotopy& isotopy, double time);

}  // namespace unsnarl
