#include "unsnarl/knot_isotopy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "applications/knots/align_knots.h"
#include "applications/knots/knot_path.h"
#include "applications/knots/moving_polygon.h"
#include "applications/knots/relax_knot.h"
#include "applications/knots/untangle_cylinder.h"
#include "geometry/portable_math.h"
#include "geometry/rotation.h"
#include "geometry/splitmix.h"
#include "run/run_control.h"

namespace unsnarl {
namespace {

/// Points of a knot unless the caller says otherwise, at least: coarser ones let strands come nearer than edges are
/// long (unit: points)
constexpr int least_points = 200;
constexpr int fewest_points = 16;  ///< Fewest points that the caller may ask for (unit: points)
constexpr int most_points = 2000;  ///< Most points that a knot may have (unit: points)
/// Places where the shapes at rest are laid on each other, for each direction: a knot's symmetries give a few that are
/// equally good (unit: places)
constexpr std::size_t most_alignments = 6;
/// Times that both knots are brought to rest: shapes that balance on a ridge fall to one side when they are shaken
/// (unit: rounds)
constexpr int most_rounds = 3;
/// A shake moves points by this (unit: root mean square of their distances from the centre)
constexpr double shake_rel = 0.05;
/// A knot is shaken in this many of the longest waves along it (unit: waves)
constexpr int shake_waves = 5;
/// Rotation from ring to ring before they are thinned out, at most (unit: radian)
constexpr double rotation_step = 0.5;
constexpr double relaxing_share = 0.7;    ///< Share of the progress that bringing knots to rest takes (no unit)
constexpr double untangling_share = 0.2;  ///< Share of the progress that untangling takes (no unit)
constexpr double thinning_from = 0.9;     ///< Share of the progress when rings are thinned out (no unit)
constexpr double certifying_from = 0.98;  ///< Share of the progress when the result is certified (no unit)
/// The motion of all rings together counts as this much at least (unit: root mean square distance from the centre)
constexpr double least_effort_rel = 1e-6;
/// The time grows by this from ring to ring, at least (unit: mean of all rings)
constexpr double least_time = 0.2;

void check_knot(const char* which, const Link& link) {
  try {
    check_link(link);
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(fmt::format("{}: {}", which, e.what()));
  }
  if (link.components.size() != 1)
    throw std::invalid_argument(
        fmt::format("{} has {} components; only knots, which have one, are moved", which, link.components.size()));
  if (link.point_count() > most_points)
    throw std::invalid_argument(
        fmt::format("{} has {} points; knots may have {} at most", which, link.point_count(), most_points));
}

/// Whether points that were added on edges changed no knot.
void check_room(const char* which, const Positions& exact, const DensePolygon& dense) {
  if (!meeting_pairs(exact, dense.points, strip_to_finer(dense.pieces), 1).empty() ||
      !stays_simple(dense.points, dense.points))
    throw std::invalid_argument(
        fmt::format("{}: two edges are nearer to each other than rounding can tell; move them apart", which));
}

void check_options(const Link& start, const Link& end, const KnotIsotopyOptions& options) {
  check_knot("the start", start);
  check_knot("the end", end);
  const int given = options.points;
  if (given != 0 && (given < fewest_points || given > most_points))
    throw std::invalid_argument(fmt::format("points is {}; give {} to {}, or 0", given, fewest_points, most_points));
  const std::size_t longer = std::max(start.point_count(), end.point_count());
  if (given != 0 && static_cast<std::size_t>(given) < longer)
    throw std::invalid_argument(fmt::format("points is {}, but a knot has {}; give no fewer", given, longer));
  if (!(options.time_limit_s >= 0))
    throw std::invalid_argument(fmt::format("time_limit_s is {}; give 0 or more", options.time_limit_s));
}

double spread(const Positions& x) {
  return std::sqrt((x.colwise() - Vec3(x.rowwise().mean())).squaredNorm() / static_cast<double>(x.cols()));
}

/// The polygon shaken by long waves, as far as that is proven to be an isotopy.
Positions shaken(const Positions& x, std::uint64_t seed) {
  const auto n = static_cast<Index>(x.cols());
  std::uint64_t state = seed << 32;
  const auto dice = [&] { return 2 * splitmix_number(state += splitmix_step) - 1; };
  Positions shift = Positions::Zero(3, n);
  for (int wave = 1; wave <= shake_waves; ++wave)
    for (int axis = 0; axis < 3; ++axis) {
      const double c = dice(), s = dice();
      for (Index k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi * wave * k / n;
        shift(axis, k) += c * portable::cos(angle) + s * portable::sin(angle);
      }
    }
  shift *= shake_rel * spread(x) / std::sqrt(shift.colwise().squaredNorm().maxCoeff());
  for (int halvings = 0; halvings < 10; ++halvings, shift *= 0.5)
    if (is_proven_way(x, x + shift)) return x + shift;
  return x;
}

class Making {
 public:
  Making(const Link& start, const Link& end, const KnotIsotopyOptions& options, Context* context)
      : start_link_(start), end_link_(end), options_(options), control_(context, {.time_s = options.time_limit_s}) {}

