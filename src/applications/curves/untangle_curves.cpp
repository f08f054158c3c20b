#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "applications/curves/closeness.h"
#include "applications/curves/recover_curves.h"
#include "applications/curves/repel_curves.h"
#include "applications/curves/reroute_crossings.h"
#include "applications/curves/shrink_curves.h"
#include "applications/curves/switch_crossings.h"
#include "applications/curves/touching.h"
#include "run/run_control.h"

namespace unsnarl {
namespace {

using Clock = std::chrono::steady_clock;

/// Points this near to where they are pulled to are put there, a four-hundredth of the default gap (unit: bounding-box
/// diagonal)
constexpr double snap_rel = 1e-5;

/// Largest gap that may be asked for (unit: bounding-box diagonal)
constexpr double largest_gap_rel = 0.1;
/// Largest size of a junction that may be asked for (unit: bounding-box diagonal)
constexpr double largest_junction_rel = 0.1;
/// Distance beside a crossing at which curves get points: where strands cross at right angles, the corners are then one
/// gap apart (unit: gap)
constexpr double beside_gaps = 0.7;
/// What is farther from the drawing of the result counts as lost, five pixels in a drawing of 1,000 (unit: bounding-box
/// diagonal)
constexpr double lost_rel = 5e-3;
constexpr double report_every_s = 0.2;  ///< Time between two reports of progress, at least (unit: s)

void check_options(const CurveOptions& options) {
  if (!(options.gap_rel > 0 && options.gap_rel <= largest_gap_rel))
    throw std::invalid_argument(
        fmt::format("gap_rel is {}; give a number in (0, {}]", options.gap_rel, largest_gap_rel));
  if (!(options.junction_rel >= 0 && options.junction_rel <= largest_junction_rel))
    throw std::invalid_argument(
        fmt::format("junction_rel is {}; give a number in [0, {}]", options.junction_rel, largest_junction_rel));
  if (!(options.time_limit_s >= 0))
    throw std::invalid_argument(fmt::format("time_limit_s is {}; give a number from 0 on", options.time_limit_s));
}

class CurveUntangling {
 public:
  CurveUntangling(std::span<const Curve> input, const CurveOptions& options, Context* context)
      : options_(options), control_(context, {.time_s = options.time_limit_s}) {
    result_.curves.assign(input.begin(), input.end());
  }

  CurveResult operator()() {
    CurveReport& report = result_.report;
    const double diagonal = diagonal_of(result_.curves);
    report.joints = join_ends(result_.curves, options_.junction_rel * diagonal, report.inserted_points);
    check_curves(result_.curves);
    net_ = make_net(result_.curves, report.joints, options_.fix_ends);
    input_ = net_;
    report.diagonal = diagonal;
    const std::vector<SegmentPair> before = find_meetings(net_, net_.rest);
    report.crossings_before = before.size();
    report.before = as_crossings(net_, before);
    result_.joined = result_.curves;
    for (const SegmentPair& pair : before)
      if (is_fixed(pair)) report.fixed.push_back(as_crossings(net_, {pair})[0]);
    CurveState state = at_rest(net_);
    if (before.size() > report.fixed.size()) untangle(state, before.size());
    finish(state);
    report.seconds = control_.seconds();
    return std::move(result_);
  }

 private:
  static CurveState at_rest(const CurveNet& net) {
    return {net.rest, net.rest, std::vector<std::uint8_t>(net.vertex_count(), 0)};
  }

  bool is_fixed(const SegmentPair& pair) const {
    for (const Index s : {pair.i, pair.j})
      for (const Index v : net_.segments[s])
        if (!net_.fixed[v]) return false;
    return true;
  }

  void show(double fraction, std::string_view phase, std::size_t left, const CurveState& state) {
    if (!control_.is_told()) return;
    const auto now = Clock::now();
    if (fraction > 0 && std::chrono::duration<double>(now - shown_).count() < report_every_s) return;
    shown_ = now;
    const double moved = (state.x - net_.rest).colwise().norm().maxCoeff();
    control_.tell(fraction, phase, left, net_.diagonal > 0 ? moved / net_.diagonal : 0);
  }

