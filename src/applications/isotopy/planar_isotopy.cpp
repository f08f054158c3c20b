#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "applications/isotopy/annulus.h"
#include "applications/isotopy/correspondence.h"
#include "applications/isotopy/discs.h"
#include "applications/isotopy/pairing.h"
#include "applications/isotopy/rings.h"
#include "applications/isotopy/round_polygons.h"
#include "geometry/sort_unique.h"
#include "run/run_control.h"
#include "unsnarl/isotopy.h"

namespace unsnarl {
namespace {

/// Points of a curve unless the caller says otherwise, at least (unit: points)
constexpr int least_points = 200;
/// Annuli whose rings have more crossings are not untangled (unit: crossings a point of a ring)
constexpr double most_tangles_a_point = 0.5;
/// Curves with more points are not untangled, since an iteration takes too long (unit: points)
constexpr Index most_points_untangled = 600;
/// How often the part is halved by which both sides are shortened before an annulus joins them (unit: halvings)
constexpr int join_halvings = 5;
constexpr double laying_share = 0.03;      ///< Share of the progress when annuli are being laid (no unit)
constexpr double untangling_share = 0.09;  ///< Share of the progress when annuli are laid (no unit)
constexpr double annulus_share = 0.3;      ///< Share of the progress when annuli have been tried (no unit)
constexpr double start_share = 0.55;       ///< Share of the progress when the start is round (no unit)
constexpr double end_share = 0.8;          ///< Share of the progress when the end is round too (no unit)
/// The motion of all slabs together counts as this much at least (unit: bounding-box diagonal)
constexpr double least_effort_rel = 1e-6;
/// The time of a slab grows by this at least (unit: mean of all slabs)
constexpr double least_time = 0.2;

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
}

void check_options(const IsotopyOptions& options) {
  if (options.points != 0 && (options.points < 16 || options.points > 100000))
    throw std::invalid_argument(fmt::format("points is {}; give 16 to 100000, or 0", options.points));
  if (!(options.time_limit_s >= 0)) throw std::invalid_argument("time_limit_s is below 0");
}

void check_orientations(std::span<const Curve> start, std::span<const Curve> end,
                        std::span<const std::int32_t> partner) {
  for (std::size_t c = 0; c < start.size(); ++c)
    if (signed_area(start[c]) * signed_area(end[partner[c]]) < 0)
      throw std::invalid_argument(fmt::format(
          "{} of the end runs around the other way than {} of the start, which no isotopy in the plane brings about; "
          "give its points in the other order (--reverse)",
          name_of_curve(end[partner[c]], partner[c]), name_of_curve(start[c], c)));
}

Polygons polygons_of(std::span<const Curve> curves) {
  Polygons polygons;
  for (const Curve& curve : curves)
    polygons.emplace_back(Eigen::Map<const Points2>(curve.points.data(), 2, static_cast<Eigen::Index>(curve.size())));
  return polygons;
}

Polygons finer(const Polygons& exact, const std::vector<std::vector<IsotopyPlace>>& places) {
  Polygons polygons;
  for (std::size_t c = 0; c < exact.size(); ++c) polygons.push_back(points_at(exact[c], places[c]));
  return polygons;
}

/// The same polygons, counted from another of their points on: one number a polygon.
Polygons renumbered(const Polygons& polygons, std::span<const Index> first) {
  Polygons made;
  for (std::size_t c = 0; c < polygons.size(); ++c) {
    const Points2& p = polygons[c];
    Points2& q = made.emplace_back(2, p.cols());
    q << p.rightCols(p.cols() - first[c]), p.leftCols(first[c]);
  }
  return made;
}

/// Start or end: its curves with the points of the rings between, and the states on the way to be round.
struct Side {
  std::vector<std::vector<IsotopyPlace>> places;
  std::vector<Polygons> states;

