#include "scene/solids.h"

#include <algorithm>

#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "scene/component_mesh.h"

namespace unsnarl {

Solids find_solids(const Positions& rest, std::span<const Triangle> triangles, const Components& components) {
  const std::vector<std::vector<Triangle>> of_component = triangles_by_component(triangles, components);
  Solids solids;
  std::vector<Index> number(components.list.size(), -1);
  for (Index c = 0; c < components.count(); ++c) {
    if (!has_volume(components.list[c])) continue;
    number[c] = static_cast<Index>(solids.list.size());
    solids.list.push_back({signed_volume(rest, of_component[c]), total_area(rest, of_component[c])});
  }
  if (solids.list.empty()) return solids;
  for (const Triangle& t : triangles) solids.of_triangle.push_back(number[components.component_of_vertex[t[0]]]);
  return solids;
}

Solids solids_of(const Solids& all, std::span<const Index> triangles) {
  Solids some;
  const auto solid_of = [&](Index t) {
    return static_cast<std::size_t>(t) < all.of_triangle.size() ? all.of_triangle[t] : -1;
  };
  std::vector<Index> numbers;  // of those met, in `all`
  for (const Index t : triangles)
    if (const Index solid = solid_of(t); solid >= 0) numbers.push_back(solid);
  if (numbers.empty()) return some;
  sort_unique(numbers);
  for (const Index solid : numbers) some.list.push_back(all.list[solid]);
  for (const Index t : triangles) {
    const auto at = std::lower_bound(numbers.begin(), numbers.end(), solid_of(t));
    some.of_triangle.push_back(solid_of(t) < 0 ? -1 : static_cast<Index>(at - numbers.begin()));
  }
  return some;
}

}  // namespace unsnarl
