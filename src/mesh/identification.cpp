#include "mesh/identification.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// More edges than this at one place are glued without looking for a pairing: the search is exponential, and no
/// two-sheet seam has so many.
constexpr std::size_t max_edges_to_pair = 8;
/// Rounds of letting grown shells settle edges; each is linear. Two or three suffice for files of touching solids.
constexpr int max_rounds = 32;

std::uint64_t mixed(std::uint64_t h) {  // finaliser of MurmurHash3
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

std::uint64_t hash_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mixed(a + 0x9e3779b97f4a7c15ULL * mixed(b + 0x9e3779b97f4a7c15ULL * mixed(c)));
}

/// Open-addressing table from keys that somebody else stores to their ids.
class IdTable {
 public:
  explicit IdTable(std::size_t capacity) : slots_(std::bit_ceil(2 * capacity + 2), Slot{0, -1}) {}

  /// The id stored under a key with this hash for which same(id) holds; -1 and `id_if_new` stored where there is none.
  template <class Same>
  Index find_or_add(std::uint64_t hash, Index id_if_new, Same&& same) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i].id < 0) {
        slots_[i] = {tag, id_if_new};
        return -1;
      }
      if (slots_[i].tag == tag && same(slots_[i].id)) return slots_[i].id;
    }
  }
  template <class Same>
  Index find(std::uint64_t hash, Same&& same) const {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = hash & (slots_.size() - 1); slots_[i].id >= 0; i = (i + 1) & (slots_.size() - 1))
      if (slots_[i].tag == tag && same(slots_[i].id)) return slots_[i].id;
    return -1;
  }

 private:
  struct Slot {
    std::uint32_t tag;
    Index id;
  };
  std::vector<Slot> slots_;
};

/// Renumbers so that ids are dense and ordered by first occurrence.
std::vector<Index> dense(UnionFind& sets, std::size_t n) {
  std::vector<Index> id(n, -1);
  Index count = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const Index root = sets.find(static_cast<Index>(v));
    if (id[root] < 0) id[root] = count++;
    id[v] = id[root];
  }
  return id;
}

std::vector<Index> exact_classes(std::span<const double> positions) {
  const std::size_t n = positions.size() / 3;
  std::vector<Index> class_of(n), first;
  IdTable table(n);
  for (std::size_t v = 0; v < n; ++v) {
    const double* p = &positions[3 * v];
    // Adding 0.0 turns -0.0 into 0.0, so that equal numbers have equal bits.
    const std::uint64_t hash =
        hash_of(std::bit_cast<std::uint64_t>(p[0] + 0.0), std::bit_cast<std::uint64_t>(p[1] + 0.0),
                std::bit_cast<std::uint64_t>(p[2] + 0.0));
    const Index found = table.find_or_add(hash, static_cast<Index>(first.size()), [&](Index id) {
      const double* q = &positions[3 * static_cast<std::size_t>(first[id])];
      return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
    });
    class_of[v] = found >= 0 ? found : static_cast<Index>(first.size());
    if (found < 0) first.push_back(static_cast<Index>(v));
  }
  return class_of;
}

