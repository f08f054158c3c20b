// Baraff, Witkin, Kass: "Untangling Cloth" (2003), §4, global intersection analysis: a closed intersection curve cuts a
// piece out of either sheet. These pieces, found by flood fill, have gone through: one is coloured black, the other
// white, and a vertex of one colour is attracted to the sheet of the other, through it and on to the thickness of the
// cloth, while vertices that have come through are repelled as far. Where one curve lies within another, what both cut
// out is through twice, and so not at all. A curve that ends within a sheet cuts nothing out of it, and has no effect
// on that sheet's vertices. The analysis is made anew in each iteration.
//
// Readings where the paper leaves the choice: where a curve cuts a piece out of one sheet alone, the triangles that it
// runs through stand for the other's; of curves too small to hold a vertex, the nearer ends of the edges count as one.
//
// The method is a part of a cloth simulator; a sheet of springs stands for it. It ends where nothing intersects, or
// where nothing can be coloured. Constants were chosen for the fewest pairs left on ten samples.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "cloth.h"
#include "contact/bvh.h"
#include "contact/bvh_traversal.h"
#include "contact/distances.h"
#include "mesh/adjacency.h"
#include "mesh/areas.h"
#include "peer.h"
#include "untangle/local/contours.h"

namespace unsnarl::peers {
namespace {

struct IntersectionColouringOptions {
  double longest = 0.2;         // of a vertex in an iteration, in mean edges
  double thickness = 0.5;       // how far beyond the other sheet a vertex is drawn, in mean edges
  int sweeps = 5;               // of the springs, an iteration
  std::size_t small_curve = 6;  // crossings of a curve that may hold no vertex because the mesh is too coarse for it
  int most_iterations = 1000;
};

/// A curve on one of its sheets: the edges it crosses and the triangles it runs through.
struct Cut {
  std::vector<Index> edges, triangles;
};

/// The part of a sheet that a curve cuts out: its vertices, and the triangles at these and along the curve.
struct Piece {
  std::vector<Index> vertices, triangles;
};

class IntersectionColouring : public Peer {
 public:
  IntersectionColouring(const Start& start, const IntersectionColouringOptions& options)
      : options_(options),
        triangles_(start.triangles),
        edges_(build_edges(start.triangles)),
        cloth_(start.rest, start.triangles, edges_),
        edge_length_(mean_edge_length(start.rest, start.triangles)),
        is_cut_(edges_.edges.size(), 0),
        region_(start.rest.cols(), -1),
        was_through_(start.rest.cols(), 0),
        every_triangle_(start.triangles.size()) {
    std::iota(every_triangle_.begin(), every_triangle_.end(), 0);
    Box box;
    for (const Triangle& t : start.triangles) box.extend(box_of(start.rest, t));
    diagonal_ = box.diagonal();
    const Index n = static_cast<Index>(start.rest.cols());
    triangles_of_vertex_ = triangles_of_vertices(start.triangles, n);
    std::vector<std::vector<Index>> lists(n);
    for (std::size_t e = 0; e < edges_.edges.size(); ++e)
      for (Index v : edges_.edges[e]) lists[v].push_back(static_cast<Index>(e));
    for (const auto& list : lists) {
      edges_of_vertex_.items.insert(edges_of_vertex_.items.end(), list.begin(), list.end());
      edges_of_vertex_.offsets.push_back(static_cast<Index>(edges_of_vertex_.items.size()));
    }
  }

  bool sees(PairClass kind) const override { return kind == PairClass::disjoint || kind == PairClass::one_vertex; }
  int most_iterations() const override { return options_.most_iterations; }

