#pragma once

#include "applications/curves/crossings.h"

namespace unsnarl {

struct TouchingOptions {
  /// A curve that lies on another one is drawn in by this, a quarter of the default gap (unit: bounding-box diagonal)
  double inset_rel = 1e-3;
  /// A curve is drawn in by no more than this (unit: the shorter segment beside the point)
  double inset_part = 0.25;
  /// Tries of moving touching segments apart, each ten times as far as the one before (unit: tries)
  int tries = 5;
  double jitter = 1e-7;  ///< Motion of the first try (unit: length of the segment)
  /// Shorter segments count as this long in these tries (unit: bounding-box diagonal)
  double least_jitter_rel = 1e-6;
};

/// A pseudo-random direction and length, both coordinates in [-1, 1): a function of the arguments.
Vec2 jitter_of(std::uint64_t vertex, std::uint64_t round);

/// Curves that lie on each other (copies, borders of a map): the later one is drawn in a little where they touch. The
/// tree has to be fitted to x, and is again.
void draw_in_what_lies_on_others(const CurveNet& net, SegmentTree& tree, Points2& x, const TouchingOptions& options);

/// Moves segments that only touch a little, so that they cross or do not: touching ones cannot be switched. Pinned
/// vertices stay. `round` counts the tries of all calls. The tree has to be fitted to x, and is again. Returns what
/// meets afterwards.
std::vector<SegmentPair> move_apart_what_touches(const CurveNet& net, SegmentTree& tree, Points2& x,
                                                 std::uint64_t& round, const TouchingOptions& options);

}  // namespace unsnarl
