#include "applications/curves/switch_crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "applications/curves/touching.h"
#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

using Path = std::vector<Vec2>;

/// A crossing lies before this share of its segment, so that positions on curves of 2^32 segments tell it from the next
/// one (fixed by float64)
constexpr double largest_fraction = 1 - 0x1p-20;

/// A run of vertices of a chain, from slot `begin` on, around the end of a closed one.
struct Run {
  Index chain = 0, begin = 0, count = 0;
};

/// Places of a run from `begin` on, passed backwards or not.
struct Part {
  Index begin = 0, count = 0;
  bool backwards = false;

  Index at(Index k) const { return begin + (backwards ? count - 1 - k : k); }
};

/// One of the two places of a crossing on the curves.
struct Place {
  Index chain = 0, slot = 0;
  double fraction = 0;  ///< of the segment from that slot on, in [0, 1)
  Index crossing = 0;
  int strand = 0;  ///< 0: segment i of the crossing, 1: segment j

  double position() const { return slot + fraction; }
};

struct Move {
  enum class Kind : std::uint8_t {
    reorder,   ///< the vertices of `a` change places as `order` says
    exchange,  ///< `a` goes to way_a and `b` to way_b, and both stay there
    pull       ///< `a` goes to way_a, and is drawn back in recovery
  };
  Kind kind = Kind::reorder;
  double cost = 0;
  Run a = {}, b = {};
  Path way_a = {}, way_b = {};   ///< new positions, in the order of the runs
  std::vector<Part> order = {};  ///< of a reorder: which parts of `a` come one after the other
  bool is_turn() const { return kind == Kind::reorder && order.size() == 1; }
};

/// m points spread over the path; its own inner points where they are as many. The ends are left out, the last one only
/// if not `to_the_end`.
Path spread(const Path& path, Index m, bool to_the_end = false) {
  const auto inner = static_cast<Index>(path.size()) - (to_the_end ? 1 : 2);
  if (m == inner) return {path.begin() + 1, path.begin() + 1 + m};
  double length = 0;
  for (std::size_t k = 1; k < path.size(); ++k) length += (path[k] - path[k - 1]).norm();
  Path result;
  std::size_t k = 1;
  double done = 0;
  for (Index i = 0; i < m; ++i) {
    const double wanted = length * (to_the_end ? i + 1.0 : i + 0.5) / m;
    double edge = (path[k] - path[k - 1]).norm();
    while (k + 1 < path.size() && done + edge < wanted) {
      done += edge;
      ++k;
      edge = (path[k] - path[k - 1]).norm();
    }
    const double t = edge > 0 ? std::clamp((wanted - done) / edge, 0.0, 1.0) : 0.0;
    result.push_back(path[k - 1] + t * (path[k] - path[k - 1]));
  }
  return result;
}

/// Approximately the length of the path times its distance from the polyline through `way`; each point of the path is
/// compared with the whole polyline.
double lost_area(const Path& path, const Path& way) {
  if (way.size() + 2 >= path.size()) return 0;
  double area = 0;
  std::size_t near = 0;
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    // Both run the same way: the nearest piece does not go back.
    const auto distance = [&](std::size_t i) {
      const Vec2 a = i == 0 ? path.front() : way[i - 1], b = i < way.size() ? way[i] : path.back();
      return distance_to_segment(path[k], a, b);
    };
    double best = distance(near);
    for (std::size_t i = near + 1; i <= way.size() && i <= near + 2; ++i)
      if (const double d = distance(i); d < best) {
        best = d;
        near = i;
      }
    area += best * 0.5 * ((path[k] - path[k - 1]).norm() + (path[k + 1] - path[k]).norm());
  }
  return area;
}

/// m points on the straight way between two others, without these.
Path straight(const Vec2& from, const Vec2& to, Index m) {
  Path result;
  for (Index i = 0; i < m; ++i) result.push_back(from + (i + 1.0) / (m + 1.0) * (to - from));
  return result;
}

