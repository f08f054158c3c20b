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
// Each in the file of its name.
ParseFile parse_obj, parse_off, parse_ply, parse_stl, parse_glb, parse_gltf, parse_surf, parse_gii, parse_vtk,
    parse_vtp, parse_msh, parse_inp, parse_threemf;

struct FormatEntry {
  Format format;
  std::string_view name;  ///< also the usual extension, lower case
  ParseFile* parse;
  std::string_view other_extensions = {};  ///< separated by blanks
};

/// All formats, in the order of enum Format: a new one adds its line.
inline constexpr auto formats = std::to_array<FormatEntry>({
    {Format::obj, "obj", parse_obj},
    {Format::off, "off", parse_off},
    {Format::ply, "ply", parse_ply},
    {Format::stl, "stl", parse_stl},
    {Format::glb, "glb", parse_glb},
    {Format::gltf, "gltf", parse_gltf},
    {Format::surf, "surf", parse_surf, "freesurfer white pial inflated"},
    {Format::gii, "gii", parse_gii, "gifti"},
    {Format::vtk, "vtk", parse_vtk},
    {Format::vtp, "vtp", parse_vtp, "vtu"},
    {Format::msh, "msh", parse_msh},
    {Format::inp, "inp", parse_inp},
    {Format::threemf, "3mf", parse_threemf},
});
static_assert([] {
  for (std::size_t i = 0; i < formats.size(); ++i)
    if (static_cast<std::size_t>(formats[i].format) != i) return false;
  return true;
}());

}  // namespace unsnarl