  void untangle(CurveState& state, std::size_t before) {
    const std::size_t obstructions = result_.report.fixed.size();
    show(0, "untangle", before, state);
    std::size_t seen = before;
    const auto stop = [&](std::size_t left) {
      if (left > 0) seen = std::min(seen, left);
      show(0.5 * (1 - static_cast<double>(seen) / before), "untangle", seen, state);
      return control_.stopped() || (left > 0 && left <= obstructions);
    };
    std::size_t left = before;
    const auto is_solved = [&] { return left <= obstructions || control_.stopped(); };
    if (!options_.move_strands) {
      reroute(state, stop);
      left = move_strands(state, stop);
    }
    // Where joints or fixed points bar the way after re-routing, they may not without.
    const bool is_bad = is_worse(left, before, state);
    if (!is_solved() || is_bad) {
      const CurveNet rerouted = std::exchange(net_, input_);
      CurveState other = at_rest(net_);
      const std::size_t left_then = move_strands(other, stop);
      if (left_then < left || is_bad) {
        left = left_then;
        state = std::move(other);
      } else {
        net_ = rerouted;
      }
    }
    if (is_worse(left, before, state)) {
      net_ = input_;
      state = at_rest(net_);
      return;
    }
    if (left > obstructions || !options_.recover) return;
    int step = 0;
    recover_curves(net_, state, options_.gap_rel * net_.diagonal, recovering_, [&] {
      show(0.5 + 0.5 * step++ / recovering_.max_steps, "recover", 0, state);
      return control_.stopped();
    });
    snap(state);
  }

  /// Moves strands past each other until nothing crosses. Returns what is left.
  std::size_t move_strands(CurveState& state, const std::function<bool(std::size_t)>& stop) {
    const std::size_t obstructions = result_.report.fixed.size();
    std::vector<SegmentPair> left = switch_crossings(net_, state, switching_, stop);
    if (left.size() > obstructions && !control_.stopped())
      left = repel_curves(net_, state, repelling_, [&] { return control_.stopped(); });
    if (left.size() > obstructions && !control_.stopped()) left = shrink_curves(net_, state, shrinking_);
    return left.size();
  }

  /// More crossings than before, or a curve that crosses itself where it did not.
  bool is_worse(std::size_t left, std::size_t before, const CurveState& state) const {
    if (left == 0) return false;
    if (left > before) return true;
    const auto of_curves = [](const CurveNet& net, const Points2& x) {
      std::vector<std::uint8_t> crosses(net.chains.size(), 0);
      for (const SegmentPair& pair : find_meetings(net, x))
        if (net.chain_of[pair.i] == net.chain_of[pair.j]) crosses[net.chain_of[pair.i]] = 1;
      return crosses;
    };
    const std::vector<std::uint8_t> then = of_curves(input_, input_.rest), now = of_curves(net_, state.x);
    for (std::size_t c = 0; c < now.size(); ++c)
      if (now[c] > then[c]) return true;
    return false;
  }

  /// Gives the curves points beside their crossings and joins them there in another way.
  void reroute(CurveState& state, const std::function<bool(std::size_t)>& stop) {
    SegmentTree tree(net_);
    tree.refit(state.x);
    draw_in_what_lies_on_others(net_, tree, state.x, touching_);
    std::uint64_t jitters = 0;
    std::vector<SegmentPair> pairs = move_apart_what_touches(net_, tree, state.x, jitters, touching_);
    while (!pairs.empty() && !stop(pairs.size())) {
      const CrossedCurves crossed =
          with_crossing_points(net_, state.x, pairs, beside_gaps * options_.gap_rel * net_.diagonal);
      ReroutedCurves rerouted = reroute_crossings(crossed, [&] { return control_.stopped(); });
      std::vector<SegmentPair> left = find_meetings(rerouted.net, crossed.x);
      if (left.size() >= pairs.size()) return;
      net_ = std::move(rerouted.net);
      state = {crossed.x, net_.rest, std::move(rerouted.turned)};
      pairs = std::move(left);
    }
  }

