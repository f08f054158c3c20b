#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "applications/isotopy/annulus.h"
#include "applications/isotopy/circles.h"
#include "applications/isotopy/correspondence.h"
#include "applications/isotopy/discs.h"
#include "applications/isotopy/pairing.h"
#include "applications/isotopy/rings.h"
#include "applications/isotopy/shrink_to_triangles.h"
#include "run/run_control.h"
#include "unsnarl/isotopy.h"

namespace unsnarl {
namespace {

/// Points of a curve unless the caller says otherwise, at least (unit: points)
constexpr int least_points = 200;
/// Annuli whose rings have more crossings are not untangled [E277] (unit: crossings a point of a ring)
constexpr double most_tangles_a_point = 0.5;
/// Curves with more points are not untangled, since an iteration takes too long (unit: points)
constexpr Index most_points_untangled = 600;
/// How often the part is halved by which both sides are shortened before an annulus joins them (unit: halvings)
constexpr int join_halvings = 5;
constexpr double laying_share = 0.03;  ///< Share of the progress when annuli are being laid (no unit)
constexpr double annulus_share = 0.3;  ///< Share of the progress when annuli have been tried (no unit)
constexpr double start_share = 0.55;   ///< Share of the progress when the start is triangles (no unit)
constexpr double end_share = 0.8;      ///< Share of the progress when the end is triangles too (no unit)
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

/// The first ring by which `part` of the length is gone that is gone once triangles are left.
std::size_t shorter_by(const TrianglesWay& way, double part) {
  const std::vector<Polygons>& rings = way.stack.rings;
  const double longest = length_of(rings.front()), shortest = length_of(rings.back());
  std::size_t k = 0;
  while (k + 1 < rings.size() && length_of(rings[k]) > longest + part * (shortest - longest)) ++k;
  return k;
}

/// A stack of annuli from some polygons to others.
struct Annulus {
  Stack stack;
  Correspondence places;  ///< of the points of the rings between, on the first and the last
  bool is_untangled = false;
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
    if (annulus_between_curves() || shortening() || control_.stopped()) {
      if (made_.status != Status::embedded) return given_up();
      made_.seconds = control_.seconds();
      return std::move(made_);
    }
    throw std::logic_error("triangles could not be joined");
  }

 private:
  Isotopy given_up() {
    Isotopy nothing;
    nothing.status = control_.status_or(Status::no_progress);
    nothing.seconds = control_.seconds();
    return nothing;
  }

  int least_count() const { return options_.points > 0 ? options_.points : least_points; }

  /// Annuli between polygons: of those that are embedded the one that keeps the shapes best, else, if `untangling`,
  /// what that makes of the one with the fewest intersections.
  std::optional<Annulus> annulus(const Polygons& start, const Polygons& end, bool untangling) {
    struct Try {
      Correspondence places;
      Annuli annuli;
      Blend blend;
      double kept;
    };
    std::vector<Try> tries;
    for (const Laying laying : {Laying::places, Laying::directions}) {
      std::vector<double> first;
      for (std::size_t c = 0; c < start.size(); ++c) first.push_back(first_fraction(start[c], end[c], laying));
      const Correspondence places = correspondence(start, end, first, least_count());
      const Polygons from = finer(start, places.on_start), to = finer(end, places.on_end);
      const auto points = static_cast<double>(joined_points(from).cols());
      for (const Blend blend : {Blend::straight, Blend::bending}) {
        if (control_.stopped()) return std::nullopt;
        const auto most = static_cast<std::size_t>(untangling ? most_tangles_a_point * points : 0);
        Annuli annuli = naive_annuli(from, to, blend, most);
        if (annuli.tangles > most) continue;
        const double kept = annuli.tangles == 0 ? shape_kept(annuli.rings, annuli.heights).least() : 0;
        tries.push_back({places, std::move(annuli), blend, kept});
      }
    }
    std::stable_sort(tries.begin(), tries.end(), [](const Try& a, const Try& b) {
      return a.annuli.tangles != b.annuli.tangles ? a.annuli.tangles < b.annuli.tangles : a.kept > b.kept;
    });
    for (Try& best : tries) {
      if (best.annuli.tangles > 0) break;
      best.annuli.tangles = tangled_strips(best.annuli, untangling ? best.annuli.rings.size() : 0);
      if (best.annuli.tangles > 0) continue;
      // Straight ways stay the same with fewer rings.
      std::vector<Polygons>& rings = best.annuli.rings;
      if (best.blend == Blend::straight) {
        std::vector<Polygons> fewer;
        for (const std::size_t k : thin_out(rings, made_.height)) fewer.push_back(std::move(rings[k]));
        rings = std::move(fewer);
      }
      return annulus_of(start, end, std::move(best.annuli), std::move(best.places), false);
    }
    if (!untangling || tries.empty()) return std::nullopt;
    const auto best = std::min_element(tries.begin(), tries.end(),
                                       [](const Try& a, const Try& b) { return a.annuli.tangles < b.annuli.tangles; });
    if (joined_points(best->annuli.rings.front()).cols() > most_points_untangled) return std::nullopt;
    best->annuli = untangled(best->annuli, [&] { return control_.stopped(); });
    if (best->annuli.tangles > 0) return std::nullopt;
    return annulus_of(start, end, std::move(best->annuli), std::move(best->places), true);
  }

