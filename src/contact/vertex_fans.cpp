#include "contact/vertex_fans.h"

#include <algorithm>
#include <cmath>

#include "geometry/parallel_sums.h"
#include "geometry/predicates.h"

namespace unsnarl {
namespace {

/// A task of a parallel loop has this many vertices (unit: vertices)
constexpr Index vertices_a_task = 1024;
/// Larger fans are decided pair by pair: ordering a fan costs the square of its size (unit: triangles)
constexpr std::size_t most_triangles = 16;
/// Marks a vertex along whose axes its fan is folded; axes are 0, 1, 2 (fixed by three dimensions)
constexpr std::uint8_t no_axis = 3;

/// Appends the neighbours of v in the order of the triangles around it; nothing where these are no single fan.
void append_fan(std::span<const Triangle> triangles, std::span<const Index> at, Index v, std::vector<Index>& around) {
  std::array<Edge, most_triangles> links;  // the edges opposite v, directed
  if (at.empty() || at.size() > most_triangles) return;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Triangle& t = triangles[at[i]];
    const int k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    links[i] = {t[(k + 1) % 3], t[(k + 2) % 3]};
    if (links[i][0] == v || links[i][1] == v || links[i][0] == links[i][1]) return;
    for (std::size_t j = 0; j < i; ++j)
      if (links[j][0] == links[i][0] || links[j][1] == links[i][1]) return;  // three at an edge, or turned
  }
  // Where the fan is open, it begins at the link that follows no other.
  const auto count = static_cast<std::ptrdiff_t>(at.size());
  const auto link_from = [&](Index u) {
    return std::find_if(links.begin(), links.begin() + count, [u](const Edge& link) { return link[0] == u; });
  };
  Index first = links[0][0];
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const bool follows =
        std::any_of(links.begin(), links.begin() + count, [&](const Edge& link) { return link[1] == links[i][0]; });
    if (!follows) first = links[i][0];
  }
  const std::size_t begin = around.size();
  around.push_back(first);
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto next = link_from(around.back());
    if (next == links.begin() + count) break;
    around.push_back((*next)[1]);
    if (around.back() == first) break;
  }
  if (around.size() != begin + at.size() + 1) around.resize(begin);
}

/// Whether the fan of c is unfolded seen along `axis`.
bool is_unfolded_along(int axis, const Positions& x, const Vec3& c, std::span<const Index> around) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const auto in_upper_half = [&](Index v) { return x(j, v) > c[j] || (x(j, v) == c[j] && x(i, v) > c[i]); };
  const auto turn = [&](Index u, Index v) { return orient2d(x(i, u), x(j, u), x(i, v), x(j, v), c[i], c[j]); };
  // Directions turn by less than half a turn from neighbour to neighbour, all to one side: the changes between the half
  // planes above and below tell how far in all.
  const Sign side = turn(around[0], around[1]);
  if (side == 0) return false;
  int changes = 0;
  bool upper = in_upper_half(around[0]);
  for (std::size_t k = 1; k < around.size(); ++k) {
    if (k > 1 && turn(around[k - 1], around[k]) != side) return false;
    const bool next_upper = in_upper_half(around[k]);
    changes += next_upper != upper;
    upper = next_upper;
  }
  if (around.front() == around.back()) return changes == 2;
  return changes < 2 || (changes == 2 && turn(around.back(), around.front()) == side);
}

}  // namespace

VertexFans::VertexFans(std::span<const Triangle> triangles, Index active_count, Index vertex_count)
    : triangles_at_(triangles_of_vertices(triangles, vertex_count)),
      axis_(static_cast<std::size_t>(vertex_count), no_axis),
      unfolded_(static_cast<std::size_t>(vertex_count), 0) {
  around_.offsets.reserve(static_cast<std::size_t>(vertex_count) + 1);
  around_.items.reserve(triangles_at_.items.size() + triangles_at_.items.size() / 4);
  for (Index v = 0; v < vertex_count; ++v) {
    // Ascending: where the first is none of the active ones, none is.
    if (!triangles_at_[v].empty() && triangles_at_[v].front() < active_count)
      append_fan(triangles, triangles_at_[v], v, around_.items);
    around_.offsets.push_back(static_cast<Index>(around_.items.size()));
  }
}

void VertexFans::update_vertex(const Positions& x, Index v) {
  const std::span<const Index> around = around_[v];
  unfolded_[v] = 0;
  if (around.empty()) return;
  const Vec3 c = x.col(v);
  const int last = axis_[v];
  if (last != no_axis && is_unfolded_along(last, x, c, around)) {
    unfolded_[v] = 1;
    return;
  }
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 1; k < around.size(); ++k)
    normal += (x.col(around[k - 1]) - c).cross(Vec3(x.col(around[k]) - c));
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  if (axis == last) return;
  axis_[v] = static_cast<std::uint8_t>(axis);
  unfolded_[v] = is_unfolded_along(axis, x, c, around);
}

void VertexFans::update(const Positions& x) {
  for_chunks(static_cast<Index>(unfolded_.size()), vertices_a_task, [&](Index begin, Index end) {
    for (Index v = begin; v < end; ++v) update_vertex(x, v);
  });
}

}  // namespace unsnarl