class Switcher {
 public:
  Switcher(const CurveNet& net, CurveState& state, const SwitchOptions& options)
      : net_(net), state_(state), options_(options), tree_(net), touched_(net.vertex_count(), 0) {
    tree_.refit(state_.x);
    for (const CurveNet::Chain& chain : net.chains) {
      std::vector<Index> sums{0};
      for (const Index v : chain.vertices) sums.push_back(sums.back() + net.pinned[v]);
      pinned_before_.push_back(std::move(sums));
    }
  }

  std::vector<SegmentPair> run(const std::function<bool(std::size_t)>& stop) {
    for (int round = 0;;) {
      if (!is_drawn_in_) draw_in_what_lies_on_others(net_, tree_, state_.x, touching_);
      is_drawn_in_ = true;
      const std::vector<SegmentPair> pairs = move_apart_what_touches(net_, tree_, state_.x, jitter_round_, touching_);
      if (pairs.empty() && round++ < options_.jitters && move_apart_what_nearly_touches()) continue;
      if (pairs.empty() || stop(pairs.size())) return pairs;
      const bool dense = static_cast<double>(pairs.size()) > options_.dense * net_.segment_count();
      if (!dense && pass_with_growing_reach(pairs)) continue;
      // Turning loops shortens a curve each time, so that it ends.
      if (turn_all(stop)) continue;
      if (stop(pairs.size()) || round++ >= options_.jitters || !move_apart_what_nearly_touches())
        return find_meetings(net_, tree_, state_.x);
    }
  }

  /// A closed curve may be passed from another point on, and backwards: the way that moves its points least.
  void renumber() {
    for (Index c = 0; c < static_cast<Index>(net_.chains.size()); ++c) {
      const CurveNet::Chain& chain = net_.chains[c];
      const Index n = chain.size();
      const Run whole{c, 0, n};
      if (!chain.closed || has_pinned(whole)) continue;
      const Content content = content_of(whole);
      if (std::count(content.turned.begin(), content.turned.end(), 0) == n) continue;
      const Index stride = std::max(Index{1}, n / options_.renumber_samples);
      const auto cost = [&](Index shift, bool backwards) {
        double sum = 0;
        for (Index k = 0; k < n; k += stride) {
          const Index from = ((backwards ? n - 1 - k : k) + shift) % n;
          sum += net_.weight[chain.vertices[k]] * (content.target[from] - net_.rest.col(chain.vertices[k])).norm();
        }
        return sum;
      };
      Index best_shift = 0;
      bool best_backwards = false;
      double best = cost(0, false);
      for (const bool backwards : {false, true})
        for (Index shift = 0; shift < n; ++shift)
          if (const double sum = cost(shift, backwards); sum < best) {
            best = sum;
            best_shift = shift;
            best_backwards = backwards;
          }
      if (best_backwards) {
        reorder(whole, {{0, best_shift, true}, {best_shift, n - best_shift, true}}, content);
      } else {
        reorder(whole, {{best_shift, n - best_shift, false}, {0, best_shift, false}}, content);
      }
    }
  }

 private:
  Vec2 at(Index chain, Index slot) const { return state_.x.col(vertex(chain, slot)); }
  Index vertex(Index chain, Index slot) const {
    const CurveNet::Chain& c = net_.chains[chain];
    return c.vertices[(slot % c.size() + c.size()) % c.size()];
  }
  Index vertex(const Run& run, Index k) const { return vertex(run.chain, run.begin + k); }

  bool has_pinned(const Run& run) const {
    const CurveNet::Chain& chain = net_.chains[run.chain];
    const std::vector<Index>& sums = pinned_before_[run.chain];
    const Index begin = run.begin % chain.size(), end = begin + run.count;
    if (end <= chain.size()) return sums[end] > sums[begin];
    return sums.back() - sums[begin] + sums[end - chain.size()] > 0;
  }