  static Annulus annulus_of(const Polygons& start, const Polygons& end, Annuli annuli, Correspondence places,
                            bool is_untangled) {
    Annulus made{{}, std::move(places), is_untangled};
    made.stack.add(start, {});
    std::vector<std::vector<Rung>> to_finer, straight, to_end;
    for (std::size_t c = 0; c < start.size(); ++c) {
      to_finer.push_back(rungs_to_finer(made.places.on_start[c], static_cast<Index>(start[c].cols())));
      straight.push_back(straight_rungs(static_cast<Index>(made.places.on_start[c].size())));
      to_end.push_back(upside_down(rungs_to_finer(made.places.on_end[c], static_cast<Index>(end[c].cols()))));
    }
    for (std::size_t k = 0; k < annuli.rings.size(); ++k)
      made.stack.add(std::move(annuli.rings[k]), k == 0 ? to_finer : straight);
    made.stack.add(end, to_end);
    return made;
  }

  bool annulus_between_curves() {
    control_.tell(laying_share, "lay annuli");
    std::optional<Annulus> made = annulus(start_exact_, end_exact_, true);
    if (!made) return false;
    made_.method = made->is_untangled ? IsotopyMethod::untangled_annulus : IsotopyMethod::annulus;
    made_.on_start = std::move(made->places.on_start);
    made_.on_end = std::move(made->places.on_end);
    return finish(made->stack);
  }

  /// Corners of both sides are removed, which without end leads to triangles, but no farther than until an annulus
  /// between what is left is embedded.
  bool shortening() {
    const auto stop = [&] { return control_.stopped(); };
    control_.tell(annulus_share, "shorten");
    const TrianglesWay from = shrink_to_triangles(start_exact_, parent_, sides_, stop);
    control_.tell(start_share, "shorten the end");
    const TrianglesWay to = shrink_to_triangles(end_exact_, parent_, sides_, stop);
    if (stop()) return false;
    control_.tell(end_share, "join");
    made_.method = IsotopyMethod::shortening;
    std::size_t at_start = from.stack.rings.size() - 1, at_end = to.stack.rings.size() - 1;
    std::optional<Annulus> join = annulus(from.stack.rings[at_start], to.stack.rings[at_end], false);
    made_.shortened = 1;
    if (join) {
      double bad = 0;
      for (int k = 0; k < join_halvings && !stop(); ++k) {
        const double part = 0.5 * (made_.shortened + bad);
        const std::size_t i = shorter_by(from, part), j = shorter_by(to, part);
        if (std::optional<Annulus> earlier = annulus(from.stack.rings[i], to.stack.rings[j], false)) {
          join = std::move(earlier);
          made_.shortened = part;
          at_start = i;
          at_end = j;
        } else {
          bad = part;
        }
      }
    } else {
      join = joined_by_discs(from.stack.rings.back(), to.stack.rings.back());
    }
    if (stop()) return false;
    if (finish_joined(from, at_start, std::move(*join), to, at_end)) return true;
    // An annulus may be embedded but for its ends.
    made_.shortened = 1;
    const std::size_t start_triangles = from.stack.rings.size() - 1, end_triangles = to.stack.rings.size() - 1;
    return finish_joined(from, start_triangles, joined_by_discs(from.stack.rings.back(), to.stack.rings.back()), to,
                         end_triangles);
  }

  /// The way of the start up to a ring, what joins it to a ring of the way of the end, and that way back.
  bool finish_joined(const TrianglesWay& from, std::size_t at_start, Annulus join, const TrianglesWay& to,
                     std::size_t at_end) {
    Stack all = from.stack.first(at_start + 1);
    all.add_above(std::move(join.stack));
    all.add_above(to.stack.first(at_end + 1).upside_down());
    made_.on_start.clear();
    made_.on_end.clear();
    for (std::size_t c = 0; c < start_.size(); ++c) {
      made_.on_start.push_back(places_along(start_exact_[c], from.corners[at_start][c], join.places.on_start[c]));
      made_.on_end.push_back(places_along(end_exact_[c], to.corners[at_end][c], join.places.on_end[c]));
    }
    return finish(all);
  }

