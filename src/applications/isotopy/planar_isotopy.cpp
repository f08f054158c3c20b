#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <stdexcept>

#include "applications/isotopy/rings.h"
#include "applications/isotopy/round_curves.h"
#include "geometry/portable_math.h"
#include "geometry/sort_unique.h"
#include "run/run_control.h"
#include "unsnarl/isotopy.h"

namespace unsnarl {
namespace {

/// Points of a curve unless the caller says otherwise, at least: fewer make coarse spirals of what turns (unit: points)
constexpr int least_points = 200;
constexpr double turn = 2 * std::numbers::pi;  ///< A full turn in radians (fixed by geometry)
/// Discs that change places have at most this radius: a third for each, a third between (unit: their smallest distance
/// on the way)
constexpr double disc_of_distance = 1.0 / 3;
/// Ways around that are tried for discs that would meet (unit: ways)
constexpr int most_detours = 1000;
/// A way around is looked for where discs come closer on the way (unit: bounding-box diagonal)
constexpr double least_way_rel = 1e-3;
constexpr double start_fraction = 0.3;  ///< Share of the progress when the start is round (no unit)
constexpr double end_fraction = 0.6;    ///< Share of the progress when the end is round too (no unit)
/// The motion of all slabs together counts as this much at least (unit: bounding-box diagonal)
constexpr double least_effort_rel = 1e-6;
/// The time of a slab grows by this at least (unit: mean of all slabs)
constexpr double least_time = 0.2;

Vec2 point(const Curve& curve, std::size_t k) {
  return {curve.points[2 * k], curve.points[2 * k + 1]};
}

double signed_area(const Curve& curve) {
  double area = 0;
  const Vec2 origin = point(curve, 0);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec2 a = point(curve, k) - origin, b = point(curve, (k + 1) % curve.size()) - origin;
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

bool contains(const Curve& curve, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec2 a = point(curve, k), b = point(curve, (k + 1) % curve.size());
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

void check_side(std::span<const Curve> curves, const char* side) {
  check_curves(curves);
  for (std::size_t c = 0; c < curves.size(); ++c)
    if (!curves[c].closed)
      throw std::invalid_argument(fmt::format("the {}: {} is open; an isotopy is made between closed curves", side,
                                              name_of_curve(curves[c], c)));
  const std::vector<CurveCrossing> crossings = find_crossings(curves);
  if (!crossings.empty()) {
    const CurveCrossing& at = crossings.front();
    throw std::invalid_argument(
        fmt::format("the {}: segment {} of {} and segment {} of {} cross; untangle the curves first ('unsnarl curves')",
                    side, at.segment_a, name_of_curve(curves[at.curve_a], at.curve_a), at.segment_b,
                    name_of_curve(curves[at.curve_b], at.curve_b)));
  }
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t d = 0; d < curves.size(); ++d)
      if (c != d && contains(curves[d], point(curves[c], 0)))
        throw std::invalid_argument(fmt::format("the {}: {} lies within {}; curves within others are not supported",
                                                side, name_of_curve(curves[c], c), name_of_curve(curves[d], d)));
}

void check(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options) {
  if (start.empty()) throw std::invalid_argument("the start has no curves");
  if (start.size() != end.size())
    throw std::invalid_argument(
        fmt::format("the start has {} curves, the end {}; curve k becomes curve k, so give equally many", start.size(),
                    end.size()));
  check_side(start, "start");
  check_side(end, "end");
  for (std::size_t c = 0; c < start.size(); ++c)
    if (signed_area(start[c]) * signed_area(end[c]) < 0)
      throw std::invalid_argument(fmt::format(
          "{} of the end runs around the other way than that of the start, which no isotopy in the plane brings about; "
          "give its points in the other order (--reverse)",
          name_of_curve(end[c], c)));
  if (options.points != 0 && (options.points < 16 || options.points > 100000))
    throw std::invalid_argument(fmt::format("points is {}; give 16 to 100000, or 0", options.points));
  for (const auto& side : {start, end})
    for (std::size_t c = 0; c < side.size(); ++c)
      if (options.points != 0 && static_cast<std::size_t>(options.points) < side[c].size())
        throw std::invalid_argument(fmt::format("{} has {} points, more than the {} of the rings between",
                                                name_of_curve(side[c], c), side[c].size(), options.points));
  if (!(options.time_limit_s >= 0)) throw std::invalid_argument("time_limit_s is below 0");
}

/// The curve with points inserted until it has this many: always into the longest piece.
std::vector<IsotopyPlace> places_on(const Curve& curve, int points) {
  const std::size_t n = curve.size();
  std::vector<double> length(n);
  std::vector<int> pieces(n, 1);
  std::priority_queue<std::pair<double, std::int64_t>> longest;
  for (std::size_t k = 0; k < n; ++k) {
    length[k] = (point(curve, (k + 1) % n) - point(curve, k)).norm();
    longest.emplace(length[k], -static_cast<std::int64_t>(k));
  }
  for (std::size_t count = n; count < static_cast<std::size_t>(points); ++count) {
    const auto k = static_cast<std::size_t>(-longest.top().second);
    longest.pop();
    ++pieces[k];
    longest.emplace(length[k] / pieces[k], -static_cast<std::int64_t>(k));
  }
  std::vector<IsotopyPlace> places;
  for (std::size_t k = 0; k < n; ++k)
    for (int i = 0; i < pieces[k]; ++i)
      places.push_back({static_cast<std::int32_t>(k), static_cast<double>(i) / pieces[k]});
  return places;
}

Curve with_places(const Curve& curve, const std::vector<IsotopyPlace>& places) {
  Curve result;
  result.closed = true;
  for (const IsotopyPlace& place : places) {
    const Vec2 a = point(curve, place.edge), b = point(curve, (place.edge + 1) % curve.size());
    const Vec2 p = place.fraction == 0 ? a : Vec2((1 - place.fraction) * a + place.fraction * b);
    result.points.insert(result.points.end(), {p.x(), p.y()});
  }
  return result;
}

/// A regular polygon; point k is at the angle phase + k / n turns, to the side of the curve that it stands for.
struct Disc {
  Vec2 middle;
  double radius = 0, phase = 0;

  Points2 polygon(Index n, double side) const {
    Points2 p(2, n);
    for (Index k = 0; k < n; ++k) {
      const double angle = phase + side * turn * k / n;
      p.col(k) = middle + radius * Vec2(portable::cos(angle), portable::sin(angle));
    }
    return p;
  }
};

Disc disc_like(const Points2& p, double side) {
  Disc disc;
  disc.middle = p.rowwise().mean();
  const auto n = static_cast<Index>(p.cols());
  double x = 0, y = 0;
  for (Index k = 0; k < n; ++k) {
    const Vec2 d = p.col(k) - disc.middle;
    disc.radius += d.norm() / n;
    const double ahead = portable::atan2(d.y(), d.x()) - side * turn * k / n;
    x += portable::cos(ahead);
    y += portable::sin(ahead);
  }
  disc.phase = portable::atan2(y, x);
  return disc;
}

/// Start or end: its curves, with the points of the rings between, and the states until all are discs.
struct Side {
  Polygons exact;
  std::vector<std::vector<IsotopyPlace>> places;
  std::vector<Polygons> states;
  std::vector<Disc> discs;
};

Polygons polygons_of(std::span<const Curve> curves) {
  Polygons polygons;
  for (const Curve& curve : curves)
    polygons.emplace_back(Eigen::Map<const Points2>(curve.points.data(), 2, static_cast<Eigen::Index>(curve.size())));
  return polygons;
}

/// False: stopped. `backwards`: the states are to be gone through from the last to the first.
bool make_round(std::span<const Curve> curves, std::span<const int> points, bool backwards,
                const std::function<bool()>& stop, Side& side) {
  side.exact = polygons_of(curves);
  std::vector<Curve> finer;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    side.places.push_back(places_on(curves[c], points[c]));
    finer.push_back(with_places(curves[c], side.places[c]));
  }
  const CurveNet net = make_net(finer, {}, false);
  const auto polygons_at = [&](const Points2& x) {
    Polygons polygons;
    for (const CurveNet::Chain& chain : net.chains) {
      Points2& p = polygons.emplace_back(2, chain.size());
      for (Index k = 0; k < chain.size(); ++k) p.col(k) = x.col(chain.vertices[k]);
    }
    return polygons;
  };
  std::size_t thinned = 0;  // states up to this one have been
  const auto compact = [&](std::vector<Points2>& states) {
    std::vector<Polygons> rings;
    for (std::size_t k = thinned; k < states.size(); ++k) rings.push_back(polygons_at(states[k]));
    std::vector<Points2> kept(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(thinned));
    for (const std::size_t k : thin_out(rings, net.diagonal, backwards, [] { return false; }))
      kept.push_back(std::move(states[thinned + k]));
    states = std::move(kept);
    thinned = states.size() - 1;
  };
  const std::vector<Points2> states = round_curves(net, net.rest, {}, stop, compact);
  if (states.empty()) return false;
  for (const Points2& x : states) side.states.push_back(polygons_at(x));
  Polygons& discs = side.states.emplace_back();
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const double direction = signed_area(curves[c]) > 0 ? 1 : -1;
    side.discs.push_back(disc_like(side.states[side.states.size() - 2][c], direction));
    discs.push_back(side.discs[c].polygon(points[c], direction));
  }
  return true;
}

/// Renumbers the points of a side so that point 0 of its discs is near where it is on the other side.
void renumber(Side& side, const std::vector<Disc>& like, std::span<const double> directions) {
  for (std::size_t c = 0; c < like.size(); ++c) {
    const auto n = static_cast<Index>(side.places[c].size());
    const double ahead = directions[c] * (like[c].phase - side.discs[c].phase) / turn;
    const Index shift = static_cast<Index>(std::lround((ahead - std::floor(ahead)) * n)) % n;
    std::rotate(side.places[c].begin(), side.places[c].begin() + shift, side.places[c].end());
    for (Polygons& state : side.states) {
      const Points2 p = state[c];
      for (Index k = 0; k < n; ++k) state[c].col(k) = p.col((k + shift) % n);
    }
    side.discs[c].phase += directions[c] * turn * shift / n;
  }
}

/// The smallest distance of two middles while each moves straight.
double smallest_distance(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < from.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 a = from[i] - from[j], b = to[i] - to[j];
      least = std::min(least, (a + nearest_fraction(Vec2(0, 0), a, b) * (b - a)).norm());
    }
  return least;
}

