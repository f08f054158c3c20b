#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace unsnarl {

/// A material of an MTL file, as far as it colours faces.
struct MtlMaterial {
  std::array<float, 3> colour = {1, 1, 1};                ///< Kd, [0, 1]
  std::string image;                                      ///< map_Kd as it is written; empty: none
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};  ///< of the texture coordinates: offset + scale uv
  bool clamp = false;                                     ///< the image does not repeat
};

/// Reads the materials of an MTL file (Wavefront, "MTL material format"), by their names, to those that are there. What
/// makes no sense is passed over.
void read_mtl(std::string_view text, std::map<std::string, MtlMaterial, std::less<>>& materials);

}  // namespace unsnarl