  /// The first state in which this part of the length is gone that goes until all is round.
  std::size_t shorter_by(double part) const {
    const double longest = length_of(states.front()), shortest = length_of(states.back());
    std::size_t k = 0;
    while (k + 1 < states.size() && length_of(states[k]) > longest + part * (shortest - longest)) ++k;
    return k;
  }
};

/// An annulus between a state of the start and one of the end, which is counted from other points on.
struct Join {
  std::size_t from = 0, to = 0;  ///< states
  std::vector<Index> first;      ///< point of the end's curves that are point 0
  std::vector<Polygons> rings;   ///< the states themselves included
};

class Making {
 public:
  Making(std::span<const Curve> start, std::span<const Curve> end, std::vector<std::int32_t> partner,
         const IsotopyOptions& options, Context* context)
      : start_(start), options_(options), control_(context, {.time_s = options.time_limit_s}) {
    for (const std::int32_t c : partner) end_.push_back(end[c]);
    made_.partner = std::move(partner);
    for (std::size_t c = 0; c < start_.size(); ++c) sides_.push_back(signed_area(start_[c]) > 0 ? 1 : -1);
    start_exact_ = polygons_of(start_);
    end_exact_ = polygons_of(end_);
    parent_ = parents_of(start_);
    std::vector<Curve> all(start_.begin(), start_.end());
    all.insert(all.end(), end_.begin(), end_.end());
    made_.height = diagonal_of(all);
  }

  Isotopy run() {
    if (annulus() || shortening() || control_.stopped()) {
      if (made_.status != Status::embedded) return given_up();
      made_.seconds = control_.seconds();
      return std::move(made_);
    }
    throw std::logic_error("round curves could not be joined");
  }

 private:
  Isotopy given_up() {
    Isotopy nothing;
    nothing.status = control_.status_or(Status::no_progress);
    nothing.seconds = control_.seconds();
    return nothing;
  }

  int least_count() const { return options_.points > 0 ? options_.points : least_points; }

  Correspondence correspondence_of(Laying laying) const {
    std::vector<double> first;
    for (std::size_t c = 0; c < start_.size(); ++c)
      first.push_back(first_fraction(start_exact_[c], end_exact_[c], laying));
    return correspondence(start_exact_, end_exact_, first, least_count());
  }

  /// Annuli between the curves themselves: of those that are embedded the one that keeps the shapes best, else what
  /// untangling makes of the one with the fewest intersections.
  bool annulus() {
    struct Try {
      Correspondence places;
      Annuli annuli;
      Blend blend;
    };
    std::optional<Try> best;
    double best_kept = 0;
    for (const Laying laying : {Laying::places, Laying::directions}) {
      const Correspondence places = correspondence_of(laying);
      const Polygons from = finer(start_exact_, places.on_start), to = finer(end_exact_, places.on_end);
      std::size_t points = 0;
      for (const Points2& p : from) points += static_cast<std::size_t>(p.cols());
      for (const Blend blend : {Blend::straight, Blend::bending}) {
        if (control_.stopped()) return false;
        control_.tell(laying_share, "lay annuli");
        const std::size_t most = best ? best->annuli.tangles : static_cast<std::size_t>(most_tangles_a_point * points);
        Annuli annuli = naive_annuli(from, to, blend, most);
        if (annuli.tangles > most) continue;
        const double kept = annuli.tangles == 0 ? shape_kept(annuli.rings, annuli.heights).least() : 0;
        if (best && annuli.tangles == best->annuli.tangles && kept <= best_kept) continue;
        best = Try{places, std::move(annuli), blend};
        best_kept = kept;
      }
    }
    if (!best) return false;
    made_.method = IsotopyMethod::annulus;
    if (best->annuli.tangles > 0) {
      Index points = 0;
      for (const Points2& p : best->annuli.rings.front()) points += static_cast<Index>(p.cols());
      if (points > most_points_untangled) return false;
      control_.tell(untangling_share, "untangle annuli");
      best->annuli = untangled(best->annuli, [&] { return control_.stopped(); });
      if (best->annuli.tangles > 0) return false;
      made_.method = IsotopyMethod::untangled_annulus;
    }
    made_.on_start = std::move(best->places.on_start);
    made_.on_end = std::move(best->places.on_end);
    std::vector<Polygons>& rings = best->annuli.rings;
    std::vector<std::size_t> kept(rings.size());
    std::iota(kept.begin(), kept.end(), 0);
    // Straight ways stay the same with fewer rings.
    if (made_.method == IsotopyMethod::annulus && best->blend == Blend::straight)
      kept = thin_out(rings, made_.height, false, [] { return false; });
    return finish(rings, std::move(kept));
  }

