#pragma once

#include <vector>

#include "applications/curves/segment_tree.h"

namespace unsnarl {

/// How two segments meet, decided exactly.
enum class SegmentMeeting {
  none,     ///< not at all, or in the vertex that they share
  proper,   ///< inner points of both, one on each side of the other
  touching  ///< in any other way: an end on the other segment, along a line
};
SegmentMeeting meeting_of(const Points2& x, const Edge& a, const Edge& b);

/// Pairs of segments that meet, i < j, sorted.
struct SegmentPair {
  Index i = 0, j = 0;
  SegmentMeeting kind = SegmentMeeting::none;
  friend bool operator<(const SegmentPair& a, const SegmentPair& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; }
};
/// The tree has to be fitted to x.
std::vector<SegmentPair> find_meetings(const CurveNet& net, const SegmentTree& tree, const Points2& x);
std::vector<SegmentPair> find_meetings(const CurveNet& net, const Points2& x);

/// One flag a vertex: it, or a segment that it is an end of, is closer than `distance` to a segment or vertex that it
/// has nothing to do with. The tree has to be fitted to x.
std::vector<std::uint8_t> vertices_closer_than(const CurveNet& net, const SegmentTree& tree, const Points2& x,
                                               double distance);

/// The fraction of segment a at which the line through b meets it; for a proper crossing.
double crossing_fraction(const Points2& x, const Edge& a, const Edge& b);

std::vector<CurveCrossing> as_crossings(const CurveNet& net, const std::vector<SegmentPair>& pairs);

}  // namespace unsnarl