/// Inverse of the plastic number, which makes a sequence of low discrepancy (fixed by algebra)
constexpr double plastic_ratio = 0.7548776662;
constexpr double first_shift = 0.37;   ///< Shift of the sequence's first coordinate from disc to disc (no unit)
constexpr double second_shift = 0.61;  ///< Shift of the sequence's second coordinate from disc to disc (no unit)

/// Ways of the discs' middles from one side to the other: straight if that keeps them apart; else by way of one place
/// each, from a sequence of low discrepancy, the try that keeps them farthest apart.
std::vector<std::vector<Vec2>> ways(const std::vector<Disc>& from, const std::vector<Disc>& to, double diagonal) {
  std::vector<Vec2> a, b;
  for (const Disc& disc : from) a.push_back(disc.middle);
  for (const Disc& disc : to) b.push_back(disc.middle);
  if (smallest_distance(a, b) >= least_way_rel * diagonal) return {a, b};
  std::vector<Vec2> best = a;
  double best_distance = -1;
  for (int k = 1; k <= most_detours; ++k) {
    std::vector<Vec2> way;
    for (std::size_t c = 0; c < a.size(); ++c) {
      const double s = std::fmod((k + first_shift * static_cast<double>(c)) * std::numbers::phi, 1),
                   t = std::fmod(k * plastic_ratio + second_shift * static_cast<double>(c), 1);
      way.push_back(0.5 * (a[c] + b[c]) + diagonal * Vec2(s - 0.5, t - 0.5));
    }
    const double distance = std::min(smallest_distance(a, way), smallest_distance(way, b));
    if (distance > best_distance) {
      best_distance = distance;
      best = way;
    }
  }
  return {a, best, b};
}

