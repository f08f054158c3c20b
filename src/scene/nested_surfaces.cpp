#include "scene/nested_surfaces.h"

#include <algorithm>

#include "contact/closed_surface.h"
#include "geometry/parallel.h"

namespace unsnarl {

std::vector<Index> vertices_on_the_wrong_side(const NestedSurfaces& nested, const std::array<Index, 2>& pair,
                                              const Positions& x) {
  std::vector<Index> wrong;
  const auto add = [&](Index of, Index against, Side right) {
    ClosedSurface surface(nested.triangles[against]);
    surface.update(x);
    const std::vector<Index>& vertices = nested.vertices[of];
    std::vector<std::uint8_t> is_wrong(vertices.size());
    parallel_for(vertices.size(), [&](std::size_t i) { is_wrong[i] = surface.side_of(x.col(vertices[i])) != right; });
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (is_wrong[i]) wrong.push_back(vertices[i]);
  };
  const auto [inner, outer] = pair;
  add(inner, outer, Side::inside);
  if (nested.closed[inner]) add(outer, inner, Side::outside);
  std::sort(wrong.begin(), wrong.end());
  return wrong;
}

}  // namespace unsnarl
