#include "applications/curves/curve_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// Larger coordinates are refused: lengths are squared and squares multiplied, which must not overflow (unit: length)
constexpr double largest_coordinate = 1e70;
/// A smaller bounding-box diagonal is refused: lengths are squared and squares multiplied, which must not vanish (unit:
/// length)
constexpr double least_diagonal = 1e-70;

Vec2 point(const Curve& curve, std::size_t k) {
  return {curve.points[2 * k], curve.points[2 * k + 1]};
}

void insert_point(Curve& curve, std::size_t segment, const Vec2& p) {
  const bool is_fixed = !curve.fixed.empty() && curve.fixed[segment] && curve.fixed[(segment + 1) % curve.size()];
  const auto at = static_cast<std::ptrdiff_t>(segment + 1);
  curve.points.insert(curve.points.begin() + 2 * at, {p.x(), p.y()});
  if (!curve.fixed.empty()) curve.fixed.insert(curve.fixed.begin() + at, is_fixed);
}

/// A point of a curve.
struct CurvePoint {
  std::size_t curve, point;
};

/// Adds a point to every segment that an end of an open curve lies on. Returns how many.
std::size_t insert_junctions(std::vector<Curve>& curves, double distance) {
  std::size_t inserted = 0;
  // An end is identified by its curve and side, since inserting points changes their numbers.
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].closed) continue;
    for (const bool last : {false, true}) {
      const Vec2 end = point(curves[c], last ? curves[c].size() - 1 : 0);
      for (std::size_t other = 0; other < curves.size(); ++other) {
        Curve& curve = curves[other];
        const double reach = distance + std::max(curve.tolerance, curves[c].tolerance);
        bool at_point = false;
        double nearest = reach;
        std::size_t segment = curve.size();
        const std::size_t n = curve.size(), segments = curve.closed ? n : n - 1;
        for (std::size_t k = 0; k < segments; ++k) {
          // The end's own segment and the one beside it do not count.
          if (other == c && (last ? k + 2 >= segments : k < 2)) continue;
          const Vec2 a = point(curve, k), b = point(curve, (k + 1) % n);
          const double t = nearest_fraction(end, a, b);
          const double d = (a + t * (b - a) - end).norm();
          if (d > nearest) continue;
          nearest = d;
          segment = k;
          at_point = (a - end).norm() <= reach || (b - end).norm() <= reach;
        }
        if (segment == curve.size() || at_point) continue;
        insert_point(curve, segment, end);
        ++inserted;
      }
    }
  }
  return inserted;
}

/// The point of curve `other` nearest to an end of curve c and within `reach`; none: the number of its points.
std::size_t point_at_end(const std::vector<Curve>& curves, std::size_t c, std::size_t end, std::size_t other,
                         double reach) {
  const std::size_t n = curves[other].size();
  if (other == c && n < 4) return n;
  double nearest = reach;
  std::size_t found = n;
  for (std::size_t k = 0; k < n; ++k) {
    // On the end's own curve only the other end counts: neighbouring points may be nearer than the tolerance.
    if (other == c && (k == end || (k != 0 && k + 1 != n && (end == 0 ? k < 3 : k + 4 > n)))) continue;
    const double d = (point(curves[other], k) - point(curves[c], end)).norm();
    if (d > nearest || (d == nearest && found != n)) continue;
    nearest = d;
    found = k;
  }
  return found;
}

/// Sets of points that are to be one: ends of open curves and the points that they lie on.
std::vector<std::vector<CurvePoint>> points_to_join(const std::vector<Curve>& curves, double distance) {
  std::vector<std::size_t> first(curves.size() + 1, 0);
  std::vector<CurvePoint> points;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t k = 0; k < curves[c].size(); ++k) points.push_back({c, k});
    first[c + 1] = points.size();
  }
  UnionFind sets(static_cast<Index>(points.size()));
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].closed) continue;
    for (const std::size_t end : {std::size_t{0}, curves[c].size() - 1})
      for (std::size_t other = 0; other < curves.size(); ++other) {
        const double reach = distance + std::max(curves[other].tolerance, curves[c].tolerance);
        const std::size_t found = point_at_end(curves, c, end, other, reach);
        if (found != curves[other].size())
          sets.unite(static_cast<Index>(first[c] + end), static_cast<Index>(first[other] + found));
      }
  }
  std::vector<std::vector<CurvePoint>> members(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) members[sets.find(static_cast<Index>(i))].push_back(points[i]);
  std::erase_if(members, [](const std::vector<CurvePoint>& group) { return group.size() < 2; });
  return members;
}

bool is_fixed(const Curve& curve, std::size_t k) {
  return !curve.fixed.empty() && curve.fixed[k];
}

