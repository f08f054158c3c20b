#include "applications/seifert/planar_embedding.h"

#include <algorithm>

namespace unsnarl {
namespace {

using Face = std::vector<int>;

/// What is joined without passing through drawn nodes.
struct Piece {
  std::vector<int> attachments;  // drawn nodes, sorted
  std::vector<int> inner;        // nodes; empty: an edge between both attachments
};

class PlanarDrawing {
 public:
  PlanarDrawing(int nodes, const std::vector<std::array<int, 2>>& edges) : neighbours_(nodes), is_drawn_(nodes, false) {
    for (const auto& [a, b] : edges) {
      neighbours_[a].push_back({b, false});
      neighbours_[b].push_back({a, false});
    }
  }

  std::optional<std::vector<Face>> faces(const Face& cycle) {
    Face closed = cycle;
    closed.push_back(cycle[0]);
    mark(closed);
    faces_ = {cycle, Face(cycle.rbegin(), cycle.rend())};
    while (true) {
      const std::vector<Piece> all = pieces();
      if (all.empty()) return faces_;
      const Piece* best = nullptr;
      int fewest = 0;
      std::size_t place = 0;
      for (const Piece& piece : all) {
        int count = 0;
        std::size_t first = 0;
        for (std::size_t f = faces_.size(); f-- > 0;)
          if (fits(piece, faces_[f])) {
            ++count;
            first = f;
          }
        if (count == 0) return {};
        if (best && count >= fewest) continue;
        best = &piece;
        fewest = count;
        place = first;
      }
      draw(path_through(*best), place);
    }
  }

 private:
  struct Neighbour {
    int node = 0;
    bool is_drawn = false;  // the edge
  };

  void mark(const Face& path) {
    for (std::size_t k = 0; k < path.size(); ++k) {
      is_drawn_[path[k]] = true;
      if (k + 1 == path.size()) break;
      for (const auto& [from, to] : {std::array{path[k], path[k + 1]}, std::array{path[k + 1], path[k]}})
        for (Neighbour& n : neighbours_[from])
          if (n.node == to) n.is_drawn = true;
    }
  }

  std::vector<Piece> pieces() const {
    std::vector<Piece> result;
    std::vector<bool> seen(neighbours_.size(), false);
    for (int v = 0; v < static_cast<int>(neighbours_.size()); ++v) {
      if (is_drawn_[v]) {
        for (const Neighbour& n : neighbours_[v])
          if (!n.is_drawn && is_drawn_[n.node] && v < n.node) result.push_back({{v, n.node}, {}});
        continue;
      }
      if (seen[v]) continue;
      seen[v] = true;
      Piece& piece = result.emplace_back();
      piece.inner = {v};
      for (std::size_t k = 0; k < piece.inner.size(); ++k)
        for (const Neighbour& n : neighbours_[piece.inner[k]])
          if (is_drawn_[n.node]) {
            piece.attachments.push_back(n.node);
          } else if (!seen[n.node]) {
            seen[n.node] = true;
            piece.inner.push_back(n.node);
          }
      std::sort(piece.attachments.begin(), piece.attachments.end());
      piece.attachments.erase(std::unique(piece.attachments.begin(), piece.attachments.end()), piece.attachments.end());
    }
    return result;
  }

  static bool fits(const Piece& piece, const Face& face) {
    return std::all_of(piece.attachments.begin(), piece.attachments.end(),
                       [&](int v) { return std::find(face.begin(), face.end(), v) != face.end(); });
  }

  /// From the first attachment to another one.
  Face path_through(const Piece& piece) const {
    const int start = piece.attachments[0];
    if (piece.inner.empty()) return piece.attachments;
    std::vector<int> before(neighbours_.size(), -1);
    Face queue{start};
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const Neighbour& n : neighbours_[queue[k]]) {
        if (n.is_drawn || before[n.node] >= 0 || n.node == start) continue;
        if (is_drawn_[n.node] && queue[k] == start) continue;  // an edge by itself, of another piece
        if (!is_drawn_[n.node] && queue[k] == start &&
            std::find(piece.inner.begin(), piece.inner.end(), n.node) == piece.inner.end())
          continue;
        before[n.node] = queue[k];
        if (!is_drawn_[n.node]) {
          queue.push_back(n.node);
          continue;
        }
        Face path{n.node};
        while (path.back() != start) path.push_back(before[path.back()]);
        std::reverse(path.begin(), path.end());
        return path;
      }
    return {};  // not reached: a graph that stays connected without any one node has two attachments a piece
  }

  void draw(const Face& path, std::size_t place) {
    mark(path);
    Face face = faces_[place];
    std::rotate(face.begin(), std::find(face.begin(), face.end(), path.front()), face.end());
    const auto end = std::find(face.begin(), face.end(), path.back());
    Face first(face.begin(), end + 1), second(end, face.end());
    first.insert(first.end(), path.rbegin() + 1, path.rend() - 1);
    second.insert(second.end(), path.begin(), path.end() - 1);
    faces_[place] = std::move(first);
    faces_.push_back(std::move(second));
  }

  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<bool> is_drawn_;
  std::vector<Face> faces_;
};

}  // namespace

std::optional<std::vector<std::vector<int>>> planar_faces(int nodes, const std::vector<std::array<int, 2>>& edges,
                                                          const std::vector<int>& cycle) {
  return PlanarDrawing(nodes, edges).faces(cycle);
}

}  // namespace unsnarl
