#include "mesh/seam_vertices.h"

#include <algorithm>
#include <array>
#include <compare>
#include <vector>

namespace unsnarl {
namespace {

class SeamVertices {
 public:
  SeamVertices(const SurfaceView& surface, std::span<const Index> class_of, const CoincidentFaces& coincident,
               UnionFind& glued)
      : surface_(surface), class_of_(class_of), coincident_(coincident), glued_(glued) {}

  /// Step (c).
  void glue_within_shells(std::span<const OpenSide> boundary, UnionFind& shells) {
    std::vector<std::uint8_t> on_boundary(surface_.vertex_count(), 0);
    for (const OpenSide& side : boundary) on_boundary[side.from] = on_boundary[side.to] = 1;
    // The inner ends of edges without length are left to step (d), which tells pinches apart.
    std::vector<std::uint8_t> chosen(surface_.vertex_count(), 1);
    for_each_side(surface_, [&](Index, Index a, Index b) {
      if (a == b || class_of_[a] != class_of_[b]) return;
      for (Index v : {a, b}) chosen[v] = on_boundary[v];
    });
    glue_equal_vertices(chosen, [&](Index v) { return shells.find(v); });
  }

  /// Step (d). Pieces of the surface that lie in one point are told from pinches by their Euler characteristic.
  void glue_collapsed_edges() {
    std::vector<Edge> collapsed;  // of glued vertices
    for_each_side(surface_, [&](Index, Index a, Index b) {
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
    for (const CoincidentFaces::Corner& corner : coincident_.corners()) {
      const Index vertex = glued_.find(corner.vertex);
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

  /// Step (e).
  void glue_soup() {
    if (!is_soup()) return;
    std::vector<std::uint8_t> open(surface_.vertex_count(), 0);
    for (const OpenSide& side : open_sides(surface_, [&](Index v) { return glued_.find(v); }))
      open[glued_.find(side.from)] = open[glued_.find(side.to)] = 1;
    for (std::size_t v = 0; v < open.size(); ++v) open[v] = open[glued_.find(static_cast<Index>(v))];
    glue_equal_vertices(open, [](Index) { return Index{0}; });
  }

 private:
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
      std::vector<CoincidentFaces::Corner> faces;
    };
    std::vector<Cluster> clusters;
    for (std::size_t i = 0; i < vertices.size();) {
      Cluster piece{vertices[i][1], {}};
      for (; i < vertices.size() && vertices[i][1] == piece.vertex; ++i) {
        const Index v = vertices[i][2];
        const auto faces = coincident_.corners_at(v);
        piece.faces.insert(piece.faces.end(), faces.begin(), faces.end());
      }
      const auto fits = [&](const Cluster& cluster) {
        for (const CoincidentFaces::Corner& a : piece.faces)
          for (const CoincidentFaces::Corner& b : cluster.faces)
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

  const SurfaceView& surface_;
  std::span<const Index> class_of_;
  const CoincidentFaces& coincident_;
  UnionFind& glued_;
};

}  // namespace

void glue_seam_vertices(const SurfaceView& surface, std::span<const OpenSide> boundary, std::span<const Index> class_of,
                        const CoincidentFaces& coincident, UnionFind& shells, UnionFind& glued) {
  SeamVertices vertices(surface, class_of, coincident, glued);
  vertices.glue_within_shells(boundary, shells);
  vertices.glue_collapsed_edges();
  vertices.glue_soup();
}

}  // namespace unsnarl
