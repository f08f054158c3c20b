#include "applications/curves/reroute_crossings.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "applications/curves/reversible_sequence.h"

namespace unsnarl {
namespace {

/// A curve's own crossings are sorted by their bends, and this part of them is opened before they are sorted again
/// [E274] (unit: crossings of the curve)
constexpr double opened_a_sort = 0.125;

/// The waypoints of a curve between two of its crossings, or between a crossing and an end of the curve: from behind
/// `from` until before `to`, around the end of a closed curve.
struct Arc {
  Index chain = 0, from = 0, to = 0;
  double length = std::numeric_limits<double>::infinity();
};

struct Exchange {
  Arc a, b;
  bool same_direction = true;  ///< both arcs begin at the same crossing
  double cost() const { return a.length + b.length; }
};

class Rerouting {
 public:
  Rerouting(const CrossedCurves& curves, const std::function<bool()>& stop)
      : curves_(curves), stop_(stop), ways_(curves.ways) {}

  ReroutedCurves operator()() {
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c) turn_all_loops(c, stop_);
    while (!stop_()) {  // once stopped, curves may still cross themselves, and nothing can be exchanged
      std::optional<Exchange> next = shortest_exchange(true);
      if (!next) next = shortest_exchange(false);
      if (!next) break;
      exchange(*next);
      // No curve is left that crosses itself because of the exchange.
      for (const Index c : {next->a.chain, next->b.chain}) turn_all_loops(c, [] { return false; });
    }
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c)
      if (is_closed(c)) renumber(c);
    ReroutedCurves result{curves_.net, std::vector<std::uint8_t>(curves_.net.vertex_count(), 0)};
    std::vector<std::vector<Index>> chains;
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c) {
      chains.emplace_back();
      std::vector<std::uint8_t> own(curves_.net.vertex_count(), 0);
      for (const Index v : curves_.net.chains[c].vertices) own[v] = 1;
      for (const Waypoint& point : ways_[c])
        if (!point.is_crossing()) {
          chains.back().push_back(point.vertex);
          result.turned[point.vertex] |= static_cast<std::uint8_t>(point.backwards || !own[point.vertex]);
        }
    }
    result.net = with_chains(std::move(result.net), std::move(chains));
    return result;
  }

 private:
  bool is_closed(Index chain) const { return curves_.net.chains[chain].closed; }

  Vec2 direction(const Waypoint& crossing) const {
    return (crossing.backwards ? -1.0 : 1.0) * curves_.crossings[crossing.crossing].along[crossing.strand];
  }
  Vec2 at(const Waypoint& point) const {
    return point.is_crossing() ? curves_.crossings[point.crossing].at : Vec2(curves_.x.col(point.vertex));
  }

  static void reverse(Way& way, std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::reverse(way.begin() + begin, way.begin() + end);
    for (auto point = way.begin() + begin; point != way.begin() + end; ++point) point->backwards = !point->backwards;
  }

  /// Turns loops of a curve until it does not cross itself, first where the strands go on the straightest.
  void turn_all_loops(Index chain, const std::function<bool()>& stop) {
    const Way way = ways_[chain];
    std::vector<std::pair<Index, Index>> visits;  // of crossings that the curve passes twice
    std::vector<Index> first(curves_.crossings.size(), -1);
    for (Index k = 0; k < static_cast<Index>(way.size()); ++k) {
      if (!way[k].is_crossing()) continue;
      Index& visit = first[way[k].crossing];
      if (visit >= 0) visits.emplace_back(visit, k);
      visit = k;
    }
    if (visits.empty()) return;
    ReversibleSequence sequence(static_cast<Index>(way.size()));
    // Both strands meet their own kind: the way in goes on along the other way in, backwards.
    const auto bend = [&](const std::pair<Index, Index>& visit) {
      const double straight = direction(way[visit.first]).dot(direction(way[visit.second]));
      return sequence.is_backwards(visit.first) == sequence.is_backwards(visit.second) ? straight : -straight;
    };
    while (!visits.empty() && !stop()) {
      // Each turn changes the sign of the bend of many; those that are worse now wait for the next sort.
      std::vector<std::pair<double, std::size_t>> by_bend;
      for (std::size_t k = 0; k < visits.size(); ++k) by_bend.emplace_back(bend(visits[k]), k);
      std::sort(by_bend.begin(), by_bend.end());
      auto wanted = static_cast<Index>(opened_a_sort * static_cast<double>(visits.size())) + 1;
      for (const auto& [then, k] : by_bend) {
        if (wanted == 0 || stop()) break;
        if (bend(visits[k]) > then) continue;
        const Index one = sequence.position_of(visits[k].first), other = sequence.position_of(visits[k].second);
        sequence.reverse(std::min(one, other) + 1, std::abs(one - other) - 1);
        sequence.remove(visits[k].first);
        sequence.remove(visits[k].second);
        visits[k].first = -1;
        --wanted;
      }
      std::erase_if(visits, [](const auto& visit) { return visit.first < 0; });
    }
    ways_[chain].clear();
    for (const Index k : sequence.order()) {
      Waypoint& point = ways_[chain].emplace_back(way[k]);
      point.backwards ^= sequence.is_backwards(k);
    }
  }

  /// Lengths and pinned vertices along a curve, up to each waypoint.
  struct Measures {
    std::vector<double> length;
    std::vector<Index> pinned, vertices;
  };
  Measures measure(Index chain) const {
    const Way& way = ways_[chain];
    Measures m;
    double length = 0;
    Index pinned = 0, vertices = 0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      if (k > 0) length += (at(way[k]) - at(way[k - 1])).norm();
      m.length.push_back(length);
      m.pinned.push_back(pinned);
      m.vertices.push_back(vertices);
      if (way[k].is_crossing()) continue;
      ++vertices;
      pinned += curves_.net.pinned[way[k].vertex];
    }
    if (is_closed(chain) && !way.empty()) length += (at(way.front()) - at(way.back())).norm();
    m.length.push_back(length);
    m.pinned.push_back(pinned);
    m.vertices.push_back(vertices);
    return m;
  }

  /// The arc from one place forward to another. Of infinite length: has pinned vertices.
  Arc arc_between(const Measures& m, Index chain, Index from, Index to) const {
    const auto size = static_cast<Index>(ways_[chain].size());
    Arc arc{chain, from, to};
    const auto along = [&](const auto& sums, auto zero) {
      const auto begin = from < 0 ? zero : sums[from];
      return from < to ? sums[to] - begin : sums[size] - begin + sums[to];
    };
    if (along(m.pinned, Index{0}) == 0) arc.length = along(m.length, 0.0);
    return arc;
  }
  Index vertices_of(const Measures& m, const Arc& arc) const {
    const auto size = static_cast<Index>(ways_[arc.chain].size());
    const Index begin = arc.from < 0 ? 0 : m.vertices[arc.from];
    return arc.from < arc.to ? m.vertices[arc.to] - begin : m.vertices[size] - begin + m.vertices[arc.to];
  }

  /// The shorter of the ways between two places that may be exchanged.
  Arc shorter_arc(const Measures& m, Index chain, Index p, Index q) const {
    if (!is_closed(chain)) return arc_between(m, chain, std::min(p, q), std::max(p, q));
    const Arc one = arc_between(m, chain, p, q), other = arc_between(m, chain, q, p);
    return other.length < one.length ? other : one;
  }
  /// This arc of a closed curve, or the rest of the curve: the one in which a place lies.
  Arc arc_with(const Measures& m, const Arc& arc, Index place) const {
    const auto size = static_cast<Index>(ways_[arc.chain].size());
    const auto ahead = [&](Index k) { return (k - arc.from + size) % size; };
    return ahead(place) < ahead(arc.to) ? arc : arc_between(m, arc.chain, arc.to, arc.from);
  }
  Arc shorter_tail(const Measures& m, Index chain, Index p) const {
    const Arc one = arc_between(m, chain, -1, p);
    const Arc other = arc_between(m, chain, p, static_cast<Index>(ways_[chain].size()));
    return other.length < one.length ? other : one;
  }

  /// The crossing that is nearest to an end of the open curve, for each pair of an open and a closed curve that cross
  /// an odd number of times. The key is (open, closed).
  std::map<std::pair<Index, Index>, Index> odd_crossings(const std::vector<Measures>& measures) const {
    std::vector<Index> closed_curve(curves_.crossings.size(), -1);
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c)
      for (const Waypoint& point : ways_[c])
        if (is_closed(c) && point.is_crossing()) closed_curve[point.crossing] = c;
    struct Met {
      Index count = 0, nearest = -1;
      double length = std::numeric_limits<double>::infinity();
    };
    std::map<std::pair<Index, Index>, Index> odd;
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c) {
      if (is_closed(c)) continue;
      std::map<Index, Met> met;  // of each closed curve
      for (Index k = 0; k < static_cast<Index>(ways_[c].size()); ++k) {
        const Waypoint& point = ways_[c][k];
        if (!point.is_crossing() || closed_curve[point.crossing] < 0) continue;
        Met& with = met[closed_curve[point.crossing]];
        ++with.count;
        const double tail = shorter_tail(measures[c], c, k).length;
        if (tail >= with.length) continue;
        with.length = tail;
        with.nearest = point.crossing;
      }
      for (const auto& [other, with] : met)
        if (with.count % 2 == 1 && with.nearest >= 0) odd[{c, other}] = with.nearest;
    }
    return odd;
  }

  /// The exchange of the shortest parts; none: nothing can be exchanged.
  /// all_open: an open curve takes that part of a closed one in which their odd crossing lies. It then crosses itself
  /// there, and turning the loop opens this crossing too. Otherwise such a pair keeps one crossing.
  std::optional<Exchange> shortest_exchange(bool all_open) const {
    std::vector<Measures> measures;
    // Where each crossing is passed: by two curves, since no curve crosses itself.
    std::vector<std::array<std::pair<Index, Index>, 2>> places(curves_.crossings.size());
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c) {
      measures.push_back(measure(c));
      for (Index k = 0; k < static_cast<Index>(ways_[c].size()); ++k)
        if (ways_[c][k].is_crossing()) places[ways_[c][k].crossing][ways_[c][k].strand] = {c, k};
    }
    std::map<std::pair<Index, Index>, Index> odd;
    if (all_open) odd = odd_crossings(measures);
    const auto odd_crossing = [&](Index c, Index other) {
      const auto found = odd.find(is_closed(c) ? std::pair{other, c} : std::pair{c, other});
      return found == odd.end() ? -1 : found->second;
    };
    std::optional<Exchange> best;
    const auto offer = [&](const Exchange& exchange) {
      if (!(exchange.cost() < (best ? best->cost() : std::numeric_limits<double>::infinity()))) return;
      const Index more =
          vertices_of(measures[exchange.b.chain], exchange.b) - vertices_of(measures[exchange.a.chain], exchange.a);
      const auto has_enough = [&](Index chain, Index change) {
        return measures[chain].vertices.back() + change >= (is_closed(chain) ? 3 : 2);
      };
      if (has_enough(exchange.a.chain, more) && has_enough(exchange.b.chain, -more)) best = exchange;
    };
    const auto offer_arcs = [&](Index c, Index p, Index q) {
      const Waypoint &from = ways_[c][p], &to = ways_[c][q];
      const auto [other, p_there] = places[from.crossing][1 - from.strand];
      const Index q_there = places[to.crossing][1 - to.strand].second;
      Exchange exchange{shorter_arc(measures[c], c, p, q), shorter_arc(measures[other], other, p_there, q_there)};
      if (const Index x = odd_crossing(c, other); x >= 0) {
        Arc& of_closed = is_closed(c) ? exchange.a : exchange.b;
        const auto [one, there] = places[x][0].first == of_closed.chain ? places[x][0] : places[x][1];
        of_closed = arc_with(measures[one], of_closed, there);
      }
      exchange.same_direction = (exchange.a.from == p) == (exchange.b.from == p_there);
      offer(exchange);
    };
    for (Index c = 0; c < static_cast<Index>(ways_.size()); ++c) {
      std::map<Index, std::pair<Index, Index>> seen;  // of each other curve, its first and last crossing so far
      for (Index k = 0; k < static_cast<Index>(ways_[c].size()); ++k) {
        const Waypoint& point = ways_[c][k];
        if (!point.is_crossing()) continue;
        const auto [other, there] = places[point.crossing][1 - point.strand];
        if (odd_crossing(c, other) == point.crossing) continue;
        if (const auto [entry, is_first] = seen.emplace(other, std::pair{k, k}); !is_first) {
          offer_arcs(c, entry->second.second, k);
          entry->second.second = k;
        }
        if (other > c && !is_closed(c) && !is_closed(other)) {
          Exchange tails{shorter_tail(measures[c], c, k), shorter_tail(measures[other], other, there)};
          tails.same_direction = (tails.a.from == k) == (tails.b.from == there);
          offer(tails);
        }
      }
      if (is_closed(c))
        for (const auto& [other, ends] : seen)
          if (ends.first != ends.second) offer_arcs(c, ends.second, ends.first);
    }
    return best;
  }

  Way content_of(const Arc& arc) const {
    const Way& way = ways_[arc.chain];
    Way result;
    const auto size = static_cast<Index>(way.size());
    for (Index k = arc.from + 1; k != arc.to; ++k) {
      if (k == size) k = 0;
      if (k == arc.to) break;
      result.push_back(way[k]);
    }
    return result;
  }
  /// Puts something else in the place of an arc and of the crossings at its ends.
  void replace(const Arc& arc, const Way& content) {
    const Way& way = ways_[arc.chain];
    const auto size = static_cast<Index>(way.size());
    Way result;
    if (is_closed(arc.chain)) {
      for (Index k = (arc.to + 1) % size; k != arc.from; k = (k + 1) % size) result.push_back(way[k]);
      result.insert(result.end(), content.begin(), content.end());
    } else {
      if (arc.from > 0) result.assign(way.begin(), way.begin() + arc.from);
      result.insert(result.end(), content.begin(), content.end());
      if (arc.to + 1 < size) result.insert(result.end(), way.begin() + arc.to + 1, way.end());
    }
    ways_[arc.chain] = std::move(result);
  }
  void exchange(const Exchange& exchange) {
    Way a = content_of(exchange.a), b = content_of(exchange.b);
    if (!exchange.same_direction) {
      reverse(a, 0, std::ssize(a));
      reverse(b, 0, std::ssize(b));
    }
    replace(exchange.a, b);
    replace(exchange.b, a);
  }

  /// A closed curve starts at its first vertex and is passed in the direction of the greater part of its length.
  void renumber(Index chain) {
    Way& way = ways_[chain];
    double forward = 0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const Waypoint& next = way[(k + 1) % way.size()];
      forward += (way[k].backwards ? -1.0 : 1.0) * (at(next) - at(way[k])).norm();
    }
    if (forward < 0) reverse(way, 0, std::ssize(way));
    const auto first = std::min_element(way.begin(), way.end(), [](const Waypoint& a, const Waypoint& b) {
      return a.is_crossing() != b.is_crossing() ? b.is_crossing() : a.vertex < b.vertex;
    });
    std::rotate(way.begin(), first, way.end());
  }

  const CrossedCurves& curves_;
  const std::function<bool()>& stop_;
  std::vector<Way> ways_;
};

}  // namespace

ReroutedCurves reroute_crossings(const CrossedCurves& curves, const std::function<bool()>& stop) {
  return Rerouting(curves, stop)();
}

}  // namespace unsnarl