  /// Both sides are shortened toward round curves, by Grayson's theorem without end, but no farther than until an
  /// annulus between them is embedded.
  bool shortening() {
    std::vector<int> count;
    for (std::size_t c = 0; c < start_.size(); ++c)
      count.push_back(
          static_cast<int>(std::max<Eigen::Index>({least_count(), start_exact_[c].cols(), end_exact_[c].cols()})));
    Side from{even_places(start_exact_, count), {}}, to{even_places(end_exact_, count), {}};
    const auto stop = [&] { return control_.stopped(); };
    control_.tell(annulus_share, "shorten");
    from.states = round_polygons(start_exact_, from.places, parent_, sides_, stop);
    control_.tell(start_share, "shorten the end");
    to.states = round_polygons(end_exact_, to.places, parent_, sides_, stop);
    if (stop()) return false;
    control_.tell(end_share, "join");
    made_.method = IsotopyMethod::shortening;
    made_.shortened = 1;
    std::optional<Join> join = joined(from, to, 1);
    if (join) {
      double good = 1, bad = 0;
      for (int k = 0; k < join_halvings && !control_.stopped(); ++k) {
        const double part = 0.5 * (good + bad);
        std::optional<Join> earlier = joined(from, to, part);
        (earlier ? good : bad) = part;
        if (earlier) join = std::move(earlier);
      }
      made_.shortened = good;
    } else {
      join = joined_by_discs(from, to);
    }
    if (control_.stopped()) return false;
    control_.tell(end_share, "thin out");
    from.states.resize(join->from + 1);
    to.states.resize(join->to + 1);
    std::reverse(to.states.begin(), to.states.end());
    for (Polygons& state : to.states) state = renumbered(state, join->first);
    std::vector<Polygons> states;
    std::vector<std::size_t> kept;
    const auto add = [&](const std::vector<Polygons>& more, const std::vector<std::size_t>& of_them) {
      for (const std::size_t k : of_them) kept.push_back(states.size() + k);
      states.insert(states.end(), more.begin(), more.end());
    };
    std::vector<std::size_t> between(join->rings.size() - 2);
    std::iota(between.begin(), between.end(), 0);
    add(from.states, thin_out(from.states, made_.height, false, stop));
    add({join->rings.begin() + 1, join->rings.end() - 1}, between);
    add(to.states, thin_out(to.states, made_.height, false, stop));
    if (control_.stopped()) return false;
    for (std::size_t c = 0; c < to.places.size(); ++c)
      std::rotate(to.places[c].begin(), to.places[c].begin() + join->first[c], to.places[c].end());
    made_.on_start = std::move(from.places);
    made_.on_end = std::move(to.places);
    return finish(states, std::move(kept));
  }

  /// The embedded annuli between the states of both sides at a part of their ways that keep the shapes best.
  std::optional<Join> joined(const Side& from, const Side& to, double part) {
    Join join;
    join.from = from.shorter_by(part);
    join.to = to.shorter_by(part);
    double best = -1;
    for (const Laying laying : {Laying::places, Laying::directions}) {
      std::vector<Index> first;
      for (std::size_t c = 0; c < start_.size(); ++c) {
        const Points2 &p = from.states[join.from][c], &q = to.states[join.to][c];
        first.push_back(point_near(q, first_fraction(p, q, laying)));
      }
      const Polygons end = renumbered(to.states[join.to], first);
      for (const Blend blend : {Blend::straight, Blend::bending}) {
        if (control_.stopped()) return std::nullopt;
        Annuli annuli = naive_annuli(from.states[join.from], end, blend, 0);
        if (annuli.tangles > 0) continue;
        const double kept = shape_kept(annuli.rings, annuli.heights).least();
        if (kept <= best) continue;
        best = kept;
        join.rings = std::move(annuli.rings);
        join.first = first;
      }
    }
    if (best < 0) return std::nullopt;
    return join;
  }

  /// From round curves to round curves by discs that pass each other.
  Join joined_by_discs(const Side& from, const Side& to) const {
    Join join;
    join.from = from.states.size() - 1;
    join.to = to.states.size() - 1;
    const Polygons &start = from.states.back(), &end = to.states.back();
    join.rings.push_back(start);
    std::vector<Disc> discs, to_discs;
    for (std::size_t c = 0; c < start_.size(); ++c) {
      discs.push_back(disc_within(start[c], sides_[c]));
      to_discs.push_back(disc_within(end[c], sides_[c]));
      const auto n = static_cast<Index>(end[c].cols());
      const double ahead = sides_[c] * (discs[c].phase - to_discs[c].phase) / (2 * std::numbers::pi);
      join.first.push_back(static_cast<Index>(std::lround((ahead - std::floor(ahead)) * n)) % n);
    }
    const auto add = [&](const std::vector<Disc>& state) {
      Polygons& polygons = join.rings.emplace_back();
      for (std::size_t c = 0; c < state.size(); ++c)
        polygons.push_back(state[c].polygon(static_cast<Index>(from.places[c].size()), sides_[c]));
    };
    for (const std::vector<Disc>& state : disc_ways(discs, to_discs, parent_, made_.height)) add(state);
    join.rings.push_back(renumbered(end, join.first));
    return join;
  }

