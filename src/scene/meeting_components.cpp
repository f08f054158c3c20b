#include "scene/meeting_components.h"

#include <algorithm>

#include "geometry/sort_unique.h"

namespace unsnarl {

std::vector<ComponentPair> meeting_components(const Components& components, std::span<const IntersectingPair> pairs) {
  std::vector<ComponentPair> meeting;
  for (const IntersectingPair& pair : pairs) {
    const auto [a, b] = std::minmax(components.component_of_triangle[pair.a], components.component_of_triangle[pair.b]);
    if (a != b && (meeting.empty() || meeting.back() != ComponentPair{a, b})) meeting.push_back({a, b});
  }
  sort_unique(meeting);
  return meeting;
}

}  // namespace unsnarl
