#include "io/foreign_formats.h"

#include <fmt/format.h>

#include <array>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

struct ForeignFormat {
  std::string_view name;
  std::array<std::string_view, 8> extensions;
  std::array<std::string_view, 3> first_bytes;
  std::string_view conversion;
};
constexpr std::string_view by_blender = "import it into Blender and export it as glTF or OBJ (File > Export)";
constexpr std::string_view by_assimp = "convert it: assimp export IN OUT.glb (assimp-utils), or import it into Blender";
constexpr std::string_view by_meshio = "convert it: meshio convert IN OUT.ply";
constexpr std::string_view meshed_by_gmsh = "mesh its curved surfaces: gmsh -2 IN -o OUT.msh";
constexpr std::string_view segmented_by_slicer =
    "segment the volume in 3D Slicer, and export the segments as OBJ or STL";
constexpr std::string_view first_a_surface =
    "points have no faces; reconstruct a surface first (MeshLab, CloudCompare)";
/// docs/formats.md has the same as a table.
constexpr auto foreign_formats = std::to_array<ForeignFormat>({
    {"FBX", {".fbx"}, {"Kaydara FBX Binary", "; FBX "}, by_blender},
    {"USD", {".usd", ".usda", ".usdc", ".usdz"}, {"PXR-USDC", "#usda "}, by_blender},
    {"Blend", {".blend"}, {"BLENDER"}, "open it in Blender and export it as glTF or OBJ (File > Export)"},
    {"Alembic", {".abc"}, {"Ogawa"}, by_blender},
    {"COLLADA", {".dae"}, {}, by_assimp},
    {"3DS", {".3ds"}, {}, by_assimp},
    {"X3D", {".x3d", ".x3db"}, {}, by_assimp},
    {"LightWave", {".lwo"}, {}, by_assimp},
    {"VRML", {".wrl", ".vrml"}, {"#VRML"}, "import it into Blender or MeshLab, and export it as PLY or OBJ"},
    {"STEP", {".step", ".stp"}, {"ISO-10303-21;"}, meshed_by_gmsh},
    {"IGES", {".iges", ".igs"}, {}, meshed_by_gmsh},
    {"BREP", {".brep"}, {"DBRep_DrawableShape"}, meshed_by_gmsh},
    {"Medit", {".mesh", ".meshb"}, {"MeshVersionFormatted"}, by_meshio},
    {"VTK grid", {".vtr", ".vts", ".vti"}, {}, "extract the surface in ParaView and save it as VTP"},
    {"XDMF", {".xdmf", ".xmf"}, {}, by_meshio},
    {"MED", {".med"}, {}, by_meshio},
    {"Exodus", {".e", ".exo"}, {}, by_meshio},
    {"Nastran", {".bdf", ".nas", ".fem"}, {}, by_meshio},
    {"SU2", {".su2"}, {}, by_meshio},
    {"TetGen", {".smesh", ".poly"}, {}, "save the surface as OFF, PLY or STL, which TetGen reads too"},
    {"TRI", {".tri"}, {}, "read it with mne.read_tri in Python and save it with mne.write_surface"},
    {"Draco", {".drc"}, {"DRACO"}, "decompress it: draco_decoder -i IN -o OUT.obj"},
    {"DICOM or NIfTI", {".dcm", ".nii", ".nrrd", ".mha", ".mhd"}, {}, segmented_by_slicer},
    {"point", {".xyz", ".pcd", ".las", ".laz", ".pts", ".e57"}, {"# .PCD"}, first_a_surface},
    {"archive", {".zip", ".gz", ".7z", ".tar", ".bz2", ".xz"}, {"7z\xBC\xAF", "\x1F\x8B"}, "unpack it first"},
});

bool has_extension(std::string_view path, std::string_view extension) {
  if (extension.empty() || path.size() < extension.size()) return false;
  path.remove_prefix(path.size() - extension.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const char c = path[i] >= 'A' && path[i] <= 'Z' ? static_cast<char>(path[i] - 'A' + 'a') : path[i];
    if (c != extension[i]) return false;
  }
  return true;
}

}  // namespace

void refuse_foreign_format(std::string_view bytes, const std::string& path) {
  for (const ForeignFormat& format : foreign_formats) {
    bool is_it = false;
    for (const std::string_view extension : format.extensions) is_it |= has_extension(path, extension);
    for (const std::string_view start : format.first_bytes) is_it |= !start.empty() && bytes.starts_with(start);
    if (is_it) throw FileError(fmt::format("{} files are not read; {}", format.name, format.conversion));
  }
}

}  // namespace unsnarl