/// Would these points at p leave a segment without length?
bool closes_a_segment(const std::vector<Curve>& curves, const std::vector<CurvePoint>& group, const Vec2& p) {
  return std::any_of(group.begin(), group.end(), [&](const CurvePoint& place) {
    const Curve& curve = curves[place.curve];
    const std::size_t n = curve.size();
    const auto is_at_p = [&](std::size_t k) {
      return point(curve, k) == p || std::any_of(group.begin(), group.end(), [&](const CurvePoint& other) {
               return other.curve == place.curve && other.point == k;
             });
    };
    return ((curve.closed || place.point > 0) && is_at_p((place.point + n - 1) % n)) ||
           ((curve.closed || place.point + 1 < n) && is_at_p((place.point + 1) % n));
  });
}

/// The segments of the chains, and what depends on them.
void add_segments(CurveNet& net) {
  net.segments.clear();
  net.chain_of.clear();
  net.weight.assign(net.vertex_count(), 0);
  for (std::size_t c = 0; c < net.chains.size(); ++c) {
    CurveNet::Chain& chain = net.chains[c];
    chain.first_segment = net.segment_count();
    for (Index k = 0; k < chain.segment_count(); ++k) {
      net.segments.push_back({chain.at(k), chain.at(k + 1)});
      net.chain_of.push_back(static_cast<Index>(c));
    }
  }
  for (const auto& [a, b] : net.segments) {
    const double half = 0.5 * (net.rest.col(b) - net.rest.col(a)).norm();
    net.weight[a] += half;
    net.weight[b] += half;
  }
}

}  // namespace

std::string name_of_curve(const Curve& curve, std::size_t number) {
  return curve.name.empty() ? fmt::format("curve {}", number) : curve.name;
}

double diagonal_of(std::span<const Curve> curves) {
  const double infinite = std::numeric_limits<double>::infinity();
  Vec2 low = Vec2::Constant(infinite), high = -low;
  for (const Curve& curve : curves)
    for (std::size_t k = 0; k < curve.size(); ++k) {
      low = low.cwiseMin(point(curve, k));
      high = high.cwiseMax(point(curve, k));
    }
  return low.x() <= high.x() ? (high - low).norm() : 0;
}

void check_curves(std::span<const Curve> curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Curve& curve = curves[c];
    const std::string name = name_of_curve(curve, c);
    const std::size_t n = curve.size(), least = curve.closed ? 3 : 2;
    if (curve.points.size() % 2 != 0)
      throw std::invalid_argument(
          fmt::format("{} has {} coordinates; give x and y of each point", name, curve.points.size()));
    if (n < least)
      throw std::invalid_argument(fmt::format("{} has {} points; {} curve needs at least {}", name, n,
                                              curve.closed ? "a closed" : "an open", least));
    if (!curve.fixed.empty() && curve.fixed.size() != n)
      throw std::invalid_argument(
          fmt::format("{} has {} points, but {} flags of fixed ones", name, n, curve.fixed.size()));
    for (std::size_t k = 0; k < n; ++k) {
      if (!point(curve, k).allFinite())
        throw std::invalid_argument(fmt::format("{}: a coordinate of point {} is not a finite number", name, k));
      if (point(curve, k).cwiseAbs().maxCoeff() > largest_coordinate)
        throw std::invalid_argument(
            fmt::format("{}: a coordinate of point {} is beyond {}; use another unit", name, k, largest_coordinate));
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      if ((next != 0 || curve.closed) && point(curve, k) == point(curve, next))
        throw std::invalid_argument(
            fmt::format("{}: points {} and {} are equal, so that the segment between them has no length; leave one "
                        "out{}",
                        name, k, next, next == 0 ? " (a closed curve does not repeat its first point)" : ""));
    }
  }
  if (!curves.empty() && diagonal_of(curves) < least_diagonal)
    throw std::invalid_argument(fmt::format("all curves lie within a length of {}; use another unit", least_diagonal));
}

std::vector<CurveJoint> join_ends(std::vector<Curve>& curves, double distance, std::size_t& inserted) {
  inserted += insert_junctions(curves, distance);
  std::vector<CurveJoint> joints;
  for (const std::vector<CurvePoint>& group : points_to_join(curves, distance)) {
    // A fixed point decides where the joint is.
    const auto held = std::find_if(group.begin(), group.end(),
                                   [&](const CurvePoint& at) { return is_fixed(curves[at.curve], at.point); });
    const CurvePoint& leader = held != group.end() ? *held : group.front();
    const Vec2 p = point(curves[leader.curve], leader.point);
    if (closes_a_segment(curves, group, p)) continue;
    CurveJoint joint;
    for (const auto& [c, k] : group) {
      curves[c].points[2 * k] = p.x();
      curves[c].points[2 * k + 1] = p.y();
      joint.push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(k)});
    }
    joints.push_back(std::move(joint));
  }
  return joints;
}