  bool step(const std::vector<IntersectingPair>& pairs, Positions& x) override {
    const Contours contours = trace_contours(x, triangles_, edges_, pairs);
    std::vector<std::array<Cut, 2>> cuts(contours.count);
    for (const Crossing& crossing : contours.crossings) {
      const bool is_first = crossing.side > 0;
      cuts[crossing.contour][is_first ? 0 : 1].edges.push_back(crossing.edge);
      cuts[crossing.contour][is_first ? 1 : 0].triangles.push_back(crossing.face);
    }
    std::vector<std::array<Piece, 2>> pieces(contours.count);
    std::vector<std::uint8_t> is_through(x.cols(),
                                         0);  // in an odd number of pieces: inside one curve, outside the next
    for (std::size_t c = 0; c < cuts.size(); ++c)
      for (int sheet = 0; sheet < 2; ++sheet) {
        pieces[c][sheet] = cut_out(cuts[c][sheet]);
        for (Index v : pieces[c][sheet].vertices) is_through[v] ^= 1;
      }
    Positions motion = Positions::Zero(3, x.cols());
    Eigen::VectorXd contacts = Eigen::VectorXd::Zero(x.cols());
    bool is_any_coloured = false;
    for (auto& [first, second] : pieces) {
      for (Piece* piece : {&first, &second}) std::erase_if(piece->vertices, [&](Index v) { return !is_through[v]; });
      is_any_coloured |= !first.vertices.empty() || !second.vertices.empty();
      for (const Piece* piece : {&first, &second})
        for (Index v : piece->vertices) was_through_[v] = 1;
      attract(x, first, second, motion, contacts);
      attract(x, second, first, motion, contacts);
    }
    for (const Crossing& crossing : contours.crossings) {
      const auto& [first, second] = pieces[crossing.contour];
      if (!first.vertices.empty() || !second.vertices.empty() ||
          cuts[crossing.contour][0].edges.size() + cuts[crossing.contour][1].edges.size() > options_.small_curve)
        continue;
      is_any_coloured = true;
      attract_end(x, crossing, motion, contacts);
    }
    repel(x, is_through, motion, contacts);
    for (Index v = 0; v < x.cols(); ++v)
      if (contacts[v] > 0) x.col(v) += motion.col(v) / std::max(1.0, contacts[v]);
    cloth_.relax(x, options_.sweeps);
    return is_any_coloured;
  }

 private:
  /// Flood fill from the ends of these edges without crossing them: all regions but the largest; none where there is
  /// only one.
  Piece cut_out(const Cut& cut) {
    for (Index e : cut.edges) is_cut_[e] = 1;
    std::vector<std::vector<Index>> regions;
    for (Index e : cut.edges)
      for (Index seed : edges_.edges[e]) {
        if (region_[seed] >= 0) continue;
        std::vector<Index> filled = {seed};
        const Index number = static_cast<Index>(regions.size());
        region_[seed] = number;
        for (std::size_t k = 0; k < filled.size(); ++k)
          for (Index through : edges_of_vertex_[filled[k]]) {
            if (is_cut_[through]) continue;
            const auto [i, j] = edges_.edges[through];
            const Index w = i == filled[k] ? j : i;
            if (region_[w] >= 0) continue;
            region_[w] = number;
            filled.push_back(w);
          }
        regions.push_back(std::move(filled));
      }
    for (Index e : cut.edges) is_cut_[e] = 0;
    for (const auto& region : regions)
      for (Index v : region) region_[v] = -1;
    Piece piece{{}, cut.triangles};
    const auto largest = std::max_element(regions.begin(), regions.end(),
                                          [](const auto& a, const auto& b) { return a.size() < b.size(); });
    for (auto region = regions.begin(); region != regions.end(); ++region)
      if (region != largest) piece.vertices.insert(piece.vertices.end(), region->begin(), region->end());
    std::sort(piece.vertices.begin(), piece.vertices.end());
    for (Index v : piece.vertices)
      for (Index t : triangles_of_vertex_[v]) piece.triangles.push_back(t);
    std::sort(piece.triangles.begin(), piece.triangles.end());
    piece.triangles.erase(std::unique(piece.triangles.begin(), piece.triangles.end()), piece.triangles.end());
    return piece;
  }

  /// Each vertex of a piece and the nearest point of the other piece are drawn to each other and past.
  void attract(const Positions& x, const Piece& from, const Piece& to, Positions& motion,
               Eigen::VectorXd& contacts) const {
    const double thickness = options_.thickness * edge_length_, longest = options_.longest * edge_length_;
    const Bvh tree = tree_of(x, to.triangles);
    for (Index v : from.vertices) {
      const auto [nearest, face] = nearest_face(x, v, to.triangles, tree, std::numeric_limits<double>::infinity());
      if (face >= 0) add_contact(v, face, nearest, -std::min(nearest.distance + thickness, longest), motion, contacts);
    }
  }