  /// Widens gaps of a few units in the last place, which recovery could not open and a file could not hold.
  bool move_apart_what_nearly_touches() {
    const double least = options_.least_gap_rel * net_.diagonal;
    std::vector<std::uint8_t> moves = vertices_closer_than(net_, tree_, state_.x, least);
    bool any = false;
    for (Index v = 0; v < net_.vertex_count(); ++v) {
      moves[v] = moves[v] && !net_.pinned[v];
      any |= moves[v] != 0;
    }
    if (!any) return false;
    for (Index v = 0; v < net_.vertex_count(); ++v)
      if (moves[v])
        state_.x.col(v) += options_.gap_jitter * least * jitter_of(static_cast<std::uint64_t>(v), jitter_round_);
    ++jitter_round_;
    tree_.refit(state_.x);
    return true;
  }

  /// Passes in which moves may change ever more vertices, until one removes a crossing. Begins with as many as are
  /// affordable. Returns false if none did.
  bool pass_with_growing_reach(const std::vector<SegmentPair>& pairs) {
    const Index most = net_.vertex_count();
    const double affordable = options_.affordable_vertices / static_cast<double>(pairs.size());
    reach_ = static_cast<Index>(std::clamp<double>(affordable, std::min(options_.least_reach, most), most));
    for (;;) {
      if (pass(pairs)) return true;
      if (reach_ >= most) return false;
      reach_ = std::min(4 * reach_, most);
    }
  }

