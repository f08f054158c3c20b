#include "contact/sheet_gaps.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <utility>

#include "contact/face_tree.h"
#include "contact/smallest_gap.h"
#include "contact/stop_check.h"
#include "geometry/box.h"
#include "geometry/parallel.h"
#include "geometry/parallel_lists.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// Boxes and projections exclude what is farther than a distance by this: less may be due to rounding, and of equal
/// gaps the same one must be found in any order (unit: largest coordinate)
constexpr double search_rounding = 0x1p-44;

bool is_before(const SheetGap& a, const SheetGap& b) {
  return std::tie(a.distance, a.first, a.second) < std::tie(b.distance, b.first, b.second);
}

/// A ball around a triangle.
struct Round {
  Vec3 middle;
  double radius;
};

Round round_of(const Positions& x, const Triangle& t) {
  const Vec3 middle = (x.col(t[0]) + x.col(t[1]) + x.col(t[2])) / 3;
  return {middle,
          std::max({(x.col(t[0]) - middle).norm(), (x.col(t[1]) - middle).norm(), (x.col(t[2]) - middle).norm()})};
}

Vec3 middle_of(const Stencil& s, const Closest& at, const Positions& x) {
  const int firsts = s.kind == StencilKind::edge_edge ? 2 : 1;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < s.size(); ++i) sum += (i < firsts ? 0.5 : -0.5) * at.weights[i] * x.col(s.v[i]);
  return sum;
}

}  // namespace

bool OneSheet::holds(const Stencil& stencil, Index of_first, Index of_second) {
  if (ways_.from() != of_first) ways_.start(of_first);
  const Closest at = closest(stencil, rest_);
  return ways_.joins(of_second, middle_of(stencil, at, rest_),
                     std::max(one_sheet_gaps * wanted_, one_sheet_distances * at.distance));
}

bool OneSheet::holds_for_all(Index first, Index second) {
  if (ways_.from() != first) ways_.start(first);
  const Round a = round_of(rest_, triangles_[first]), b = round_of(rest_, triangles_[second]);
  // The middle between primitives that are d apart is at most a.radius + d / 2 from that of the first triangle. A ball
  // around the latter that all their balls hold has max(gap, 4 d) - (a.radius + d / 2), least where gap = 4 d.
  const double least = (a.middle - b.middle).norm() - a.radius - b.radius;
  const double ratio = 1 - 0.5 / one_sheet_distances;
  return ways_.reaches(second, ratio * std::max(one_sheet_gaps * wanted_, one_sheet_distances * least) - a.radius);
}

/// Looks for the gaps of one triangle after the other, by one thread.
class SheetGaps::Search {
 public:
  Search(const SheetGaps& gaps, const Positions& x, const FaceTree& tree)
      : gaps_(gaps),
        x_(x),
        tree_(tree),
        one_sheet_(gaps.triangles_, gaps.rest_, gaps.candidates_.edges(), gaps.options_.wanted),
        rounding_(search_rounding * x.cwiseAbs().maxCoeff()) {}

  /// The smallest gap of s that is at most `limit`. `from`: only with triangles from this one on.
  SheetGap of(Index s, Index from, double limit) {
    const std::span<const Triangle> triangles = gaps_.triangles_;
    near_.clear();
    tree_.query(box_of(x_, triangles[s]).inflated(limit + rounding_), [&](Index t) {
      if (t >= from && t != s && !share_a_vertex(triangles[s], triangles[t]) && !is_surely_of_one_sheet(s, t) &&
          !are_apart(x_, triangles[s], triangles[t], limit + rounding_))
        add_near(s, t, limit);
    });
    std::sort(near_.begin(), near_.end());
    for (const Near& near : near_)
      if (!is_of_one_sheet(near.stencil, s, near.other) &&
          (!gaps_.options_.counts || gaps_.options_.counts(s, near.other)))
        return {near.distance, std::min(s, near.other), std::max(s, near.other),
                middle_of(near.stencil, closest(near.stencil, x_), x_)};
    return {};
  }

 private:
  struct Near {
    double distance;
    Index other;  // triangle
    int number;   // of the stencil among those of the two triangles
    Stencil stencil;
    bool operator<(const Near& n) const {
      return std::tie(distance, other, number) < std::tie(n.distance, n.other, n.number);
    }
  };

