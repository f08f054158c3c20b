#include "mesh/seam_edges.h"

#include <algorithm>
#include <array>
#include <vector>

namespace unsnarl {
namespace {

/// More edges at one place are left unpaired: they are ambiguous without an exponential search, and no seam of two
/// sheets has so many (unit: edges)
constexpr std::size_t max_edges_to_pair = 8;
/// Rounds in which grown shells settle edges, at most; each is linear (unit: rounds)
constexpr int max_rounds = 32;

/// With ends of different position classes.
struct DirectedEdge : OpenSide {
  bool forward;  // the class of `from` is the smaller one
};

class SeamEdges {
 public:
  SeamEdges(std::span<const OpenSide> open, std::span<const Index> class_of, const CoincidentFaces& coincident,
            UnionFind& shells, UnionFind& welded)
      : class_of_(class_of), coincident_(coincident), shells_(shells), welded_(welded) {
    for (const auto& [face, from, to] : open) {
      if (class_of_[from] == class_of_[to])
        welded.unite(from, to);  // an open edge of length zero is a point of the boundary
      else
        edges_.push_back({{face, from, to}, class_of_[from] < class_of_[to]});
    }
    group_edges();
  }

  void weld_all(Ambiguous ambiguous) {
    settled_.assign(edges_.size(), 0);
    std::vector<std::array<Index, 2>> open;
    for (const auto& [begin, end] : groups_) {
      if (end - begin > 2)
        open.push_back({begin, end});
      else
        settle({begin, begin + 1});
    }
    bool changed = !open.empty();
    for (int round = 0; round < max_rounds && changed; ++round) {
      changed = false;
      std::erase_if(open, [&](const auto& group) { return settle_group(group[0], group[1], changed); });
    }
    if (ambiguous == Ambiguous::weld)
      for (const auto& [begin, end] : open) weld_together(begin, end);
  }

 private:
  /// Sorts the open edges by place, and in a place by face.
  void group_edges() {
    std::vector<Index> begin(class_of_.size() + 1, 0);
    const auto key = [&](const DirectedEdge& e) {
      const Index a = class_of_[e.from], b = class_of_[e.to];
      return e.forward ? std::pair(a, b) : std::pair(b, a);
    };
    for (const DirectedEdge& e : edges_) ++begin[key(e).first + 1];
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    std::vector<DirectedEdge> sorted(edges_.size());
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (const DirectedEdge& e : edges_) sorted[next[key(e).first]++] = e;
    edges_ = std::move(sorted);
    for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
      const auto first = edges_.begin() + begin[c], last = edges_.begin() + begin[c + 1];
      std::sort(first, last, [&](const DirectedEdge& a, const DirectedEdge& b) {
        const Index ka = key(a).second, kb = key(b).second;
        if (ka != kb) return ka < kb;
        return a.face != b.face ? a.face < b.face : a.from < b.from;
      });
      for (auto it = first; it != last;) {
        auto end = it + 1;
        while (end != last && key(*end).second == key(*it).second) ++end;
        if (end - it > 1)
          groups_.push_back({static_cast<Index>(it - edges_.begin()), static_cast<Index>(end - edges_.begin())});
        it = end;
      }
    }
  }

  void weld(Index i, Index j) {
    const DirectedEdge &a = edges_[i], &b = edges_[j];
    const bool same = a.forward == b.forward;
    welded_.unite(a.from, same ? b.from : b.to);
    welded_.unite(a.to, same ? b.to : b.from);
    shells_.unite(a.from, b.from);
  }

  bool are_partners(Index i, Index j) const {
    return edges_[i].forward != edges_[j].forward && !coincident_.coincide(edges_[i].face, edges_[j].face);
  }