/// Distinct positions in cells as wide as the tolerance; each is compared with those of the 27 cells around it.
std::vector<Index> tolerant_classes(std::span<const double> positions, double tolerance) {
  const std::vector<Index> exact = exact_classes(positions);
  std::vector<Index> first;
  for (std::size_t v = 0; v < exact.size(); ++v)
    if (exact[v] == static_cast<Index>(first.size())) first.push_back(static_cast<Index>(v));

  using Cell = std::array<double, 3>;  // whole numbers; doubles, since the quotient may exceed any integer type
  const auto cell_of = [&](Index id) {
    const double* p = &positions[3 * static_cast<std::size_t>(first[id])];
    return Cell{std::floor(p[0] / tolerance) + 0.0, std::floor(p[1] / tolerance) + 0.0,
                std::floor(p[2] / tolerance) + 0.0};
  };
  const auto hash_cell = [](const Cell& c) {
    return hash_of(std::bit_cast<std::uint64_t>(c[0]), std::bit_cast<std::uint64_t>(c[1]),
                   std::bit_cast<std::uint64_t>(c[2]));
  };
  std::vector<Cell> cells(first.size());
  std::vector<Index> next_in_cell(first.size(), -1);  // the table holds the first of each cell
  IdTable table(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    cells[i] = cell_of(static_cast<Index>(i));
    const Index head =
        table.find_or_add(hash_cell(cells[i]), static_cast<Index>(i), [&](Index id) { return cells[id] == cells[i]; });
    if (head >= 0) {
      next_in_cell[i] = next_in_cell[head];
      next_in_cell[head] = static_cast<Index>(i);
    }
  }

  UnionFind sets(exact.size());
  for (std::size_t v = 0; v < exact.size(); ++v) sets.unite(first[exact[v]], static_cast<Index>(v));
  const double squared_tolerance = tolerance * tolerance;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double* p = &positions[3 * static_cast<std::size_t>(first[i])];
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Cell cell = {cells[i][0] + neighbour % 3 - 1 + 0.0, cells[i][1] + neighbour / 3 % 3 - 1 + 0.0,
                         cells[i][2] + neighbour / 9 - 1 + 0.0};
      Index j = table.find(hash_cell(cell), [&](Index id) { return cells[id] == cell; });
      for (; j >= 0; j = next_in_cell[j]) {
        if (j >= static_cast<Index>(i)) continue;
        const double* q = &positions[3 * static_cast<std::size_t>(first[j])];
        const double dx = p[0] - q[0], dy = p[1] - q[1], dz = p[2] - q[2];
        if (dx * dx + dy * dy + dz * dz <= squared_tolerance) sets.unite(first[i], first[j]);
      }
    }
  }
  return dense(sets, exact.size());
}

/// A side of a face that no other face uses (by vertex ids), with ends of different position classes.
struct BoundaryEdge {
  Index face;
  Index from, to;  // vertices, in the order of the face
  bool forward;    // the class of `from` is the smaller one
};

/// What gluing needs to know; see the declaration of identify for the three steps.
class SeamGluing {
 public:
  SeamGluing(const SurfaceView& surface, std::vector<Index> class_of)
      : surface_(surface),
        class_of_(std::move(class_of)),
        shells_(surface.vertex_count()),
        glued_(surface.vertex_count()),
        on_boundary_(surface.vertex_count(), 0) {}

  UnionFind run() {
    for (std::size_t f = 0; f < surface_.face_count(); ++f) {
      const auto corners = surface_.face(f);
      for (std::size_t k = 1; k < corners.size(); ++k) shells_.unite(corners[0], corners[k]);
    }
    for_each_open_side([](Index v) { return v; }, [&](const Side& side) { add_boundary_edge(side); });
    find_coincident_faces();
    group_edges();
    glue_edges();
    glue_vertices();
    glue_collapsed_edges();
    if (is_soup()) glue_open_vertices();
    return std::move(glued_);
  }

 private:
  struct Side {
    Index larger, face, from, to;
  };