  /// Makes the cheap moves that do not affect each other. Returns false if none removed a crossing.
  bool pass(const std::vector<SegmentPair>& pairs) {
    std::vector<Move> moves = candidates(pairs);
    std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) { return a.cost < b.cost; });
    std::fill(touched_.begin(), touched_.end(), 0);
    double most = std::numeric_limits<double>::infinity();
    bool any = false;
    const Move* refused = nullptr;
    for (const Move& move : moves) {
      if (move.cost > most) break;
      if (is_touched(move.a) || is_touched(move.b)) continue;
      const double limit = options_.cost_range * std::max(move.cost, least_cost());
      // A turn of coarse segments that was refused, since they meet others afterwards, is made nevertheless before far
      // more costly moves. It shortens the curve, so that this ends.
      if (!any && refused != nullptr && move.cost > options_.cost_range * std::max(refused->cost, least_cost()))
        return make(*refused, true);
      if (!make(move)) {
        if (refused == nullptr && move.is_turn()) refused = &move;
        continue;
      }
      any = true;
      touch(move.a);
      touch(move.b);
      most = std::min(most, limit);
    }
    return any || (refused != nullptr && make(*refused, true));
  }
  /// Cost below which moves count as equally cheap.
  double least_cost() const {
    return options_.least_motion_rel * net_.diagonal * net_.diagonal / std::max(Index{1}, net_.vertex_count());
  }

  bool is_touched(const Run& run) const {
    if (run.count == 0) return false;
    for (Index k = -1; k <= run.count; ++k)
      if (touched_[vertex(run, k)]) return true;
    return false;
  }
  void touch(const Run& run) {
    if (run.count == 0) return;
    for (Index k = -1; k <= run.count; ++k) touched_[vertex(run, k)] = 1;
  }

  std::vector<Move> candidates(const std::vector<SegmentPair>& pairs) {
    std::vector<Move> moves;
    std::vector<Place> places;
    std::vector<Vec2> points;
    for (const SegmentPair& pair : pairs) {
      if (pair.kind != SegmentMeeting::proper) continue;
      const Edge a = net_.segments[pair.i], b = net_.segments[pair.j];
      // Below 1, so that the order of places is that of their slots.
      const double t = std::min(crossing_fraction(state_.x, a, b), largest_fraction);
      const double u = std::min(crossing_fraction(state_.x, b, a), largest_fraction);
      const auto crossing = static_cast<Index>(points.size());
      points.push_back(state_.x.col(a[0]) + t * (state_.x.col(a[1]) - state_.x.col(a[0])));
      places.push_back({net_.chain_of[pair.i], net_.slot_of(pair.i), t, crossing, 0});
      places.push_back({net_.chain_of[pair.j], net_.slot_of(pair.j), u, crossing, 1});
      add_turn(places[places.size() - 2], places.back(), moves);
      add_tails(places[places.size() - 2], places.back(), points.back(), moves);
      add_tails(places.back(), places[places.size() - 2], points.back(), moves);
    }
    const std::vector<Place> by_crossing = places;
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return a.chain != b.chain ? a.chain < b.chain : a.position() < b.position();
    });
    for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
      while (end < places.size() && places[end].chain == places[begin].chain) ++end;
      const bool closed = net_.chains[places[begin].chain].closed;
      for (std::size_t k = begin; k < end; ++k) {
        if (k + 1 == end && !closed) continue;
        const Place &from = places[k], &to = places[k + 1 < end ? k + 1 : begin];
        if (from.crossing == to.crossing) continue;
        add_exchange(from, to, by_crossing[2 * from.crossing + 1 - from.strand],
                     by_crossing[2 * to.crossing + 1 - to.strand], points[from.crossing], points[to.crossing], moves);
      }
    }
    return moves;
  }

  /// The vertices from one place of a chain forward to another.
  Run between(const Place& from, const Place& to) const {
    Run run{from.chain, from.slot + 1, to.slot - from.slot};
    if (to.position() < from.position()) run.count += net_.chains[from.chain].size();
    return run;
  }
  double forward(const Place& from, const Place& to) const {
    const double d = to.position() - from.position();
    return d < 0 ? d + net_.chains[from.chain].size() : d;
  }

  void add_turn(const Place& p, const Place& q, std::vector<Move>& moves) const {
    if (p.chain != q.chain) return;
    std::vector<Move> ways;
    for (const Run& run : {between(p, q), between(q, p)})
      if (run.count >= 2) add_reorder(run, {{0, run.count, true}}, ways);
    if (!ways.empty()) moves.push_back(ways.size() == 2 && ways[1].cost < ways[0].cost ? ways[1] : ways[0]);
  }

  /// How much farther from rest the vertices come to lie, times their lengths.
  void add_reorder(const Run& run, std::vector<Part> order, std::vector<Move>& moves) const {
    const CurveNet::Chain& chain = net_.chains[run.chain];
    if (!chain.closed && (run.begin < 0 || run.begin + run.count > chain.size())) return;
    if (run.count > chain.size() || run.count > reach_ || has_pinned(run)) return;
    Move move{.kind = Move::Kind::reorder, .a = run};
    Index place = 0;
    for (const Part& part : order)
      for (Index k = 0; k < part.count; ++k, ++place) {
        const Index v = vertex(run, place), from = vertex(run, part.at(k));
        if (v == from) continue;
        const Vec2 rest = net_.rest.col(v);
        move.cost += net_.weight[v] * ((state_.target.col(from) - rest).norm() - (state_.target.col(v) - rest).norm());
      }
    move.order = std::move(order);
    moves.push_back(std::move(move));
  }

  Path path_of(const Run& run, const Vec2& from, const Vec2& to) const {
    Path path{from};
    for (Index k = 0; k < run.count; ++k) path.push_back(state_.x.col(vertex(run, k)));
    path.push_back(to);
    return path;
  }

  double cost_of(const Run& run, const Path& way) const {
    double cost = 0;
    for (Index k = 0; k < run.count; ++k) {
      const Index v = vertex(run, k);
      cost += net_.weight[v] * (way[k] - state_.x.col(v)).norm();
    }
    return cost;
  }

  void add_pull(const Run& run, Path way, std::vector<Move>& moves) const {
    if (run.count == 0 || run.count > reach_ || has_pinned(run)) return;
    Move move{.kind = Move::Kind::pull, .a = run, .way_a = std::move(way)};
    move.cost = options_.pull_cost * cost_of(run, move.way_a);
    moves.push_back(std::move(move));
  }

  /// from, to: neighbours on one strand; p, q: the same crossings on the strands that they cross there.
  void add_exchange(const Place& from, const Place& to, const Place& p, const Place& q, const Vec2& x, const Vec2& y,
                    std::vector<Move>& moves) const {
    const Run a = between(from, to);
    if (a.count > reach_) return;
    const auto outer = [&](const Run& run) {
      return straight(state_.x.col(vertex(run, -1)), state_.x.col(vertex(run, run.count)), run.count);
    };
    add_pull(a, outer(a), moves);
    if (p.chain != q.chain) return;
    const bool closed = net_.chains[p.chain].closed;
    for (const bool parallel : {true, false}) {
      const Place &first = parallel ? p : q, &last = parallel ? q : p;
      if (!closed && first.position() > last.position()) continue;
      if (p.chain == from.chain && forward(first, from) < forward(first, last)) continue;
      const Run b = between(first, last);
      if (a.count + b.count > reach_) continue;
      add_pull(b, outer(b), moves);
      if (from.chain == p.chain) add_swaps(a, b, parallel, moves);
      if (a.count == 0 || b.count == 0 || has_pinned(a) || has_pinned(b)) continue;
      Path path_a = path_of(a, x, y), path_b = path_of(b, parallel ? x : y, parallel ? y : x);
      Move move{.kind = Move::Kind::exchange, .a = a, .b = b};
      if (!parallel) {
        std::reverse(path_a.begin(), path_a.end());
        std::reverse(path_b.begin(), path_b.end());
      }
      move.way_a = spread(path_b, a.count);
      move.way_b = spread(path_a, b.count);
      finish(std::move(move), path_a, path_b, moves);
    }
  }
  /// Two runs of one chain change places, each with all its points; what is between them makes way along the curve.
  void add_swaps(const Run& a, const Run& b, bool parallel, std::vector<Move>& moves) const {
    const Index n = net_.chains[a.chain].size();
    for (const auto& [first, last] : {std::pair{a, b}, std::pair{b, a}}) {
      const Index begin = first.begin % n, gap = ((last.begin - first.begin - first.count) % n + n) % n;
      const Run whole{a.chain, begin, first.count + gap + last.count};
      add_reorder(whole,
                  {{first.count + gap, last.count, !parallel}, {first.count, gap, false}, {0, first.count, !parallel}},
                  moves);
    }
  }
  /// A path with more points than come to lie on it is drawn anew, more coarsely.
  void finish(Move move, const Path& path_a, const Path& path_b, std::vector<Move>& moves) const {
    move.cost = cost_of(move.a, move.way_a) + cost_of(move.b, move.way_b) +
                options_.drawing_cost * (lost_area(path_b, move.way_a) + lost_area(path_a, move.way_b));
    moves.push_back(std::move(move));
  }

  /// The part of an open curve beyond a crossing, outwards: from `place` to the end, or to the start.
  Run tail(const Place& place, bool to_end) const {
    const Index n = net_.chains[place.chain].size();
    return to_end ? Run{place.chain, place.slot + 1, n - place.slot - 1} : Run{place.chain, 0, place.slot + 1};
  }
  /// The tail of the open curve through `p` is drawn back, or exchanged with one of the other curve.
  void add_tails(const Place& p, const Place& q, const Vec2& x, std::vector<Move>& moves) const {
    if (net_.chains[p.chain].closed) return;
    for (const bool to_end : {true, false}) {
      const Run a = tail(p, to_end);
      if (has_pinned(a)) continue;
      const Vec2 base = at(p.chain, to_end ? p.slot : p.slot + 1);
      Path stub = straight(base, base + 0.5 * (x - base), a.count);
      if (!to_end) std::reverse(stub.begin(), stub.end());
      add_pull(a, std::move(stub), moves);
      if (net_.chains[q.chain].closed || q.chain == p.chain || p.chain > q.chain) continue;
      for (const bool other_to_end : {true, false}) {
        const Run b = tail(q, other_to_end);
        if (has_pinned(b)) continue;
        const auto outwards = [&](const Run& run, bool forward) {
          Path path{x};
          for (Index k = 0; k < run.count; ++k)
            path.push_back(state_.x.col(vertex(run, forward ? k : run.count - 1 - k)));
          return path;
        };
        Move move{.kind = Move::Kind::exchange,
                  .a = a,
                  .b = b,
                  .way_a = spread(outwards(b, other_to_end), a.count, true),
                  .way_b = spread(outwards(a, to_end), b.count, true)};
        if (!to_end) std::reverse(move.way_a.begin(), move.way_a.end());
        if (!other_to_end) std::reverse(move.way_b.begin(), move.way_b.end());
        finish(std::move(move), outwards(a, to_end), outwards(b, other_to_end), moves);
      }
    }
  }

  /// Segments that a move changes, as they are numbered before it, or after it: of a reorder those between its parts.
  std::vector<Index> changed_segments(const Move& move, bool after) const {
    std::vector<Index> result;
    const auto add = [&](const Run& run, Index k) {
      const CurveNet::Chain& chain = net_.chains[run.chain];
      if (!chain.closed && (run.begin + k < 0 || run.begin + k >= chain.segment_count())) return;
      result.push_back(chain.first_segment + (run.begin + k + chain.size()) % chain.size());
    };
    if (move.kind == Move::Kind::reorder) {
      Index place = 0;
      for (const Part& part : move.order) {
        add(move.a, (after ? place : part.begin) - 1);
        place += part.count;
        add(move.a, (after ? place : part.begin + part.count) - 1);
      }
    } else {
      for (const Run* run : {&move.a, &move.b})
        if (run->count > 0)
          for (Index k = -1; k < run->count; ++k) add(*run, k);
    }
    sort_unique(result);
    return result;
  }

  std::size_t count_meetings(const std::vector<Index>& segments) const {
    std::size_t count = 0;
    for (const Index i : segments) {
      const Vec2 a = state_.x.col(net_.segments[i][0]), b = state_.x.col(net_.segments[i][1]);
      tree_.near(a.cwiseMin(b), a.cwiseMax(b), [&](Index j) {
        if (j == i || (j < i && std::binary_search(segments.begin(), segments.end(), j))) return;
        if (meeting_of(state_.x, net_.segments[i], net_.segments[j]) != SegmentMeeting::none) ++count;
      });
    }
    return count;
  }

  /// Positions and targets of a run.
  struct Content {
    Path x, target;
    std::vector<std::uint8_t> turned;
  };
  Content content_of(const Run& run) const {
    Content c;
    for (Index k = 0; k < run.count; ++k) {
      const Index v = vertex(run, k);
      c.x.emplace_back(state_.x.col(v));
      c.target.emplace_back(state_.target.col(v));
      c.turned.push_back(state_.turned[v]);
    }
    return c;
  }
  void put(const Run& run, const Content& c) {
    for (Index k = 0; k < run.count; ++k) {
      const Index v = vertex(run, k);
      state_.x.col(v) = c.x[k];
      state_.target.col(v) = c.target[k];
      state_.turned[v] = c.turned[k];
    }
  }
  void reorder(const Run& run, const std::vector<Part>& order, const Content& old) {
    Index place = 0;
    for (const Part& part : order)
      for (Index k = 0; k < part.count; ++k, ++place) {
        const Index v = vertex(run, place), from = part.at(k);
        state_.x.col(v) = old.x[from];
        state_.target.col(v) = old.target[from];
        state_.turned[v] = old.turned[from] ^ static_cast<std::uint8_t>(part.backwards);
      }
  }
  void place(const Run& run, const Path& way, bool stays) {
    for (Index k = 0; k < run.count; ++k) {
      state_.x.col(vertex(run, k)) = way[k];
      if (stays) state_.target.col(vertex(run, k)) = way[k];
    }
  }

  /// The tree, after vertices of the run have moved, which no other curve shares.
  void refit(const Run& run) {
    if (run.count == 0) return;
    const CurveNet::Chain& chain = net_.chains[run.chain];
    const Index last = chain.first_segment + chain.segment_count() - 1;
    const Index begin = (run.begin - 1 + chain.size()) % chain.size(), end = begin + run.count;
    if (!chain.closed) {
      tree_.refit(state_.x, chain.first_segment + std::max(Index{0}, run.begin - 1),
                  std::min(last, chain.first_segment + run.begin + run.count - 1));
    } else if (end < chain.size()) {
      tree_.refit(state_.x, chain.first_segment + begin, chain.first_segment + end);
    } else {
      tree_.refit(state_.x, chain.first_segment + begin, last);
      tree_.refit(state_.x, chain.first_segment, std::min(last, chain.first_segment + end - chain.size()));
    }
  }

  /// Makes a move. Returns false and changes nothing if it would remove no crossing; `forced`: it is made nevertheless.
  bool make(const Move& move, bool forced = false) {
    const std::size_t before = count_meetings(changed_segments(move, false));
    const Content old_a = content_of(move.a), old_b = content_of(move.b);
    if (move.kind == Move::Kind::reorder) {
      reorder(move.a, move.order, old_a);
    } else {
      place(move.a, move.way_a, move.kind == Move::Kind::exchange);
      place(move.b, move.way_b, move.kind == Move::Kind::exchange);
    }
    refit(move.a);
    refit(move.b);
    if (forced || count_meetings(changed_segments(move, true)) < before) return true;
    put(move.a, old_a);
    put(move.b, old_b);
    refit(move.a);
    refit(move.b);
    return false;
  }

  /// Turns loops at any cost until no curve properly crosses itself, except at pinned loops. Returns false if no loop
  /// was turned.
  bool turn_all(const std::function<bool(std::size_t)>& stop) {
    bool any = false;
    for (bool changed = true; changed;) {
      changed = false;
      for (Index i = 0; i < net_.segment_count(); ++i) {
        if (i % 256 == 0 && stop(0)) return false;
        for (std::optional<Run> run = loop_at(i); run; run = loop_at(i)) {
          reorder(*run, {{0, run->count, true}}, content_of(*run));
          refit(*run);
          any = changed = true;
        }
      }
    }
    return any;
  }
  /// A loop that can be turned at a crossing of segment i with its own curve.
  std::optional<Run> loop_at(Index i) const {
    const Vec2 a = state_.x.col(net_.segments[i][0]), b = state_.x.col(net_.segments[i][1]);
    const CurveNet::Chain& chain = net_.chains[net_.chain_of[i]];
    std::optional<Run> found;
    tree_.near(a.cwiseMin(b), a.cwiseMax(b), [&](Index j) {
      if (found || net_.chain_of[j] != net_.chain_of[i] || j == i) return;
      if (meeting_of(state_.x, net_.segments[i], net_.segments[j]) != SegmentMeeting::proper) return;
      const Index p = net_.slot_of(std::min(i, j)), q = net_.slot_of(std::max(i, j));
      Run inner{net_.chain_of[i], p + 1, q - p}, outer{net_.chain_of[i], q + 1, chain.size() - (q - p)};
      if (chain.closed && outer.count < inner.count) std::swap(inner, outer);
      if (!has_pinned(inner)) {
        found = inner;
      } else if (chain.closed && !has_pinned(outer)) {
        found = outer;
      }
    });
    return found;
  }

  const CurveNet& net_;
  CurveState& state_;
  const SwitchOptions& options_;
  TouchingOptions touching_;
  SegmentTree tree_;
  std::vector<std::uint8_t> touched_;              // in this pass; one a vertex
  std::vector<std::vector<Index>> pinned_before_;  // of each chain: pinned vertices before each slot
  std::uint64_t jitter_round_ = 0;
  bool is_drawn_in_ = false;
  Index reach_ = 0;  // vertices that a move may change, at most
};

}  // namespace

std::vector<SegmentPair> switch_crossings(const CurveNet& net, CurveState& state, const SwitchOptions& options,
                                          const std::function<bool(std::size_t crossings)>& stop) {
  Switcher switcher(net, state, options);
  std::vector<SegmentPair> left = switcher.run(stop);
  switcher.renumber();
  return left.empty() ? left : find_meetings(net, state.x);
}

}  // namespace unsnarl