  /// Number of ways (counted up to 2) to pair all edges off as partners; the first way found stays in `pairs`.
  int count_pairings(std::vector<Index>& left, std::vector<std::pair<Index, Index>>& way,
                     std::vector<std::pair<Index, Index>>& pairs) const {
    if (left.empty()) {
      if (pairs.empty()) pairs = way;
      return 1;
    }
    int ways = 0;
    const Index i = left.front();
    for (std::size_t k = 1; k < left.size() && ways < 2; ++k) {
      const Index j = left[k];
      if (!are_partners(i, j)) continue;
      std::vector<Index> rest;
      for (Index e : left)
        if (e != i && e != j) rest.push_back(e);
      way.emplace_back(i, j);
      ways += count_pairings(rest, way, pairs);
      way.pop_back();
    }
    return ways;
  }

  bool any_coincide(const std::vector<Index>& edges) const {
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (coincident_.coincide(edges_[edges[i]].face, edges_[edges[j]].face)) return true;
    return false;
  }

  /// Welds the edges if it is clear which belong together.
  bool settle(const std::vector<Index>& edges) {
    if (edges.size() < 2) return false;
    if (edges.size() == 2) {  // two sheets with inconsistent orientation have a seam too
      if (coincident_.coincide(edges_[edges[0]].face, edges_[edges[1]].face)) return false;
      weld(edges[0], edges[1]);
      return true;
    }
    if (edges.size() > max_edges_to_pair || edges.size() % 2 != 0) return false;
    std::vector<Index> left = edges;
    std::vector<std::pair<Index, Index>> way, pairs;
    if (count_pairings(left, way, pairs) != 1) return false;
    for (const auto& [i, j] : pairs) weld(i, j);
    return true;
  }

  /// One place: partners within a shell first, then what is left over. False where something stays open.
  bool settle_group(Index begin, Index end, bool& changed) {
    std::vector<std::pair<Index, Index>> open;  // (shell, edge)
    for (Index e = begin; e < end; ++e)
      if (!settled_[e]) open.emplace_back(shells_.find(edges_[e].from), e);
    std::sort(open.begin(), open.end());
    const auto mark = [&](const std::vector<Index>& edges) {
      for (Index e : edges) settled_[e] = 1;
      changed = true;
    };
    std::vector<Index> rest;
    for (auto it = open.begin(); it != open.end();) {
      std::vector<Index> edges;
      const Index shell = it->first;
      for (; it != open.end() && it->first == shell; ++it) edges.push_back(it->second);
      if (settle(edges))
        mark(edges);
      else
        rest.insert(rest.end(), edges.begin(), edges.end());
    }
    std::sort(rest.begin(), rest.end());
    if (rest.empty()) return true;
    if (settle(rest)) {
      mark(rest);
      return true;
    }
    return false;
  }

  /// No pairing is clear: welds all that stay clear of coincident faces, in the order of the faces.
  void weld_together(Index begin, Index end) {
    std::size_t open = 0;
    for (Index e = begin; e < end; ++e) open += settled_[e] == 0;
    if (open == 0) return;
    const bool whole_group = open % 2 == 1;  // one sheet ends on a seam of others: it belongs to them
    std::vector<std::vector<Index>> clusters;
    for (Index e = begin; e < end; ++e) {
      if (settled_[e] && !whole_group) continue;
      const auto fits = [&](const std::vector<Index>& cluster) {
        return std::none_of(cluster.begin(), cluster.end(),
                            [&](Index other) { return coincident_.coincide(edges_[e].face, edges_[other].face); });
      };
      const auto cluster = std::find_if(clusters.begin(), clusters.end(), fits);
      if (cluster == clusters.end()) {
        clusters.push_back({e});
      } else {
        weld(cluster->front(), e);
        cluster->push_back(e);
      }
    }
  }

  std::span<const Index> class_of_;
  const CoincidentFaces& coincident_;
  UnionFind &shells_, &welded_;
  std::vector<DirectedEdge> edges_;
  std::vector<std::array<Index, 2>> groups_;  // [begin, end) of edges at one place, two or more
  std::vector<std::uint8_t> settled_;         // by edge
};

}  // namespace

void weld_seam_edges(std::span<const OpenSide> open, std::span<const Index> class_of, const CoincidentFaces& coincident,
                     Ambiguous ambiguous, UnionFind& shells, UnionFind& welded) {
  SeamEdges(open, class_of, coincident, shells, welded).weld_all(ambiguous);
}

}  // namespace unsnarl