  KnotIsotopy run() {
    scale();
    const Index n = options_.points > 0
                        ? options_.points
                        : static_cast<Index>(std::max(
                              {std::size_t{least_points}, start_link_.point_count(), end_link_.point_count()}));
    start_ = densified(start_exact_, n);
    end_ = densified(end_exact_, n);
    check_room("the start", start_exact_, start_);
    check_room("the end", end_exact_, end_);
    straight();
    const bool everything = options_.method == KnotMethod::automatic;
    if (is_open() && (everything || options_.method == KnotMethod::relax)) relax();
    if (is_open() && (everything || options_.method == KnotMethod::direct)) direct();
    if (made_.status != Status::embedded && control_.stopped()) {
      made_.status = control_.status_or(made_.status);
      made_.found = "stopped";
    }
    if (made_.status != Status::embedded) made_.rings.clear();
    made_.seconds = control_.seconds();
    return std::move(made_);
  }

 private:
  void scale() {
    std::array<Positions, 2> both{points_of(start_link_.components[0]), points_of(end_link_.components[0])};
    unit_ = exact_unit(both);
    start_exact_ = both[0] / unit_;
    end_exact_ = both[1] / unit_;
  }

  bool is_open() { return made_.status != Status::embedded && !control_.stopped(); }

  /// The end's points, in the order in which they are nearest to the start's.
  Alignment straight_order() const {
    Alignment order;
    order.first = nearest_order(start_.points, end_.points);
    return order;
  }

  void straight() {
    const Alignment order = straight_order();
    const std::vector<Positions> rings{start_.points, reordered(end_.points, order.first, false)};
    made_.straight_double_points = in_units(double_points(rings));
    if (made_.straight_double_points.empty() && finish(rings, order)) made_.found = "the straight way is an isotopy";
  }

  void direct() {
    const Alignment order = straight_order();
    UntangledCylinder cylinder =
        untangle_cylinder(start_.points, reordered(end_.points, order.first, false), [&](double fraction) {
          control_.tell(relaxing_share + untangling_share * fraction, "untangle");
          return control_.stopped();
        });
    made_.left_double_points = in_units(cylinder.left);
    if (control_.stopped()) return;
    if (cylinder.left.empty() && finish(std::move(cylinder.rings), order)) {
      made_.found = fmt::format("{} double points of the straight cylinder were untangled in R^4",
                                made_.straight_double_points.size());
      return;
    }
    int sum = 0;
    for (const KnotDoublePoint& p : made_.left_double_points) sum += p.sign;
    made_.found += fmt::format(
        "{}of {} double points of the straight cylinder in R^4 untangling left {}, with signs that sum to {}",
        made_.found.empty() ? "" : "; ", made_.straight_double_points.size(), made_.left_double_points.size(), sum);
  }