class Making {
 public:
  Making(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options, Context* context)
      : start_(start), end_(end), options_(options), control_(context, {.time_s = options.time_limit_s}) {}

  Isotopy run() {
    std::vector<double> directions;
    for (std::size_t c = 0; c < start_.size(); ++c) {
      const auto most = static_cast<int>(std::max(start_[c].size(), end_[c].size()));
      made_.points.push_back(options_.points > 0 ? options_.points : std::max(most, least_points));
      directions.push_back(signed_area(start_[c]) > 0 ? 1 : -1);
    }
    std::vector<Curve> all(start_.begin(), start_.end());
    all.insert(all.end(), end_.begin(), end_.end());
    made_.height = diagonal_of(all);
    Side from, to;
    const auto stop = [&] { return is_stopped(); };
    control_.tell(0, "shorten");
    if (!make_round(start_, made_.points, false, stop, from)) return given_up();
    control_.tell(start_fraction, "shorten");
    if (!make_round(end_, made_.points, true, stop, to)) return given_up();
    renumber(to, from.discs, directions);
    made_.on_start = from.places;
    made_.on_end = to.places;

    std::vector<Polygons> states = std::move(from.states);
    join(from.discs, to.discs, directions, states);
    states.insert(states.end(), to.states.rbegin(), to.states.rend());
    control_.tell(end_fraction, "thin out");
    std::vector<std::size_t> kept = thin_out(states, made_.height, false, stop);
    if (kept.empty()) return given_up();
    bool is_refined = true;
    while (made_.status == Status::no_progress && is_refined) {
      build(from, to, states, kept);
      is_refined = refine_where_strips_meet(kept);
    }
    made_.seconds = control_.seconds();
    return std::move(made_);
  }

