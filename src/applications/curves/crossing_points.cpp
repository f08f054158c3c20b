#include "applications/curves/crossing_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unsnarl {
namespace {

/// From a vertex to a crossing, a longer way than this gets a point beside the crossing; between two crossings, one
/// that is longer by one distance gets two points, and a shorter one gets its middle (unit: distance beside a crossing)
constexpr double room_for_a_point = 1.5;
/// Crossings that are closer than this get no point between them (unit: bounding-box diagonal)
constexpr double least_room_rel = 1e-9;

/// A crossing on a segment.
struct Passage {
  Index segment = 0;
  double fraction = 0;
  Index crossing = 0;
  int strand = 0;
};

/// A point that a segment gets.
struct PointBeside {
  double fraction = 0;  ///< of the segment
  double distance = 0;  ///< from the nearest crossing of the segment
};

/// Points that a segment of this length gets, given those of its crossings, ascending.
std::vector<PointBeside> points_beside(std::span<const Passage> passages, double length, double beside, double least) {
  std::vector<PointBeside> points;
  const double step = beside / length;
  double last = 0;
  for (std::size_t k = 0; k <= passages.size(); ++k) {
    const bool is_first = k == 0, is_last = k == passages.size();
    const double t = is_last ? 1 : passages[k].fraction, room = (t - last) * length;
    if (is_first || is_last) {
      if (room > room_for_a_point * beside) points.push_back({is_first ? t - step : last + step, beside});
    } else if (room > (1 + room_for_a_point) * beside) {
      points.push_back({last + step, beside});
      points.push_back({t - step, beside});
    } else if (room > least) {
      points.push_back({0.5 * (last + t), 0.5 * room});
    }
    last = t;
  }
  return points;
}

bool is_held(const CurveNet& net, Index segment) {
  return net.fixed[net.segments[segment][0]] && net.fixed[net.segments[segment][1]];
}

}  // namespace

CrossedCurves with_crossing_points(const CurveNet& net, const Points2& x, const std::vector<SegmentPair>& pairs,
                                   double beside) {
  CrossedCurves result;
  std::vector<Passage> passages;
  for (const SegmentPair& pair : pairs) {
    if (pair.kind != SegmentMeeting::proper || is_held(net, pair.i) || is_held(net, pair.j)) continue;
    const Edge &a = net.segments[pair.i], &b = net.segments[pair.j];
    const double t = crossing_fraction(x, a, b), u = crossing_fraction(x, b, a);
    const auto number = static_cast<Index>(result.crossings.size());
    passages.push_back({pair.i, t, number, 0});
    passages.push_back({pair.j, u, number, 1});
    const Vec2 d = x.col(a[1]) - x.col(a[0]), e = x.col(b[1]) - x.col(b[0]);
    result.crossings.push_back({x.col(a[0]) + t * d, {d.stableNormalized(), e.stableNormalized()}});
  }
  std::stable_sort(passages.begin(), passages.end(), [](const Passage& a, const Passage& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.fraction < b.fraction;
  });
  std::vector<Vec2> rest, places;
  std::vector<double> room;
  std::vector<std::vector<Index>> chains;
  auto next = passages.begin();
  for (const CurveNet::Chain& chain : net.chains) {
    Way way;
    std::vector<Index> vertices;
    const auto add_vertex = [&](Index v) {
      way.push_back({.vertex = v});
      vertices.push_back(v);
    };
    for (Index k = 0; k < chain.size(); ++k) {
      add_vertex(chain.vertices[k]);
      if (k == chain.segment_count()) break;
      const Index s = chain.first_segment + k;
      const auto begin = next;
      while (next != passages.end() && next->segment == s) ++next;
      if (next == begin) continue;
      const auto [a, b] = net.segments[s];
      const Vec2 from = x.col(a), d = x.col(b) - from, rest_from = net.rest.col(a), e = net.rest.col(b) - rest_from;
      const std::vector<PointBeside> points = points_beside({&*begin, static_cast<std::size_t>(next - begin)}, d.norm(),
                                                            beside, least_room_rel * net.diagonal);
      auto passage = begin;
      const auto pass_until = [&](double t) {
        for (; passage != next && passage->fraction < t; ++passage)
          way.push_back({.crossing = passage->crossing, .strand = passage->strand});
      };
      for (const auto& [t, distance] : points) {
        pass_until(t);
        places.push_back(from + t * d);
        rest.push_back(rest_from + t * e);
        if (distance < beside) {
          room.push_back(distance);
        } else {
          room.push_back(std::numeric_limits<double>::infinity());
        }
        add_vertex(net.vertex_count() + static_cast<Index>(rest.size()) - 1);
      }
      pass_until(2);
    }
    result.ways.push_back(std::move(way));
    chains.push_back(std::move(vertices));
  }
  const Index old = net.vertex_count(), added = static_cast<Index>(rest.size());
  result.net = net;
  result.x = x;
  result.net.rest.conservativeResize(2, old + added);
  result.x.conservativeResize(2, old + added);
  for (Index k = 0; k < added; ++k) {
    result.net.rest.col(old + k) = rest[k];
    result.x.col(old + k) = places[k];
  }
  for (auto* const flags : {&result.net.fixed, &result.net.flags, &result.net.pinned}) flags->resize(old + added, 0);
  result.net.room.insert(result.net.room.end(), room.begin(), room.end());
  result.net = with_chains(std::move(result.net), std::move(chains));
  return result;
}

}  // namespace unsnarl
