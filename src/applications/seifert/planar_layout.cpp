#include "applications/seifert/planar_layout.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>
#include <numbers>

#include "geometry/portable_math.h"
#include "geometry/types.h"
#include "mesh/union_find.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

using Points2 = Eigen::Matrix2Xd;
using Vec2 = Eigen::Vector2d;

/// Points of the polygon between two nodes of the drawing (unit: points)
constexpr int points_a_piece = 4;
/// Strands rise above or sink below the plane by this where they cross (unit: length of the pieces there)
constexpr double rise_of_piece = 0.5;
/// Radius of the outer polygon for each node on it, so that pieces come out about 1 long (unit: length)
constexpr double radius_a_node = 0.25;

/// The diagram as a graph: crossings, and two nodes on every edge, so that no two pieces join the same nodes.
class Diagram {
 public:
  explicit Diagram(const PlanarCode& code) : code_(code), crossings_(static_cast<int>(code.size())) {
    count_edges();
    choose_ends();
    follow_faces();
  }

  Link link() {
    draw();
    Link link;
    std::vector<bool> seen(edges_ + 1, false);
    for (int start = 1; start <= edges_; ++start) {
      if (seen[start]) continue;
      std::vector<Vec3> nodes;  // of the component, with heights
      for (int e = start; !seen[e]; e = next_[e]) {
        seen[e] = true;
        const auto [crossing, over] = from_[e];
        const Vec2 at = place_.col(crossing), first = place_.col(near_start(e)), last = place_.col(near_end(e));
        const double rise = rise_of_piece * shortest_[crossing] * (over ? 1 : -1);
        nodes.emplace_back(at.x(), at.y(), rise);
        nodes.emplace_back(first.x(), first.y(), 0);
        nodes.emplace_back(last.x(), last.y(), 0);
      }
      std::vector<double>& p = link.components.emplace_back();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Vec3 &a = nodes[k], &b = nodes[(k + 1) % nodes.size()];
        for (int i = 0; i < points_a_piece; ++i) {
          // No point in the crossing itself: the other strand has one there too.
          const double t = (i + 0.5) / points_a_piece, s = t * t * (3 - 2 * t);  // level at both ends
          const Vec3 q((1 - t) * a.x() + t * b.x(), (1 - t) * a.y() + t * b.y(), (1 - s) * a.z() + s * b.z());
          p.insert(p.end(), {q.x(), q.y(), q.z()});
        }
      }
    }
    return link;
  }

 private:
  struct Side {
    int crossing = 0, corner = 0;
  };

  [[noreturn]] static void refuse(const std::string& what) { throw FileError("planar diagram code: " + what); }

  void count_edges() {
    edges_ = 2 * crossings_;
    sides_.resize(edges_ + 1);
    for (int c = 0; c < crossings_; ++c)
      for (int k = 0; k < 4; ++k) {
        const int e = code_[c][k];
        if (e < 1 || e > edges_)
          refuse(fmt::format("crossing {} has an edge {}; {} crossings have the edges 1 to {}", c + 1, e, crossings_,
                             edges_));
        sides_[e].push_back({c, k});
      }
    for (int e = 1; e <= edges_; ++e)
      if (sides_[e].size() != 2) refuse(fmt::format("edge {} stands {} times, not twice", e, sides_[e].size()));
  }

  /// The strand below runs from the first edge to the third; that above from the second to the fourth, or back, by the
  /// numbers along its component, which go up by one but for one step.
  void choose_ends() {
    next_.assign(edges_ + 1, 0);
    from_.assign(edges_ + 1, {-1, false});
    for (int c = 0; c < crossings_; ++c) lead(c, code_[c][0], code_[c][2], false);
    for (int c = 0; c < crossings_; ++c) {
      const int b = code_[c][1], d = code_[c][3];
      // Two edges that are the whole of a component are told apart by the strand below that they are part of.
      bool forward = d == b + 1 || (b > d && b - d != 1);
      if (next_[b] != 0) forward = false;
      if (next_[d] != 0) forward = true;
      if (from_[d].first >= 0) forward = false;
      if (from_[b].first >= 0) forward = true;
      lead(c, forward ? b : d, forward ? d : b, true);
    }
    for (int e = 1; e <= edges_; ++e)
      if (next_[e] == 0 || from_[e].first < 0)
        refuse(fmt::format("edge {} does not lead from one crossing to another", e));
  }

  void lead(int crossing, int from, int to, bool over) {
    if (next_[from] != 0 || from_[to].first >= 0)
      refuse(fmt::format("crossing {}: the edges {} and {} run against each other", crossing + 1, from, to));
    next_[from] = to;
    from_[to] = {crossing, over};
  }

  int near_start(int e) const { return crossings_ + 2 * (e - 1); }
  int near_end(int e) const { return near_start(e) + 1; }
  /// The side at which an edge leaves its first crossing, and the one at which it arrives.
  bool leaves(const Side& side) const {
    const int e = code_[side.crossing][side.corner];
    const auto [crossing, over] = from_[e];
    if (crossing != side.crossing) return false;
    return over ? side.corner % 2 == 1 && next_[code_[crossing][(side.corner + 2) % 4]] == e && !is_second_visit(side)
                : side.corner == 2;
  }
  /// An edge from a crossing to itself: its other end there.
  bool is_second_visit(const Side& side) const {
    const int e = code_[side.crossing][side.corner];
    return sides_[e][0].crossing == sides_[e][1].crossing && next_[e] == code_[side.crossing][(side.corner + 2) % 4] &&
           from_[next_[e]].first == side.crossing && !from_[e].second;
  }
  int node_at(const Side& side) const {
    const int e = code_[side.crossing][side.corner];
    return leaves(side) ? near_start(e) : near_end(e);
  }

  /// Nodes around every face of the drawing.
  void follow_faces() {
    std::vector<bool> seen(4 * crossings_, false);
    for (int start = 0; start < 4 * crossings_; ++start) {
      if (seen[start]) continue;
      std::vector<int>& face = faces_.emplace_back();
      Side at{start / 4, start % 4};
      while (!seen[4 * at.crossing + at.corner]) {
        seen[4 * at.crossing + at.corner] = true;
        const int e = code_[at.crossing][at.corner];
        face.push_back(at.crossing);
        face.push_back(node_at(at));
        const Side& first = sides_[e][0];
        const bool is_first = first.crossing == at.crossing && first.corner == at.corner;
        const Side other = is_first ? sides_[e][1] : first;
        face.push_back(node_at(other));
        at = {other.crossing, (other.corner + 3) % 4};
      }
    }
    UnionFind parts(crossings_);
    for (int e = 1; e <= edges_; ++e) parts.unite(sides_[e][0].crossing, sides_[e][1].crossing);
    int pieces = 0;
    for (int c = 0; c < crossings_; ++c) pieces += parts.find(c) == c;
    if (pieces > 1) refuse(fmt::format("it falls into {} diagrams; lay them out one by one", pieces));
    if (crossings_ - edges_ + static_cast<int>(faces_.size()) != 2)
      refuse(fmt::format("it has {} faces, not {}: no diagram in the plane has it", faces_.size(),
                         edges_ - crossings_ + 2));
  }

  /// W. T. Tutte, "How to Draw a Graph", 1963: the longest face is outside, evenly around a circle; every other node is
  /// at the mean of its neighbours. An additional node in each face, joined to all nodes around it, makes the graph
  /// 3-connected, so that no two nodes coincide. These nodes have a larger weight, which keeps faces open. In a face
  /// that comes to a node twice, as beside a crossing that a twist removes, a ring of nodes of its own lies between.
  void draw() {
    const auto outer = std::max_element(faces_.begin(), faces_.end(),
                                        [](const auto& f, const auto& g) { return f.size() < g.size(); }) -
                       faces_.begin();
    const int nodes = crossings_ + 2 * edges_;
    int all = nodes + static_cast<int>(faces_.size());
    std::vector<std::vector<int>> rings = faces_;  // around the additional node of each face
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      std::vector<int> sorted = faces_[f];
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) continue;
      for (int& v : rings[f]) v = all++;
    }
    place_ = Points2::Zero(2, all);
    std::vector<int> unknown(all, -1);
    std::vector<bool> is_fixed(all, false);
    const std::vector<int>& rim = rings[outer];
    for (std::size_t k = 0; k < rim.size(); ++k) {
      // Faces are followed counter-clockwise from inside, so that the outer one runs clockwise around the rest.
      const double angle = -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(rim.size());
      place_.col(rim[k]) =
          radius_a_node * static_cast<double>(rim.size()) * Vec2(portable::cos(angle), portable::sin(angle));
      is_fixed[rim[k]] = true;
    }
    is_fixed[nodes + outer] = true;
    int count = 0;
    for (int v = 0; v < all; ++v)
      if (!is_fixed[v]) unknown[v] = count++;
    std::vector<Eigen::Triplet<double>> terms;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
    const auto join = [&](int a, int b) {
      for (const auto& [v, w] : {std::pair(a, b), std::pair(b, a)}) {
        if (unknown[v] < 0) continue;
        terms.emplace_back(unknown[v], unknown[v], 1);
        if (unknown[w] >= 0)
          terms.emplace_back(unknown[v], unknown[w], -1);
        else
          right.row(unknown[v]) += place_.col(w).transpose();
      }
    };
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const std::size_t n = faces_[f].size();
      for (std::size_t k = 0; k < n; ++k) {
        const int v = faces_[f][k], next = faces_[f][(k + 1) % n], on_ring = rings[f][k];
        join(v, next);
        if (on_ring != v) {
          join(on_ring, v);
          join(on_ring, next);
          join(on_ring, rings[f][(k + 1) % n]);
        }
        if (static_cast<std::ptrdiff_t>(f) != outer) join(on_ring, nodes + static_cast<int>(f));
      }
    }
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(terms.begin(), terms.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::MatrixX2d solution = solver.solve(right);
    for (int v = 0; v < all; ++v)
      if (unknown[v] >= 0) place_.col(v) = solution.row(unknown[v]).transpose();
    shortest_.assign(crossings_, std::numeric_limits<double>::infinity());
    for (int c = 0; c < crossings_; ++c)
      for (int k = 0; k < 4; ++k)
        shortest_[c] = std::min(shortest_[c], (place_.col(node_at({c, k})) - place_.col(c)).norm());
  }

  const PlanarCode& code_;
  const int crossings_;
  int edges_ = 0;
  std::vector<std::vector<Side>> sides_;    // of each edge: two
  std::vector<int> next_;                   // edge after each edge
  std::vector<std::pair<int, bool>> from_;  // crossing that each edge leaves, and whether above
  std::vector<std::vector<int>> faces_;
  Points2 place_;
  std::vector<double> shortest_;  // piece at each crossing
};

}  // namespace

Link lay_out(const PlanarCode& code) {
  return Diagram(code).link();
}

}  // namespace unsnarl