 private:
  bool is_stopped() {
    if (control_.stopped()) made_.status = control_.status_or(made_.status);
    return made_.status != Status::no_progress;
  }
  Isotopy given_up() {
    Isotopy nothing;
    nothing.status = made_.status;
    nothing.seconds = control_.seconds();
    return nothing;
  }
  /// Moves discs to discs; several discs shrink first, so that they can pass each other.
  void join(std::vector<Disc> from, const std::vector<Disc>& to, std::span<const double> directions,
            std::vector<Polygons>& states) const {
    if (from.size() == 1) return;
    const std::vector<std::vector<Vec2>> way = ways(from, to, made_.height);
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < way.size(); ++k)
      distance = std::min(distance, smallest_distance(way[k], way[k + 1]));
    for (std::size_t k = 0; k < way.size(); ++k) {
      Polygons& polygons = states.emplace_back();
      for (std::size_t c = 0; c < from.size(); ++c) {
        Disc disc = k + 1 < way.size() ? from[c] : to[c];
        disc.middle = way[k][c];
        disc.radius = std::min({from[c].radius, to[c].radius, disc_of_distance * distance});
        polygons.push_back(disc.polygon(made_.points[c], directions[c]));
      }
    }
  }

  /// Checks the whole surface: where triangles of a strip meet, the state halfway is kept too. Returns false if nothing
  /// meets, or if there is no state to keep.
  bool refine_where_strips_meet(std::vector<std::size_t>& kept) {
    FindOptions find;
    find.weld = Weld::none;
    const std::vector<IntersectingPair> pairs = find_intersections(made_.surface, find);
    if (pairs.empty()) made_.status = Status::embedded;
    std::vector<std::size_t> halfway;
    for (const IntersectingPair& pair : pairs)
      for (const std::int32_t face : {pair.a, pair.b}) {
        const auto strip = std::upper_bound(first_face_.begin(), first_face_.end(), face) - first_face_.begin() - 1;
        // The first and the last strip lead to the exact curves, the others from one kept state to the next.
        if (strip < 1 || static_cast<std::size_t>(strip) >= kept.size()) continue;
        const std::size_t before = kept[strip - 1], after = kept[strip];
        if (after - before > 1) halfway.push_back((before + after) / 2);
      }
    kept.insert(kept.end(), halfway.begin(), halfway.end());
    sort_unique(kept);
    return !halfway.empty();
  }

  void build(const Side& from, const Side& to, const std::vector<Polygons>& states,
             const std::vector<std::size_t>& kept) {
    std::vector<const Polygons*> rings;
    for (const std::size_t k : kept) rings.push_back(&states[k]);
    rings.insert(rings.begin(), &from.exact);
    rings.push_back(&to.exact);
    std::vector<double> effort{0};
    for (std::size_t k = 1; k < rings.size(); ++k) {
      double most = 0;
      if (k > 1 && k + 1 < rings.size())
        for (std::size_t c = 0; c < made_.points.size(); ++c)
          most = std::max(most, std::sqrt(((*rings[k])[c] - (*rings[k - 1])[c]).colwise().squaredNorm().maxCoeff()));
      effort.push_back(effort.back() + most);
    }
    const double mean = std::max(effort.back(), least_effort_rel * made_.height) / static_cast<double>(rings.size());
    const double sum = effort.back() + least_time * mean * static_cast<double>(rings.size() - 1);
    made_.rings.clear();
    made_.surface = {};
    first_face_.clear();
    std::vector<std::vector<Index>> first(rings.size());
    for (std::size_t k = 0; k < rings.size(); ++k) {
      IsotopyRing& ring = made_.rings.emplace_back();
      ring.time = k + 1 == rings.size() ? 1 : (effort[k] + least_time * mean * static_cast<double>(k)) / sum;
      for (const Points2& p : *rings[k]) {
        first[k].push_back(static_cast<Index>(made_.surface.positions.size() / 3));
        std::vector<double>& points = ring.curves.emplace_back();
        for (Index i = 0; i < p.cols(); ++i) {
          points.insert(points.end(), {p(0, i), p(1, i)});
          made_.surface.positions.insert(made_.surface.positions.end(), {p(0, i), p(1, i), ring.time * made_.height});
        }
      }
    }
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
      first_face_.push_back(static_cast<std::int32_t>(made_.surface.corners.size() / 3));
      for (std::size_t c = 0; c < made_.points.size(); ++c)
        add_strip(rungs_of(made_, k, c), first[k][c], first[k + 1][c], made_.surface.corners);
    }
  }

  std::span<const Curve> start_, end_;
  const IsotopyOptions& options_;
  RunControl control_;
  Isotopy made_;
  std::vector<std::int32_t> first_face_;  // of each strip
};

}  // namespace

Isotopy planar_isotopy(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options,
                       Context* context) {
  check(start, end, options);
  return Making(start, end, options, context).run();
}

}  // namespace unsnarl
