#include "applications/seifert/rim_short_cuts.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// Distance that a cut keeps from a crossing: the band and the windings beside it are nearer (unit: room around the
/// crossing in the picture)
constexpr double bypass_of_room = 0.5;

struct PictureSegment {
  Vec2 a, b;

  Vec2 lo() const { return a.cwiseMin(b); }
  Vec2 hi() const { return a.cwiseMax(b); }
  double distance(const Vec2& p) const {
    const Vec2 d = b - a;
    const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (p - a - t * d).norm();
  }
};

bool meet(const PictureSegment& s, const PictureSegment& t) {
  if ((s.lo().array() > t.hi().array()).any() || (t.lo().array() > s.hi().array()).any()) return false;
  const auto side = [](const PictureSegment& of, const Vec2& p) {
    return orient2d(of.a.x(), of.a.y(), of.b.x(), of.b.y(), p.x(), p.y());
  };
  return side(s, t.a) * side(s, t.b) <= 0 && side(t, s.a) * side(t, s.b) <= 0;
}

class CutFinder {
 public:
  CutFinder(const LinkDiagram& diagram, const std::vector<std::vector<double>>& depths, double longest, double room)
      : diagram_(diagram), depths_(depths), longest_(longest), room_(room) {}

  std::vector<std::vector<ShortCut>> all() {
    std::vector<std::vector<ShortCut>> cuts;
    for (component_ = 0; component_ < static_cast<Index>(diagram_.points.size()); ++component_)
      cuts.push_back(of_component());
    return cuts;
  }

 private:
  std::vector<ShortCut> of_component() {
    const auto n = static_cast<Index>(diagram_.points[component_].cols());
    std::vector<bool> crosses(n, false);
    for (const LinkDiagram::Pass& pass : diagram_.passes[component_]) {
      const LinkDiagram::Crossing& c = diagram_.crossings[pass.crossing];
      crosses[(pass.over ? c.over : c.under).edge] = true;
    }
    std::vector<ShortCut> cuts(n);
    for (Index k = 0; k < n; k += cuts[k].edges) {
      if (crosses[k]) continue;
      // Three points at least are left.
      for (Index edges = 2; edges <= n / 3 && k + edges <= n && !crosses[k + edges - 1]; ++edges) {
        const std::optional<ShortCut> longer = cut(k, edges);
        if (!longer) break;
        cuts[k] = *longer;
      }
      if (cuts[k].edges > 1) taken_.push_back(segment(k, cuts[k].edges));
    }
    return cuts;
  }

  Vec3 point(Index k) const {
    const Positions& p = diagram_.points[component_];
    return p.col(k % p.cols());
  }
  Vec3 rim(Index k) const {
    const std::vector<double>& depths = depths_[component_];
    return point(k) - depths[k % static_cast<Index>(depths.size())] * Vec3::UnitZ();
  }
  PictureSegment segment(Index k, Index edges) const { return {point(k).head<2>(), point(k + edges).head<2>()}; }

  std::optional<ShortCut> cut(Index k, Index edges) const {
    const PictureSegment s = segment(k, edges);
    const double length = (s.b - s.a).norm();
    if (!(length > 0 && length <= longest_)) return {};
    const Vec2 along = (s.b - s.a) / length;
    ShortCut found{edges, 0};
    double before = 0;
    for (Index i = 1; i <= edges; ++i) {
      const double at = along.dot(point(k + i).head<2>() - s.a);
      if (!(at > before)) return {};
      if (at <= 0.5 * length) found.middle = i;
      before = at;
    }
    const Index last = k + edges;
    if (!goes_lower(k, last, 1, found.middle, along) || !goes_lower(last, k, -1, edges - found.middle, -along))
      return {};
    return is_free(s, k, edges) ? std::optional(found) : std::nullopt;
  }

  /// Whether from the rim below `first` the vertices after it, and then the other end of the cut, are seen
  /// lower and lower.
  bool goes_lower(Index first, Index last, int step, Index count, const Vec2& along) const {
    const Vec3 tip = rim(first);
    const auto slope = [&](const Vec3& p) { return (p.z() - tip.z()) / along.dot((p - tip).head<2>()); };
    double before = std::numeric_limits<double>::infinity();
    for (Index i = 1; i <= count; ++i) {
      const double next = slope(point(first + step * i));
      if (!(next < before)) return false;
      before = next;
    }
    return slope(rim(last)) < before;
  }

  bool is_free(const PictureSegment& s, Index k, Index edges) const {
    for (const LinkDiagram::Crossing& c : diagram_.crossings)
      if (s.distance(c.place) < bypass_of_room * c.radius) return false;
    for (std::size_t c = 0; c < diagram_.points.size(); ++c) {
      const Positions& p = diagram_.points[c];
      const auto n = static_cast<Index>(p.cols());
      const bool own = static_cast<Index>(c) == component_;
      for (Index j = 0; j < n; ++j) {
        const Vec2 a = p.col(j).head<2>();
        const bool is_end = own && (j == k || j == (k + edges) % n), is_between = own && j >= k && j < k + edges;
        if (!is_end && !is_between && s.distance(a) < room_) return false;
        const bool touches = own && (j + 1 == k || j + 1 == k + n || j == (k + edges) % n);
        if (!is_between && !touches && meet(s, {a, p.col((j + 1) % n).head<2>()})) return false;
      }
    }
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const PictureSegment& t) { return t.b != s.a && t.a != s.b && meet(s, t); });
  }

  const LinkDiagram& diagram_;
  const std::vector<std::vector<double>>& depths_;
  const double longest_, room_;
  Index component_ = 0;
  std::vector<PictureSegment> taken_;
};

}  // namespace

std::vector<std::vector<ShortCut>> rim_short_cuts(const LinkDiagram& diagram,
                                                  const std::vector<std::vector<double>>& depths, double longest,
                                                  double room) {
  return CutFinder(diagram, depths, longest, room).all();
}

}  // namespace unsnarl