  bool are_of_one_piece(Index s, Index t) const {
    return gaps_.piece_of_[gaps_.triangles_[s][0]] == gaps_.piece_of_[gaps_.triangles_[t][0]];
  }
  bool is_surely_of_one_sheet(Index s, Index t) { return are_of_one_piece(s, t) && one_sheet_.holds_for_all(s, t); }
  bool is_of_one_sheet(const Stencil& stencil, Index s, Index t) {
    if (!are_of_one_piece(s, t)) return false;
    return gaps_.candidates_.are_neighbours(stencil) || one_sheet_.holds(stencil, s, t);
  }

  /// Lists the primitives of both that are at most `limit` apart.
  void add_near(Index s, Index t, double limit) {
    const Triangle &a = gaps_.triangles_[s], &b = gaps_.triangles_[t];
    const auto& edges = gaps_.candidates_.edges().edges_of_triangle;
    int number = 0;
    const auto add = [&](const Stencil& stencil) {
      const double distance = closest(stencil, x_).distance;
      if (distance <= limit) near_.push_back({distance, t, number, stencil});
      ++number;
    };
    for (int i = 0; i < 3; ++i) {
      add({StencilKind::vertex_face, {a[i], b[0], b[1], b[2]}, {a[i], t}});
      add({StencilKind::vertex_face, {b[i], a[0], a[1], a[2]}, {b[i], s}});
      for (int j = 0; j < 3 && edges[s][i] >= 0; ++j)
        if (edges[t][j] >= 0)
          add({StencilKind::edge_edge, {a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]}, {edges[s][i], edges[t][j]}});
    }
  }

  const SheetGaps& gaps_;
  const Positions& x_;
  const FaceTree& tree_;
  OneSheet one_sheet_;
  double rounding_;
  std::vector<Near> near_;  // of the last triangle
};

SheetGaps::SheetGaps(std::span<const Triangle> triangles, const Positions& rest, Options options)
    : triangles_(triangles),
      rest_(rest),
      options_(std::move(options)),
      candidates_(triangles, static_cast<Index>(rest.cols())),
      piece_of_(static_cast<std::size_t>(rest.cols())) {
  UnionFind pieces(rest.cols());
  for (const Edge& edge : candidates_.edges().edges) pieces.unite(edge[0], edge[1]);
  for (std::size_t v = 0; v < piece_of_.size(); ++v)
    piece_of_[v] = static_cast<Index>(pieces.find(static_cast<Index>(v)));
}

SheetGap SheetGaps::smallest(const Positions& x, double below) const {
  FaceTree tree(triangles_);
  tree.update(x);
  PerThread<Search> searches([&] { return Search(*this, x, tree); });
  std::atomic<double> limit{below};
  std::vector<SheetGap> found;
  gather_in_chunks(static_cast<Index>(triangles_.size()), found, [&](Index begin, Index end, auto& list) {
    if (options_.stop && options_.stop()) throw WorkStopped();
    Search& search = searches.local();
    for (Index s = begin; s < end; ++s) {
      const SheetGap gap = search.of(s, s + 1, limit);
      if (gap.first < 0) continue;
      list.push_back(gap);
      for (double now = limit; gap.distance < now && !limit.compare_exchange_weak(now, gap.distance);) {
      }
    }
    if (list.empty()) return;
    list = {*std::min_element(list.begin(), list.end(), is_before)};
  });
  std::erase_if(found, [&](const SheetGap& gap) { return !(gap.distance < below); });
  return found.empty() ? SheetGap{} : *std::min_element(found.begin(), found.end(), is_before);
}

std::vector<SheetGap> SheetGaps::narrow(const Positions& x, double below) const {
  FaceTree tree(triangles_);
  tree.update(x);
  PerThread<Search> searches([&] { return Search(*this, x, tree); });
  std::vector<SheetGap> found;
  gather_in_chunks(static_cast<Index>(triangles_.size()), found, [&](Index begin, Index end, auto& list) {
    if (options_.stop && options_.stop()) throw WorkStopped();
    Search& search = searches.local();
    for (Index s = begin; s < end; ++s)
      if (const SheetGap gap = search.of(s, 0, below); gap.first >= 0 && gap.distance < below) list.push_back(gap);
  });
  return found;
}

}  // namespace unsnarl