  /// An edge may pierce a face though neither of its ends has gone through: the nearer end is attracted then.
  void attract_end(const Positions& x, const Crossing& crossing, Positions& motion, Eigen::VectorXd& contacts) const {
    const Index v = edges_.edges[crossing.edge][crossing.along < 0.5 ? 0 : 1];
    const Triangle& corners = triangles_[crossing.face];
    const Closest nearest = closest_vertex_face(x.col(v), x.col(corners[0]), x.col(corners[1]), x.col(corners[2]));
    const double by = std::min(nearest.distance + options_.thickness * edge_length_, options_.longest * edge_length_);
    add_contact(v, crossing.face, nearest, -by, motion, contacts);
  }

  /// Vertices that have come through stay away from all else by the thickness.
  void repel(const Positions& x, const std::vector<std::uint8_t>& is_through, Positions& motion,
             Eigen::VectorXd& contacts) const {
    const double thickness = options_.thickness * edge_length_;
    const Bvh tree = tree_of(x, every_triangle_);
    for (Index v = 0; v < x.cols(); ++v) {
      if (!was_through_[v] || is_through[v]) continue;
      const auto [nearest, face] = nearest_face(x, v, every_triangle_, tree, thickness);
      if (face >= 0) add_contact(v, face, nearest, thickness - nearest.distance, motion, contacts);
    }
  }

  /// Moves a vertex and a face apart by a length, negative: towards each other.
  void add_contact(Index v, Index face, const Closest& nearest, double by, Positions& motion,
                   Eigen::VectorXd& contacts) const {
    // The weights are those of the vector from the face to the vertex: 1 for the vertex, negative for the corners.
    double sum = 0;
    for (double weight : nearest.weights) sum += weight * weight;
    const std::array<Index, 4> vertices = {v, triangles_[face][0], triangles_[face][1], triangles_[face][2]};
    for (int k = 0; k < 4; ++k) {
      motion.col(vertices[k]) += nearest.weights[k] / sum * by * nearest.direction;
      contacts[vertices[k]] += std::abs(nearest.weights[k]);
    }
  }

  Bvh tree_of(const Positions& x, const std::vector<Index>& triangles) const {
    std::vector<Box> boxes;
    for (Index t : triangles) boxes.push_back(box_of(x, triangles_[t]));
    return Bvh(boxes);
  }

  /// The triangle of a list that is nearest to a vertex within a reach, none at the vertex or at its neighbours; -1:
  /// there is none.
  std::pair<Closest, Index> nearest_face(const Positions& x, Index v, const std::vector<Index>& triangles,
                                         const Bvh& tree, double farthest) const {
    std::pair<Closest, Index> nearest{{}, -1};
    const Vec3 p = x.col(v);
    double best = farthest;
    // Boxes that grow around the vertex: all that is as near as the box reaches has been seen.
    for (double reach = std::min(farthest, edge_length_); nearest.second < 0 || best > reach; reach *= 2) {
      tree.query(Box{p, p}.inflated(reach), [&](Index k) {
        const Triangle& corners = triangles_[triangles[k]];
        if (is_beside(v, corners)) return;
        const Closest here = closest_vertex_face(p, x.col(corners[0]), x.col(corners[1]), x.col(corners[2]));
        if (here.distance > 0 && here.distance < best) nearest = {here, triangles[k]}, best = here.distance;
      });
      if (reach >= farthest || reach > diagonal_) break;
    }
    return nearest;
  }

  bool is_beside(Index v, const Triangle& corners) const {
    for (Index w : corners) {
      if (w == v) return true;
      for (Index e : edges_of_vertex_[v])
        if (edges_.edges[e][0] == w || edges_.edges[e][1] == w) return true;
    }
    return false;
  }

  IntersectionColouringOptions options_;
  std::span<const Triangle> triangles_;
  EdgeTable edges_;
  Cloth cloth_;
  double edge_length_;
  IndexLists triangles_of_vertex_, edges_of_vertex_;
  std::vector<std::uint8_t> is_cut_;       // of edges, empty between calls of cut_out()
  std::vector<Index> region_;              // of vertices, -1 between calls
  std::vector<std::uint8_t> was_through_;  // vertices that were ever coloured
  std::vector<Index> every_triangle_;
  double diagonal_ = 0;  // of the input, a length
};

}  // namespace

std::unique_ptr<Peer> make_intersection_colouring(const Start& start) {
  return std::make_unique<IntersectionColouring>(start, IntersectionColouringOptions{});
}

}  // namespace unsnarl::peers
