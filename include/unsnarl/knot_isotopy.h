#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/link.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// How to look for an isotopy.
enum class KnotMethod {
  automatic,  ///< the straight way from one to the other; relax; direct: the first that is an isotopy
  direct,     ///< untangle the cylinder of straight ways between both knots, a surface in R^4 (paper §4.5)
  relax,      ///< let both knots repel themselves until they come to rest, and join these shapes
};

struct KnotIsotopyOptions {
  /// Points of the knot on the way. 0: as many as the knot of the two that has more, 200 at least. At least as many as
  /// either has, [16, 2000].
  int points = 0;
  KnotMethod method = KnotMethod::automatic;
  double time_limit_s = 0;  ///< wall-clock seconds; 0: none
};

/// The knot at one time.
struct KnotRing {
  double time = 0;             ///< in [0, 1], ascending
  std::vector<double> points;  ///< 3 n doubles, x y z of point 0, then of point 1, ...
};

/// A point at which two triangles of a cylinder in R^4 cross: at that time the knot passes through itself.
struct KnotDoublePoint {
  double time = 0;
  std::array<double, 3> place{};
  /// +1 or -1, as the cylinder's orientation and that of R^4 say; 0: the triangles overlap, which one of any two knots
  /// in general position does not.
  int sign = 0;
};

struct KnotIsotopy {
  /// embedded: what is below is an isotopy. no_progress: none was found; `found` says where it stopped. cancelled,
  /// time_limit: stopped. In all but the first case there are no rings.
  Status status = Status::no_progress;
  /// The first ring has the points of the start, the last those of the end, both in their order but for `reversed`; all
  /// between have equally many. The knot moves from ring to ring, point k to point k.
  std::vector<KnotRing> rings;
  /// Edge k of the first ring becomes start_pieces[k] edges of the second one, of which those of edge 0 are the first;
  /// end_pieces: the same of the last ring and the one before it, whose point `end_first` is where edge 0 begins.
  std::vector<int> start_pieces, end_pieces;
  int end_first = 0;
  /// The end is run along backwards: its point 0, then its last one, ... Some knots, from 8_17 on, cannot be turned
  /// around.
  bool reversed = false;
  /// Those of the cylinder of straight ways between both knots.
  std::vector<KnotDoublePoint> straight_double_points;
  /// Those of the cylinder that `direct` ended with; empty where it was not tried.
  std::vector<KnotDoublePoint> left_double_points;
  bool relaxed = false;     ///< by way of the shapes at rest
  double start_energy = 0;  ///< of the knots at rest, see docs/knot_isotopy.md; 0: none
  double end_energy = 0;
  std::string found;  ///< one sentence for people: how it was found, or where it stopped
  double seconds = 0;
};

/// An isotopy between two polygons of one knot (paper §4.5 and §6, which leaves it open): an annulus in R^4 from one to
/// the other, whose fourth coordinate is time, that does not intersect itself. docs/knot_isotopy.md explains how. It is
/// found or not found; that none is found does not prove that there is none. Of polygons of different knots none is
/// ever found, as each one is proven by exact arithmetic. The same input gives the same result on every run (time
/// limits and cancellation aside).
///
/// Throws std::invalid_argument as check_link does, for links of several components, for knots with strands so near
/// each other that rounding cannot tell them apart, and for options out of range.
KnotIsotopy knot_isotopy(const Link& start, const Link& end, const KnotIsotopyOptions& options = {},
                         Context* context = nullptr);

/// A knot at rest.
struct RelaxedWire {
  Status status = Status::embedded;  ///< cancelled or time_limit where it was stopped; it is the same knot then too
  Link link;
  bool at_rest = false;  ///< false: stopped, or no further step could be proven
  double energy = 0;     ///< see docs/knot_isotopy.md
  double seconds = 0;
};
/// Lets a knot repel itself until it comes to rest; every step is proven to be an isotopy, as those of knot_isotopy().
/// Its length stays. It gets at least 200 points. time_limit_s: wall-clock seconds, >= 0; 0: none. At most 2,000
/// points. Throws std::invalid_argument as knot_isotopy() does.
RelaxedWire relaxed_wire(const Link& knot, double time_limit_s = 0, Context* context = nullptr);

/// The properties of an isotopy that are certified.
struct KnotIsotopyFindings {
  bool ends_kept = false;  ///< the first ring is the start, the last one the end, bit for bit
  /// Pairs of triangles of the cylinder in R^4 that meet, by exact arithmetic: 0: every cut is a simple polygon.
  std::size_t meeting_triangles = 0;
  /// Pairs of rings between which the points, each moving straight, are not proven to carry a simple polygon. Found out
  /// from edges that move in space, without the cylinder.
  std::size_t unproven_motions = 0;

  bool hold() const { return ends_kept && meeting_triangles == 0 && unproven_motions == 0; }
};
/// Throws std::invalid_argument for what is no list of rings as KnotIsotopy describes it.
KnotIsotopyFindings check_knot_isotopy(const KnotIsotopy& isotopy, const Link& start, const Link& end);

/// The knot at a time in [0, 1]: a cut of the cylinder, its points in order.
Link knot_isotopy_slice(const KnotIsotopy& isotopy, double time);

/// As JSON with all digits, with what was found; and back. parse_knot_isotopy throws FileError, naming the place.
std::string knot_isotopy_json(const KnotIsotopy& isotopy, const KnotIsotopyFindings& findings);
KnotIsotopy parse_knot_isotopy(std::string_view text);

/// An animated GIF in which a tube around the knot moves from start to end; frames: [2, 1000].
std::string knot_isotopy_gif(const KnotIsotopy& isotopy, int frames = 60);
/// Tubes around the knot at `count` times, evenly, side by side, as a PNG file; count: [2, 12].
std::string knot_isotopy_png(const KnotIsotopy& isotopy, int count = 5);

}  // namespace unsnarl
