#include "unsnarl/appearance.h"

#include <algorithm>

namespace unsnarl {

bool Appearance::is_worth_showing() const {
  if (!images.empty()) return true;
  if (material_of_face.empty()) return false;
  const auto colour_of = [this](std::int32_t material) {
    return material < 0 ? std::array<float, 3>{-1, -1, -1} : materials[static_cast<std::size_t>(material)].colour;
  };
  const std::array<float, 3> first = colour_of(material_of_face.front());
  return std::any_of(material_of_face.begin(), material_of_face.end(),
                     [&](std::int32_t material) { return colour_of(material) != first; });
}

}  // namespace unsnarl
