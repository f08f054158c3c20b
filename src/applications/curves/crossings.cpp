#include "applications/curves/crossings.h"

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

Sign side(const Points2& x, Index a, Index b, Index p) {
  return orient2d(x(0, a), x(1, a), x(0, b), x(1, b), x(0, p), x(1, p));
}

bool before(const Points2& x, Index a, Index b) {
  return x(0, a) != x(0, b) ? x(0, a) < x(0, b) : x(1, a) < x(1, b);
}

/// p is on the line through a and b: is it between them, or one of them?
bool is_between(const Points2& x, Index a, Index b, Index p) {
  return !(before(x, p, a) && before(x, p, b)) && !(before(x, a, p) && before(x, b, p));
}

bool boxes_overlap(const Points2& x, const Edge& a, const Edge& b) {
  for (int k = 0; k < 2; ++k) {
    if (std::max(x(k, a[0]), x(k, a[1])) < std::min(x(k, b[0]), x(k, b[1]))) return false;
    if (std::max(x(k, b[0]), x(k, b[1])) < std::min(x(k, a[0]), x(k, a[1]))) return false;
  }
  return true;
}

}  // namespace

SegmentMeeting meeting_of(const Points2& x, const Edge& a, const Edge& b) {
  if (!boxes_overlap(x, a, b)) return SegmentMeeting::none;
  const bool first = a[0] == b[0] || a[0] == b[1], second = a[1] == b[0] || a[1] == b[1];
  if (first && second) return SegmentMeeting::touching;
  if (first || second) {
    const Index shared = first ? a[0] : a[1], p = first ? a[1] : a[0], q = b[0] == shared ? b[1] : b[0];
    if (side(x, shared, p, q) != 0) return SegmentMeeting::none;
    // On one line: they meet in more than the shared vertex where both lead the same way, or one has no length.
    const bool has_length = x.col(p) != x.col(shared) && x.col(q) != x.col(shared);
    return has_length && before(x, shared, p) != before(x, shared, q) ? SegmentMeeting::none : SegmentMeeting::touching;
  }
  const Sign s0 = side(x, a[0], a[1], b[0]), s1 = side(x, a[0], a[1], b[1]);
  if (s0 * s1 > 0) return SegmentMeeting::none;
  const Sign t0 = side(x, b[0], b[1], a[0]), t1 = side(x, b[0], b[1], a[1]);
  if (t0 * t1 > 0) return SegmentMeeting::none;
  if (s0 * s1 < 0 && t0 * t1 < 0) return SegmentMeeting::proper;
  const bool touch = (s0 == 0 && is_between(x, a[0], a[1], b[0])) || (s1 == 0 && is_between(x, a[0], a[1], b[1])) ||
                     (t0 == 0 && is_between(x, b[0], b[1], a[0])) || (t1 == 0 && is_between(x, b[0], b[1], a[1]));
  return touch ? SegmentMeeting::touching : SegmentMeeting::none;
}

std::vector<SegmentPair> find_meetings(const CurveNet& net, const SegmentTree& tree, const Points2& x) {
  std::vector<SegmentPair> result;
  tree.pairs_within(0, [&](Index i, Index j) {
    const SegmentMeeting kind = meeting_of(x, net.segments[i], net.segments[j]);
    if (kind != SegmentMeeting::none) result.push_back({i, j, kind});
  });
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<SegmentPair> find_meetings(const CurveNet& net, const Points2& x) {
  SegmentTree tree(net);
  tree.refit(x);
  return find_meetings(net, tree, x);
}

std::vector<std::uint8_t> vertices_closer_than(const CurveNet& net, const SegmentTree& tree, const Points2& x,
                                               double distance) {
  std::vector<std::uint8_t> result(net.vertex_count(), 0);
  const auto look = [&](Index v, const Edge& segment) {
    const auto [a, b] = segment;
    if (v == a || v == b) return;
    const Vec2 p = x.col(v), q = x.col(a), d = x.col(b) - q;
    const double t = nearest_fraction(p, q, x.col(b));
    if ((q + t * d - p).norm() < distance) result[v] = result[a] = result[b] = 1;
  };
  tree.pairs_within(distance, [&](Index i, Index j) {
    for (const Index v : net.segments[i]) look(v, net.segments[j]);
    for (const Index v : net.segments[j]) look(v, net.segments[i]);
  });
  return result;
}

double crossing_fraction(const Points2& x, const Edge& a, const Edge& b) {
  const Vec2 p = x.col(a[0]), d = x.col(a[1]) - p, q = x.col(b[0]), e = x.col(b[1]) - q;
  const double det = d.x() * e.y() - d.y() * e.x();
  if (det == 0) return 0.5;
  return std::clamp(((q - p).x() * e.y() - (q - p).y() * e.x()) / det, 0.0, 1.0);
}

std::vector<CurveCrossing> as_crossings(const CurveNet& net, const std::vector<SegmentPair>& pairs) {
  std::vector<CurveCrossing> result;
  result.reserve(pairs.size());
  for (const SegmentPair& pair : pairs)
    result.push_back({net.chain_of[pair.i], net.slot_of(pair.i), net.chain_of[pair.j], net.slot_of(pair.j)});
  return result;
}

}  // namespace unsnarl