  /// Puts points that moved by less than snap_rel back to their targets, so that the numbers of the input are kept,
  /// except where that would close a gap.
  void snap(CurveState& state) const {
    const Points2 recovered = state.x;
    const std::size_t left = find_meetings(net_, state.x).size();
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if ((state.x.col(v) - state.target.col(v)).norm() < snap_rel * net_.diagonal)
        state.x.col(v) = state.target.col(v);
    SegmentTree tree(net_);
    tree.refit(state.x);
    const std::vector<std::uint8_t> close = vertices_closer_than(net_, tree, state.x, snap_rel * net_.diagonal);
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (close[v]) state.x.col(v) = recovered.col(v);
    if (find_meetings(net_, state.x).size() > left) state.x = recovered;
  }

  void finish(const CurveState& state) {
    CurveReport& report = result_.report;
    result_.curves = with_positions(result_.curves, net_, state.x);
    report.joints = joints_of(net_);
    const std::vector<SegmentPair> left = find_meetings(net_, state.x);
    report.left = as_crossings(net_, left);
    report.crossings_after = left.size();
    if (left.empty()) {
      result_.status = Status::embedded;
    } else if (left.size() == report.fixed.size()) {
      result_.status = control_.status_or(Status::obstructed);
    } else {
      result_.status =
          control_.status_or(left.size() < report.crossings_before ? Status::reduced : Status::no_progress);
    }
    report.points = static_cast<std::size_t>(net_.vertex_count());
    report.inserted_points += static_cast<std::size_t>(net_.vertex_count() - input_.vertex_count());
    double total = 0;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      const double moved = (state.x.col(v) - net_.rest.col(v)).norm() / net_.diagonal;
      total += net_.weight[v];
      report.displacement_mean_rel += net_.weight[v] * moved;
      report.displacement_max_rel = std::max(report.displacement_max_rel, moved);
      report.moved_points += state.x.col(v) != net_.rest.col(v);
      report.turned_points += state.turned[v];
    }
    if (total > 0) report.displacement_mean_rel /= total;
    if (!(net_.diagonal > 0)) return;
    const double lost = lost_rel * net_.diagonal;
    const Closeness from_input = closeness_of(input_, input_.rest, net_, state.x, lost);
    const Closeness from_result = closeness_of(net_, state.x, input_, input_.rest, lost);
    report.distance_mean_rel = from_result.mean / net_.diagonal;
    report.distance_max_rel = from_result.largest / net_.diagonal;
    report.drawing_distance_mean_rel = from_input.mean / net_.diagonal;
    report.drawing_distance_max_rel = from_input.largest / net_.diagonal;
    report.drawing_lost = from_input.lost;
  }

  const CurveOptions& options_;
  RunControl control_;
  Clock::time_point shown_;
  CurveResult result_;
  CurveNet input_, net_;
  TouchingOptions touching_;
  SwitchOptions switching_;
  RepelOptions repelling_;
  ShrinkOptions shrinking_;
  CurveRecoverOptions recovering_;
};

}  // namespace

std::vector<CurveCrossing> find_crossings(std::span<const Curve> curves, std::span<const CurveJoint> joints) {
  check_curves(curves);
  const CurveNet net = make_net(curves, joints_at_one_position(curves, joints), false);
  return as_crossings(net, find_meetings(net, net.rest));
}

CurveResult untangle_curves(std::span<const Curve> curves, const CurveOptions& options, Context* context) {
  check_options(options);
  check_curves(curves);
  return CurveUntangling(curves, options, context)();
}

}  // namespace unsnarl