  std::vector<KnotDoublePoint> in_units(std::vector<KnotDoublePoint> points) const {
    for (KnotDoublePoint& p : points)
      for (double& c : p.place) c *= unit_;
    return points;
  }

  /// Relaxes a knot from its last state on. Returns false if it was stopped.
  bool to_rest(RelaxedKnot& knot, double gradient_rel, double begin, double end, std::string_view phase) {
    RelaxOptions options;
    options.gradient_rel = gradient_rel;
    double steps = 0;
    RelaxedKnot more = relax_knot(knot.states.back(), options, [&] {
      steps += 1;
      control_.tell(begin + (end - begin) * steps / (steps + 100), phase);  // about 100 states are usual
      return control_.stopped();
    });
    knot.states.insert(knot.states.end(), more.states.begin() + 1, more.states.end());
    knot.energy = more.energy;
    knot.at_rest = more.at_rest;
    return !control_.stopped();
  }

  void relax() {
    made_.relaxed = true;
    RelaxedKnot from, to;
    from.states.push_back(start_.points);
    to.states.push_back(end_.points);
    RelaxOptions options;
    for (int round = 0; round < most_rounds; ++round) {
      const double begin = relaxing_share * round / most_rounds, half = 0.5 * relaxing_share / most_rounds;
      if (round > 0) {
        from.states.push_back(shaken(from.states.back(), 2 * round));
        to.states.push_back(shaken(to.states.back(), 2 * round + 1));
      }
      const double gradient_rel = options.gradient_rel / (1 << round);
      if (!to_rest(from, gradient_rel, begin, begin + half, "relax the start") ||
          !to_rest(to, gradient_rel, begin + half, begin + 2 * half, "relax the end"))
        return;
      made_.start_energy = from.energy;
      made_.end_energy = to.energy;
      if (join(from, to)) {
        made_.found = fmt::format("both knots came to rest in one shape, with energies {:.2f} and {:.2f}", from.energy,
                                  to.energy);
        return;
      }
      if (control_.stopped()) return;
    }
    made_.found = fmt::format(
        "{}, with energies {:.2f} and {:.2f}, and no straight way joins their shapes: these may be different knots, or "
        "shapes of one that both are at rest",
        from.at_rest && to.at_rest ? "both knots came to rest" : "the knots could not be brought to rest", from.energy,
        to.energy);
  }

  bool join(const RelaxedKnot& from, const RelaxedKnot& to) {
    const Positions &x = from.states.back(), &y = to.states.back();
    for (const bool backwards : {false, true})
      for (const Alignment& alignment : alignments(x, y, backwards, most_alignments)) {
        if (control_.stopped()) return false;
        if (!is_proven_way(x, alignment.applied(reordered(y, alignment.first, backwards)))) continue;
        std::vector<Positions> path = from.states;
        // The end's shape turns back from where it fits the start's to where it came to rest.
        const Vec3 turn = rotation_vector(alignment.rotation);
        const int steps = std::max(1, static_cast<int>(std::ceil(turn.norm() / rotation_step)));
        for (int k = steps; k >= 0; --k) {
          Alignment part = alignment;
          part.rotation = rotation_by(turn * k / steps);
          path.push_back(part.applied(reordered(y, alignment.first, backwards)));
        }
        for (auto state = to.states.rbegin(); state != to.states.rend(); ++state)
          path.push_back(reordered(*state, alignment.first, backwards));
        if (finish(std::move(path), alignment)) return true;
      }
    return false;
  }