  /// Makes rings and surface of the states that are kept; where triangles of a strip meet, the state halfway is kept
  /// too. True: the surface is embedded.
  bool finish(const std::vector<Polygons>& states, std::vector<std::size_t> kept) {
    made_.points.clear();
    for (const auto& places : made_.on_start) made_.points.push_back(static_cast<int>(places.size()));
    FindOptions find;
    find.weld = Weld::none;
    while (true) {
      build(states, kept);
      const std::vector<IntersectingPair> pairs = find_intersections(made_.surface, find);
      if (pairs.empty()) break;
      std::vector<std::size_t> halfway;
      for (const IntersectingPair& pair : pairs)
        for (const std::int32_t face : {pair.a, pair.b}) {
          const auto strip = std::upper_bound(first_face_.begin(), first_face_.end(), face) - first_face_.begin() - 1;
          // The first and the last strip lead to the exact curves, the others from one kept state to the next.
          if (strip < 1 || static_cast<std::size_t>(strip) >= kept.size()) continue;
          const std::size_t before = kept[strip - 1], after = kept[strip];
          if (after - before > 1) halfway.push_back((before + after) / 2);
        }
      if (halfway.empty()) return false;
      kept.insert(kept.end(), halfway.begin(), halfway.end());
      sort_unique(kept);
    }
    std::vector<Polygons> rings;
    std::vector<double> heights;
    for (const IsotopyRing& ring : made_.rings) {
      heights.push_back(ring.time);
      Polygons& polygons = rings.emplace_back();
      for (const std::vector<double>& p : ring.curves)
        polygons.emplace_back(Eigen::Map<const Points2>(p.data(), 2, static_cast<Eigen::Index>(p.size() / 2)));
    }
    const ShapeKept shape = shape_kept(rings, heights);
    made_.length_kept = shape.length;
    made_.area_kept = shape.area;
    made_.status = Status::embedded;
    return true;
  }

  void build(const std::vector<Polygons>& states, const std::vector<std::size_t>& kept) {
    std::vector<const Polygons*> rings{&start_exact_};
    for (const std::size_t k : kept) rings.push_back(&states[k]);
    rings.push_back(&end_exact_);
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

  std::span<const Curve> start_;
  std::vector<Curve> end_;
  const IsotopyOptions& options_;
  RunControl control_;
  Polygons start_exact_, end_exact_;
  std::vector<Index> parent_;  // which curve of the start each lies in
  std::vector<double> sides_;  // 1: counter-clockwise, -1
  Isotopy made_;
  std::vector<std::int32_t> first_face_;  // of each strip
};

}  // namespace

std::string_view to_string(IsotopyMethod method) {
  switch (method) {
    case IsotopyMethod::annulus: return "annulus";
    case IsotopyMethod::untangled_annulus: return "untangled annulus";
    case IsotopyMethod::shortening: return "shortening";
  }
  return "";
}

Isotopy planar_isotopy(std::span<const Curve> start, std::span<const Curve> end, const IsotopyOptions& options,
                       Context* context) {
  check_options(options);
  std::vector<std::int32_t> partner = isotopy_partners(start, end, options.pairs);
  check_orientations(start, end, partner);
  return Making(start, end, std::move(partner), options, context).run();
}

std::vector<std::int32_t> isotopy_partners(std::span<const Curve> start, std::span<const Curve> end,
                                           std::span<const std::array<std::int32_t, 2>> pairs) {
  if (start.empty()) throw std::invalid_argument("the start has no curves");
  if (start.size() != end.size())
    throw std::invalid_argument(
        fmt::format("the start has {} curves, the end {}; each becomes one of the end, so give equally many",
                    start.size(), end.size()));
  check_side(start, "start");
  check_side(end, "end");
  return pair_curves(start, end, pairs);
}

}  // namespace unsnarl