  /// From triangles to triangles by circles in them, which become discs that pass each other.
  Annulus joined_by_discs(const Polygons& start, const Polygons& end) const {
    const int n = least_count();
    CirclesWay from = make_circles(start, parent_, sides_, n), to = make_circles(end, parent_, sides_, n);
    std::vector<Disc> discs, to_discs;
    std::vector<Index> first;
    for (std::size_t c = 0; c < start_.size(); ++c) {
      discs.push_back(disc_within(from.rings.back()[c], sides_[c]));
      to_discs.push_back(disc_within(to.rings.back()[c], sides_[c]));
      const double ahead = sides_[c] * (discs[c].phase - to_discs[c].phase) / (2 * std::numbers::pi);
      first.push_back(static_cast<Index>(std::lround((ahead - std::floor(ahead)) * n)) % n);
    }
    Annuli annuli;
    annuli.rings = std::move(from.rings);
    for (const std::vector<Disc>& state : disc_ways(discs, to_discs, parent_, made_.height)) {
      Polygons& polygons = annuli.rings.emplace_back();
      for (std::size_t c = 0; c < state.size(); ++c) polygons.push_back(state[c].polygon(n, sides_[c]));
    }
    for (auto ring = to.rings.rbegin(); ring != to.rings.rend(); ++ring)
      annuli.rings.push_back(renumbered(*ring, first));
    for (std::size_t c = 0; c < to.places.size(); ++c)
      std::rotate(to.places[c].begin(), to.places[c].begin() + first[c], to.places[c].end());
    return annulus_of(start, end, std::move(annuli), {std::move(from.places), std::move(to.places)}, false);
  }

  /// Makes rings and surface of a stack. True: the surface is embedded.
  bool finish(Stack& stack) {
    made_.points.clear();
    for (const auto& places : made_.on_start) made_.points.push_back(static_cast<int>(places.size()));
    std::vector<double> heights = times_of(stack);
    build(stack, heights);
    FindOptions find;
    find.weld = Weld::none;
    if (!find_intersections(made_.surface, find).empty()) return false;
    const ShapeKept shape = shape_kept(stack.rings, heights);
    made_.length_kept = shape.length;
    made_.area_kept = shape.area;
    made_.rungs = std::move(stack.rungs);
    made_.status = Status::embedded;
    return true;
  }

  /// A strip takes the longer the longer its longest rung is.
  std::vector<double> times_of(const Stack& stack) const {
    std::vector<double> effort{0};
    for (std::size_t k = 0; k < stack.rungs.size(); ++k) {
      double most = 0;
      for (std::size_t c = 0; c < made_.points.size(); ++c) {
        const Points2 &lower = stack.rings[k][c], &upper = stack.rings[k + 1][c];
        for (const Rung& rung : stack.rungs[k][c])
          most = std::max(most, (upper.col(rung.upper) - lower.col(rung.lower)).norm());
      }
      effort.push_back(effort.back() + most);
    }
    const auto count = static_cast<double>(stack.rings.size());
    const double mean = std::max(effort.back(), least_effort_rel * made_.height) / count;
    const double sum = effort.back() + least_time * mean * (count - 1);
    std::vector<double> times;
    for (std::size_t k = 0; k < effort.size(); ++k)
      times.push_back((effort[k] + least_time * mean * static_cast<double>(k)) / sum);
    times.back() = 1;
    return times;
  }

  void build(const Stack& stack, const std::vector<double>& times) {
    made_.rings.clear();
    made_.surface = {};
    std::vector<std::vector<Index>> first(stack.rings.size());
    for (std::size_t k = 0; k < stack.rings.size(); ++k) {
      IsotopyRing& ring = made_.rings.emplace_back();
      ring.time = times[k];
      for (const Points2& p : stack.rings[k]) {
        first[k].push_back(static_cast<Index>(made_.surface.positions.size() / 3));
        std::vector<double>& points = ring.curves.emplace_back();
        for (Index i = 0; i < p.cols(); ++i) {
          points.insert(points.end(), {p(0, i), p(1, i)});
          made_.surface.positions.insert(made_.surface.positions.end(), {p(0, i), p(1, i), ring.time * made_.height});
        }
      }
    }
    for (std::size_t k = 0; k < stack.rungs.size(); ++k)
      for (std::size_t c = 0; c < made_.points.size(); ++c)
        add_strip(stack.rungs[k][c], first[k][c], first[k + 1][c], made_.surface.corners);
  }

  std::span<const Curve> start_;
  std::vector<Curve> end_;
  const IsotopyOptions& options_;
  RunControl control_;
  Polygons start_exact_, end_exact_;
  std::vector<Index> parent_;  // which curve of the start each lies in
  std::vector<double> sides_;  // 1: counter-clockwise, -1
  Isotopy made_;
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