std::vector<CurveJoint> joints_at_one_position(std::span<const Curve> curves, std::span<const CurveJoint> joints) {
  std::vector<CurveJoint> result;
  for (const CurveJoint& joint : joints) {
    std::map<std::array<double, 2>, CurveJoint> by_position;
    for (const auto& [c, k] : joint) {
      const Vec2 p = point(curves[c], k);
      by_position[{p.x(), p.y()}].push_back({c, k});
    }
    for (auto& [position, points] : by_position)
      if (points.size() > 1) result.push_back(std::move(points));
  }
  return result;
}

CurveNet make_net(std::span<const Curve> curves, std::span<const CurveJoint> joints, bool fix_ends) {
  CurveNet net;
  net.diagonal = diagonal_of(curves);
  for (const Curve& curve : curves) {
    CurveNet::Chain chain;
    chain.closed = curve.closed;
    chain.vertices.assign(curve.size(), -1);
    net.chains.push_back(std::move(chain));
  }
  Index count = 0;
  for (const CurveJoint& joint : joints) {
    for (const auto& [c, k] : joint) net.chains[c].vertices[k] = count;
    ++count;
  }
  const Index joined = count;
  for (CurveNet::Chain& chain : net.chains)
    for (Index& v : chain.vertices)
      if (v < 0) v = count++;
  net.rest.resize(2, count);
  net.fixed.assign(count, 0);
  net.flags.assign(count, 0);
  net.room.assign(count, std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    CurveNet::Chain& chain = net.chains[c];
    for (Index k = 0; k < chain.size(); ++k) {
      const Index v = chain.vertices[k];
      net.rest.col(v) = point(curves[c], k);
      if (!curves[c].fixed.empty() && curves[c].fixed[k]) net.fixed[v] = net.flags[v] = 1;
      if (fix_ends && !chain.closed && (k == 0 || k + 1 == chain.size())) net.fixed[v] = 1;
    }
  }
  net.pinned = net.fixed;
  for (Index v = 0; v < joined; ++v) net.pinned[v] = 1;
  add_segments(net);
  return net;
}

ArcLengths::ArcLengths(const CurveNet& net, const Points2& x)
    : arc(net.vertex_count(), 0), chain_of(net.vertex_count(), -1) {
  for (const CurveNet::Chain& chain : net.chains) {
    double sum = 0;
    for (Index k = 0; k < chain.size(); ++k) {
      chain_of[chain.vertices[k]] = static_cast<Index>(length.size());
      arc[chain.vertices[k]] = sum;
      if (k < chain.segment_count()) sum += (x.col(chain.at(k + 1)) - x.col(chain.at(k))).norm();
    }
    length.push_back(sum);
    closed.push_back(chain.closed);
  }
}

double ArcLengths::between(Index v, Index w) const {
  const Index chain = chain_of[v];
  if (chain != chain_of[w]) return std::numeric_limits<double>::infinity();
  const double along = std::abs(arc[v] - arc[w]);
  return closed[chain] ? std::min(along, length[chain] - along) : along;
}

CurveNet with_chains(CurveNet net, std::vector<std::vector<Index>> chains) {
  for (std::size_t c = 0; c < chains.size(); ++c) net.chains[c].vertices = std::move(chains[c]);
  add_segments(net);
  return net;
}

std::vector<Curve> with_positions(std::span<const Curve> curves, const CurveNet& net, const Points2& x) {
  const bool any_fixed = std::any_of(net.flags.begin(), net.flags.end(), [](std::uint8_t flag) { return flag != 0; });
  std::vector<Curve> result;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    Curve curve{.points = {}, .closed = curves[c].closed, .fixed = {}, .name = curves[c].name};
    curve.tolerance = curves[c].tolerance;
    for (const Index v : net.chains[c].vertices) {
      curve.points.insert(curve.points.end(), {x(0, v), x(1, v)});
      if (any_fixed) curve.fixed.push_back(net.flags[v]);
    }
    result.push_back(std::move(curve));
  }
  return result;
}

std::vector<CurveJoint> joints_of(const CurveNet& net) {
  std::vector<CurveJoint> places(net.vertex_count());
  for (std::size_t c = 0; c < net.chains.size(); ++c)
    for (Index k = 0; k < net.chains[c].size(); ++k)
      places[net.chains[c].vertices[k]].push_back({static_cast<std::int32_t>(c), static_cast<std::int32_t>(k)});
  std::erase_if(places, [](const CurveJoint& joint) { return joint.size() < 2; });
  return places;
}

}  // namespace unsnarl