  /// Completes the path from the start's dense polygon to the end's, in the order of the alignment. Returns false if it
  /// is no isotopy, or not proven to be one.
  bool finish(std::vector<Positions> path, const Alignment& alignment) {
    control_.tell(thinning_from, "thin out");
    path = thinned_path(std::move(path), [&] { return control_.stopped(); });
    if (path.empty()) return false;
    control_.tell(certifying_from, "certify");
    const auto n = static_cast<Index>(start_.points.cols());
    const auto m = static_cast<Index>(end_exact_.cols());
    const Positions last = reordered(end_exact_, 0, alignment.backwards);
    std::vector<Index> pieces = end_.pieces;
    if (alignment.backwards)
      for (Index k = 0; k < m; ++k) pieces[k] = end_.pieces[m - 1 - k];
    const Index end_first = alignment.backwards ? alignment.first : (n - alignment.first) % n;
    if (!meeting_pairs(start_exact_, path.front(), strip_to_finer(start_.pieces), 1).empty() ||
        !meeting_pairs(path.back(), last, strip_from_finer(pieces, end_first), 1).empty())
      return false;
    path.insert(path.begin(), start_exact_);
    path.push_back(last);
    std::vector<double> effort{0};
    for (std::size_t k = 1; k < path.size(); ++k)
      effort.push_back(effort.back() + (path[k].cols() == path[k - 1].cols()
                                            ? std::sqrt((path[k] - path[k - 1]).colwise().squaredNorm().maxCoeff())
                                            : 0));
    const double intervals = static_cast<double>(path.size() - 1);
    const double mean = std::max(effort.back(), least_effort_rel * spread(start_exact_)) / intervals;
    const double sum = effort.back() + least_time * mean * intervals;
    made_.rings.clear();
    for (std::size_t k = 0; k < path.size(); ++k) {
      KnotRing& ring = made_.rings.emplace_back();
      ring.time = k + 1 == path.size() ? 1 : (effort[k] + least_time * mean * static_cast<double>(k)) / sum;
      const Positions back = path[k] * unit_;
      ring.points.assign(back.data(), back.data() + back.size());
    }
    made_.start_pieces.assign(start_.pieces.begin(), start_.pieces.end());
    made_.end_pieces.assign(pieces.begin(), pieces.end());
    made_.end_first = end_first;
    made_.reversed = alignment.backwards;
    if (!check_knot_isotopy(made_, start_link_, end_link_).hold()) return false;
    made_.status = Status::embedded;
    return true;
  }

  const Link &start_link_, &end_link_;
  const KnotIsotopyOptions& options_;
  RunControl control_;
  double unit_ = 1;
  Positions start_exact_, end_exact_;
  DensePolygon start_, end_;
  KnotIsotopy made_;
};

}  // namespace

KnotIsotopy knot_isotopy(const Link& start, const Link& end, const KnotIsotopyOptions& options, Context* context) {
  check_options(start, end, options);
  return Making(start, end, options, context).run();
}

RelaxedWire relaxed_wire(const Link& knot, double time_limit_s, Context* context) {
  check_knot("the knot", knot);
  if (!(time_limit_s >= 0))
    throw std::invalid_argument(fmt::format("time_limit_s is {}; give 0 or more", time_limit_s));
  RunControl control(context, {.time_s = time_limit_s});
  std::array<Positions, 1> exact{points_of(knot.components[0])};
  const double unit = exact_unit(exact);
  exact[0] /= unit;
  const DensePolygon dense =
      densified(exact[0], static_cast<Index>(std::max(std::size_t{least_points}, knot.point_count())));
  check_room("the knot", exact[0], dense);
  const RelaxedKnot relaxed = relax_knot(dense.points, {}, [&] {
    control.tell(0, "relax");
    return control.stopped();
  });
  const Positions x = unit * relaxed.states.back();
  RelaxedWire made;
  made.status = control.status_or(Status::embedded);
  made.link.components = {{x.data(), x.data() + x.size()}};
  made.at_rest = relaxed.at_rest;
  made.energy = relaxed.energy;
  made.seconds = control.seconds();
  return made;
}

}  // namespace unsnarl