  template <class Visit>
  void for_each_side(Visit&& visit) const {
    for (std::size_t f = 0; f < surface_.face_count(); ++f) {
      const auto corners = surface_.face(f);
      for (std::size_t k = 0; k < corners.size(); ++k)
        visit(static_cast<Index>(f), corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
    }
  }

  /// Visits the sides whose pair of vertices, after renaming, occurs once in the whole surface.
  template <class Rename, class Visit>
  void for_each_open_side(Rename&& rename, Visit&& visit) {
    const std::size_t n = surface_.vertex_count();
    std::vector<Index> begin(n + 1, 0);
    for_each_side([&](Index, Index from, Index to) {
      const Index a = rename(from), b = rename(to);
      if (a != b) ++begin[std::min(a, b) + 1];
    });
    for (std::size_t v = 0; v < n; ++v) begin[v + 1] += begin[v];
    std::vector<Side> sides(static_cast<std::size_t>(begin[n]));
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for_each_side([&](Index f, Index from, Index to) {
      const Index a = rename(from), b = rename(to);
      if (a != b) sides[next[std::min(a, b)]++] = {std::max(a, b), f, from, to};
    });
    for (std::size_t v = 0; v < n; ++v) {
      const auto first = sides.begin() + begin[v], last = sides.begin() + begin[v + 1];
      std::stable_sort(first, last, [](const Side& s, const Side& t) { return s.larger < t.larger; });
      for (auto it = first; it != last;) {
        auto end = it + 1;
        while (end != last && end->larger == it->larger) ++end;
        if (end - it == 1) visit(*it);
        it = end;
      }
    }
  }

  void add_boundary_edge(const Side& side) {
    on_boundary_[side.from] = on_boundary_[side.to] = 1;
    // An edge of no length has no direction to glue along; steps (c) and (d) join its ends.
    if (class_of_[side.from] == class_of_[side.to]) return;
    edges_.push_back({side.face, side.from, side.to, class_of_[side.from] < class_of_[side.to]});
  }

  std::vector<Index> corner_classes(Index f) const {
    std::vector<Index> classes;
    for (Index v : surface_.face(f)) classes.push_back(class_of_[v]);
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    return classes;
  }

  /// Numbers the sets of faces with equal corners; -1 for the others.
  void find_coincident_faces() {
    const auto m = surface_.face_count();
    coincident_set_.assign(m, -1);
    IdTable table(m);
    Index sets = 0;
    std::vector<Index> classes;
    for (std::size_t f = 0; f < m; ++f) {
      classes.clear();
      for (Index v : surface_.face(f)) classes.push_back(class_of_[v]);
      std::uint64_t hash = 0;
      std::sort(classes.begin(), classes.end());
      classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
      if (classes.size() < 3) continue;  // collapsed: it lies in an edge or a point of its neighbours anyway
      for (Index c : classes) hash = mixed(hash + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(c + 1));
      const Index other =
          table.find_or_add(hash, static_cast<Index>(f), [&](Index g) { return corner_classes(g) == classes; });
      if (other < 0) continue;
      if (coincident_set_[other] < 0) coincident_set_[other] = sets++;
      coincident_set_[f] = coincident_set_[other];
    }
  }

  bool coincide(Index f, Index g) const {
    return f != g && coincident_set_[f] >= 0 && coincident_set_[f] == coincident_set_[g];
  }

  /// Sorts the boundary edges by place, and in a place by face.
  void group_edges() {
    std::vector<Index> begin(surface_.vertex_count() + 1, 0);
    const auto key = [&](const BoundaryEdge& e) {
      const Index a = class_of_[e.from], b = class_of_[e.to];
      return e.forward ? std::pair(a, b) : std::pair(b, a);
    };
    for (const BoundaryEdge& e : edges_) ++begin[key(e).first + 1];
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    std::vector<BoundaryEdge> sorted(edges_.size());
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    for (const BoundaryEdge& e : edges_) sorted[next[key(e).first]++] = e;
    edges_ = std::move(sorted);
    for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
      const auto first = edges_.begin() + begin[c], last = edges_.begin() + begin[c + 1];
      std::sort(first, last, [&](const BoundaryEdge& a, const BoundaryEdge& b) {
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

  void glue(Index i, Index j) {
    const BoundaryEdge &a = edges_[i], &b = edges_[j];
    const bool same = a.forward == b.forward;
    glued_.unite(a.from, same ? b.from : b.to);
    glued_.unite(a.to, same ? b.to : b.from);
    shells_.unite(a.from, b.from);
  }

  bool are_partners(Index i, Index j) const {
    return edges_[i].forward != edges_[j].forward && !coincide(edges_[i].face, edges_[j].face);
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
        if (coincide(edges_[edges[i]].face, edges_[edges[j]].face)) return true;
    return false;
  }

  /// Glues the edges if it is clear which belong together.
  bool settle(const std::vector<Index>& edges) {
    if (edges.size() < 2) return false;
    if (edges.size() == 2) {  // two sheets with inconsistent orientation have a seam too
      if (coincide(edges_[edges[0]].face, edges_[edges[1]].face)) return false;
      glue(edges[0], edges[1]);
      return true;
    }
    if (edges.size() > max_edges_to_pair || edges.size() % 2 != 0) return false;
    std::vector<Index> left = edges;
    std::vector<std::pair<Index, Index>> way, pairs;
    if (count_pairings(left, way, pairs) != 1) return false;
    for (const auto& [i, j] : pairs) glue(i, j);
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

  /// No pairing is clear: glue all that stay clear of coincident faces, in the order of the faces.
  void glue_together(Index begin, Index end) {
    std::size_t open = 0;
    for (Index e = begin; e < end; ++e) open += settled_[e] == 0;
    if (open == 0) return;
    const bool whole_group = open % 2 == 1;  // one sheet ends on a seam of others: it belongs to them
    std::vector<std::vector<Index>> clusters;
    for (Index e = begin; e < end; ++e) {
      if (settled_[e] && !whole_group) continue;
      const auto fits = [&](const std::vector<Index>& cluster) {
        return std::none_of(cluster.begin(), cluster.end(),
                            [&](Index other) { return coincide(edges_[e].face, edges_[other].face); });
      };
      const auto cluster = std::find_if(clusters.begin(), clusters.end(), fits);
      if (cluster == clusters.end()) {
        clusters.push_back({e});
      } else {
        glue(cluster->front(), e);
        cluster->push_back(e);
      }
    }
  }

  void glue_edges() {
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
    for (const auto& [begin, end] : open) glue_together(begin, end);
  }

  struct CoincidentCorner {
    Index set, face;
    friend auto operator<=>(const CoincidentCorner&, const CoincidentCorner&) = default;
  };

  /// Step (c).
  void glue_vertices() {
    for (std::size_t f = 0; f < surface_.face_count(); ++f)
      if (coincident_set_[f] >= 0)
        for (Index v : surface_.face(f)) coincident_at_.push_back({v, {coincident_set_[f], static_cast<Index>(f)}});
    std::sort(coincident_at_.begin(), coincident_at_.end());
    // The inner ends of edges without length are left to step (d), which tells pinches apart.
    std::vector<std::uint8_t> chosen(surface_.vertex_count(), 1);
    for_each_side([&](Index, Index a, Index b) {
      if (a == b || class_of_[a] != class_of_[b]) return;
      for (Index v : {a, b}) chosen[v] = on_boundary_[v];
    });
    glue_equal_vertices(chosen, [&](Index v) { return shells_.find(v); });
  }

  /// Glues the chosen vertices that have equal positions and lie in one group.
  template <class GroupOf>
  void glue_equal_vertices(const std::vector<std::uint8_t>& chosen, GroupOf&& group_of) {
    const std::size_t n = surface_.vertex_count();
    std::vector<Index> begin(n + 1, 0);
    for (std::size_t v = 0; v < n; ++v)
      if (chosen[v]) ++begin[class_of_[v] + 1];
    for (std::size_t c = 0; c < n; ++c) begin[c + 1] += begin[c];
    std::vector<Index> members(static_cast<std::size_t>(begin[n])), next(begin.begin(), begin.end() - 1);
    for (std::size_t v = 0; v < n; ++v)
      if (chosen[v]) members[next[class_of_[v]]++] = static_cast<Index>(v);

    std::vector<std::array<Index, 3>> by_group;  // group, glued vertex, vertex
    for (std::size_t c = 0; c < n; ++c) {
      if (begin[c + 1] - begin[c] < 2) continue;
      by_group.clear();
      for (Index i = begin[c]; i < begin[c + 1]; ++i)
        by_group.push_back({group_of(members[i]), glued_.find(members[i]), members[i]});
      std::sort(by_group.begin(), by_group.end());
      for (auto it = by_group.begin(); it != by_group.end();) {
        auto last = it + 1;
        while (last != by_group.end() && (*last)[0] == (*it)[0]) ++last;
        glue_at_one_place({it, last});
        it = last;
      }
    }
  }

  /// Glues vertices, except where two coincident faces would share the result.
  void glue_at_one_place(std::span<const std::array<Index, 3>> vertices) {
    struct Cluster {
      Index vertex;
      std::vector<CoincidentCorner> faces;
    };
    std::vector<Cluster> clusters;
    for (std::size_t i = 0; i < vertices.size();) {
      Cluster piece{vertices[i][1], {}};
      for (; i < vertices.size() && vertices[i][1] == piece.vertex; ++i) {
        const Index v = vertices[i][2];
        for (auto it = std::lower_bound(coincident_at_.begin(), coincident_at_.end(), v,
                                        [](const auto&entry, Index w) { return entry.first < w; });
             it != coincident_at_.end() && it->first == v; ++it)
          piece.faces.push_back(it->second);
      }
      const auto fits = [&](const Cluster& cluster) {
        for (const CoincidentCorner& a : piece.faces)
          for (const CoincidentCorner& b : cluster.faces)
            if (a.set == b.set && a.face != b.face) return false;
        return true;
      };
      const auto cluster = std::find_if(clusters.begin(), clusters.end(), fits);
      if (cluster == clusters.end()) {
        clusters.push_back(std::move(piece));
      } else {
        glued_.unite(cluster->vertex, piece.vertex);
        cluster->faces.insert(cluster->faces.end(), piece.faces.begin(), piece.faces.end());
      }
    }
  }

  /// Step (d). Pieces of the surface that lie in one point are told from pinches by their Euler characteristic.
  void glue_collapsed_edges() {
    std::vector<Edge> collapsed;  // of glued vertices
    for_each_side([&](Index, Index a, Index b) {
      if (class_of_[a] != class_of_[b]) return;
      a = glued_.find(a);
      b = glued_.find(b);
      if (a != b) collapsed.push_back({std::min(a, b), std::max(a, b)});
    });
    if (collapsed.empty()) return;
    std::sort(collapsed.begin(), collapsed.end());
    collapsed.erase(std::unique(collapsed.begin(), collapsed.end()), collapsed.end());

    const std::size_t n = surface_.vertex_count();
    UnionFind pieces(n);
    std::vector<Index> euler(n, 0);  // by root of the piece
    std::vector<std::uint8_t> in_piece(n, 0);
    for (const Edge& e : collapsed) {
      pieces.unite(e[0], e[1]);
      in_piece[e[0]] = in_piece[e[1]] = 1;
    }
    for (std::size_t v = 0; v < n; ++v)
      if (in_piece[v]) ++euler[pieces.find(static_cast<Index>(v))];
    for (const Edge& e : collapsed) --euler[pieces.find(e[0])];
    std::vector<Index> corners;
    for (std::size_t f = 0; f < surface_.face_count(); ++f) {
      corners.clear();
      for (Index v : surface_.face(f)) corners.push_back(glued_.find(v));
      if (corners.empty() || !in_piece[corners[0]]) continue;
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      const Index piece = pieces.find(corners[0]);
      const bool inside = std::all_of(corners.begin(), corners.end(), [&](Index v) { return pieces.find(v) == piece; });
      if (inside && corners.size() > 2) ++euler[piece];
    }
    // Pieces that would bring two coincident faces together stay as they are.
    struct Corner {
      Index piece, set, vertex;
      auto operator<=>(const Corner&) const = default;
    };
    std::vector<Corner> coincident;
    for (const auto& [v, corner] : coincident_at_) {
      const Index vertex = glued_.find(v);
      if (in_piece[vertex]) coincident.push_back({pieces.find(vertex), corner.set, vertex});
    }
    std::sort(coincident.begin(), coincident.end());
    for (std::size_t i = 1; i < coincident.size(); ++i) {
      const Corner &a = coincident[i - 1], &b = coincident[i];
      if (a.piece == b.piece && a.set == b.set && a.vertex != b.vertex) euler[a.piece] = 0;
    }
    for (const Edge& e : collapsed)
      if (euler[pieces.find(e[0])] == 1) glued_.unite(e[0], e[1]);
  }

  /// No vertex has two faces: the ids say nothing about what is connected.
  bool is_soup() const {
    std::vector<Index> face_of(surface_.vertex_count(), -1);
    for (std::size_t f = 0; f < surface_.face_count(); ++f)
      for (Index v : surface_.face(f)) {
        if (face_of[v] >= 0 && face_of[v] != static_cast<Index>(f)) return false;
        face_of[v] = static_cast<Index>(f);
      }
    return true;
  }

  /// Step (e).
  void glue_open_vertices() {
    std::vector<std::uint8_t> open(surface_.vertex_count(), 0);
    for_each_open_side([&](Index v) { return glued_.find(v); },
                       [&](const Side& side) { open[glued_.find(side.from)] = open[glued_.find(side.to)] = 1; });
    for (std::size_t v = 0; v < open.size(); ++v) open[v] = open[glued_.find(static_cast<Index>(v))];
    glue_equal_vertices(open, [](Index) { return Index{0}; });
  }

  const SurfaceView& surface_;
  std::vector<Index> class_of_;
  UnionFind shells_, glued_;
  std::vector<std::uint8_t> on_boundary_;  // by vertex
  std::vector<BoundaryEdge> edges_;
  std::vector<Index> coincident_set_;                              // by face; -1 where no other face has equal corners
  std::vector<std::pair<Index, CoincidentCorner>> coincident_at_;  // by vertex, sorted; nearly always empty
  std::vector<std::array<Index, 2>> groups_;                       // [begin, end) of edges at one place, two or more
  std::vector<std::uint8_t> settled_;                              // by edge
};

Identification from_classes(std::vector<Index> vertex_of) {
  Identification result;
  for (std::size_t v = 0; v < vertex_of.size(); ++v)
    if (vertex_of[v] == static_cast<Index>(result.first.size())) result.first.push_back(static_cast<Index>(v));
  result.count = static_cast<Index>(result.first.size());
  result.merged = vertex_of.size() - result.first.size();
  result.vertex_of = std::move(vertex_of);
  return result;
}

}  // namespace

std::vector<Index> position_classes(std::span<const double> positions, double tolerance) {
  return tolerance > 0 ? tolerant_classes(positions, tolerance) : exact_classes(positions);
}

Identification identify(const SurfaceView& surface, Weld weld, double tolerance) {
  const std::size_t n = surface.vertex_count();
  switch (weld) {
    case Weld::none: {
      std::vector<Index> own(n);
      std::iota(own.begin(), own.end(), Index{0});
      return from_classes(std::move(own));
    }
    case Weld::all:
      return from_classes(position_classes(surface.positions, tolerance));
    case Weld::seams:
      break;
  }
  UnionFind glued = SeamGluing(surface, position_classes(surface.positions, tolerance)).run();
  return from_classes(dense(glued, n));
}

void require_valid(const SurfaceView& surface) {
  if (surface.positions.size() % 3 != 0)
    throw std::invalid_argument("positions hold " + std::to_string(surface.positions.size()) +
                                " numbers, which is no multiple of 3: give x, y, z of each vertex");
  for (std::size_t i = 0; i < surface.positions.size(); ++i)
    if (!std::isfinite(surface.positions[i]))
      throw std::invalid_argument("vertex " + std::to_string(i / 3) + " has a coordinate that is not a finite number");
  const std::size_t n = surface.vertex_count();
  if (surface.offsets.empty()) {
    if (surface.corners.size() % 3 != 0)
      throw std::invalid_argument("there are " + std::to_string(surface.corners.size()) +
                                  " corners of triangles, which is no multiple of 3: give offsets for polygons");
  } else {
    if (surface.offsets.front() != 0 || static_cast<std::size_t>(surface.offsets.back()) != surface.corners.size())
      throw std::invalid_argument("the offsets of the faces run from " + std::to_string(surface.offsets.front()) +
                                  " to " + std::to_string(surface.offsets.back()) + ", but there are " +
                                  std::to_string(surface.corners.size()) + " corners");
    for (std::size_t f = 0; f + 1 < surface.offsets.size(); ++f)
      if (surface.offsets[f + 1] < surface.offsets[f])
        throw std::invalid_argument("the offsets of face " + std::to_string(f) + " decrease");
  }
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    for (Index v : surface.face(f))
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        throw std::invalid_argument("face " + std::to_string(f) + " uses vertex " + std::to_string(v) +
                                    ", but there are " + std::to_string(n) + " vertices (counted from 0)");
}

}  // namespace unsnarl
