#pragma once

#include <filesystem>
#include <vector>

#include "io/gltf_accessors.h"
#include "io/gltf_container.h"
#include "io/json_text.h"
#include "unsnarl/appearance.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The faces of the surface that come from one primitive: the faces up to those of the next one.
struct GltfPart {
  std::size_t first_face = 0;
  std::size_t first_vertex = 0, vertices = 0;  ///< of the surface: elements of the attributes, in their order
  JsonText::Value attributes, material;
};

/// Base colours and their images (glTF 2.0, section 3.9; KHR_materials_pbrSpecularGlossiness; KHR_texture_transform).
/// Never throws for what the file holds: notes of the result say what cannot be shown.
/// parts: in the order of their faces. room: bytes that all images may have.
Appearance gltf_appearance(const JsonText::Value& root, const GltfBuffers& buffers, const std::vector<GltfPart>& parts,
                           const SurfaceView& surface, const std::filesystem::path& folder, std::size_t room);

}  // namespace unsnarl
