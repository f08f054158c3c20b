#pragma once

#include <filesystem>
#include <string_view>

#include "unsnarl/appearance.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Colours (Kd) and images (map_Kd) of an OBJ file by the MTL files in its folder. Never throws for what is in the
/// files: notes of the result say what cannot be shown.
/// bytes: an OBJ file that could be read, surface: what it gave. room: bytes that all images may have.
Appearance obj_appearance(std::string_view bytes, const SurfaceView& surface, const std::filesystem::path& folder,
                          std::size_t room);

}  // namespace unsnarl
