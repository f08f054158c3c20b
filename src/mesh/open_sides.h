#pragma once

#include <algorithm>
#include <vector>

#include "geometry/types.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Calls visit(face, from, to) for the sides of all faces, in their order.
template <class Visit>
void for_each_side(const SurfaceView& surface, Visit&& visit) {
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto corners = surface.face(f);
    for (std::size_t k = 0; k < corners.size(); ++k)
      visit(static_cast<Index>(f), corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
  }
}

/// A side of a face that no other face uses.
struct OpenSide {
  Index face;
  Index from, to;  ///< vertices, in the order of the face
};

/// Sides whose pair of vertices, after renaming, occurs once in the whole surface. Sides with both ends at one vertex
/// are left out.
template <class Rename>
std::vector<OpenSide> open_sides(const SurfaceView& surface, Rename&& rename) {
  struct Side {
    Index larger, face, from, to;
  };
  const std::size_t n = surface.vertex_count();
  std::vector<Index> begin(n + 1, 0);
  for_each_side(surface, [&](Index, Index from, Index to) {
    const Index a = rename(from), b = rename(to);
    if (a != b) ++begin[std::min(a, b) + 1];
  });
  for (std::size_t v = 0; v < n; ++v) begin[v + 1] += begin[v];
  std::vector<Side> sides(static_cast<std::size_t>(begin[n]));
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  for_each_side(surface, [&](Index f, Index from, Index to) {
    const Index a = rename(from), b = rename(to);
    if (a != b) sides[next[std::min(a, b)]++] = {std::max(a, b), f, from, to};
  });
  std::vector<OpenSide> open;
  for (std::size_t v = 0; v < n; ++v) {
    const auto first = sides.begin() + begin[v], last = sides.begin() + begin[v + 1];
    std::stable_sort(first, last, [](const Side& s, const Side& t) { return s.larger < t.larger; });
    for (auto it = first; it != last;) {
      auto end = it + 1;
      while (end != last && end->larger == it->larger) ++end;
      if (end - it == 1) open.push_back({it->face, it->from, it->to});
      it = end;
    }
  }
  return open;
}

}  // namespace unsnarl
