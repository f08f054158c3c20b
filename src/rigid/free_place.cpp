#include "rigid/free_place.h"

#include <tuple>

namespace unsnarl {

std::vector<Vec3> lattice_directions() {
  std::vector<Vec3> directions;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (std::tie(i, j, k) > std::tuple(0, 0, 0)) directions.emplace_back(i, j, k);
  return directions;
}

std::vector<IntersectingPair> some_contacts(std::span<const IntersectingPair> contacts) {
  std::vector<IntersectingPair> some;
  const std::size_t stride = contacts.size() / FreePlaceConstants::most_contacts + 1;
  for (std::size_t k = 0; k < contacts.size(); k += stride) some.push_back(contacts[k]);
  return some;
}

}  // namespace unsnarl
