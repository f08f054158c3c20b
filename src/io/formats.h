#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/mesh_file.h"

namespace unsnarl {

/// Reads the bytes of a file. `folder` is where files that it refers to lie. Throws FileError.
using ParseFile = std::unique_ptr<MeshFile>(std::string bytes, const std::filesystem::path& folder);
ParseFile parse_obj, parse_off, parse_ply, parse_stl, parse_glb, parse_gltf;  // each in the file of its name

struct FormatEntry {
  Format format;
  std::string_view name;  ///< also the usual extension, lower case
  ParseFile* parse;
};

/// All formats, in the order of enum Format: a new one adds its line.
inline constexpr auto formats = std::to_array<FormatEntry>({
    {Format::obj, "obj", parse_obj},
    {Format::off, "off", parse_off},
    {Format::ply, "ply", parse_ply},
    {Format::stl, "stl", parse_stl},
    {Format::glb, "glb", parse_glb},
    {Format::gltf, "gltf", parse_gltf},
});
static_assert([] {
  for (std::size_t i = 0; i < formats.size(); ++i)
    if (static_cast<std::size_t>(formats[i].format) != i) return false;
  return true;
}());

}  // namespace unsnarl
