#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Parts of a mesh, by the names that its file gives to faces, or by connectivity. Together: any of them.
struct Parts {
  std::vector<std::string> groups = {};       ///< OBJ "g": the whole line or one of its words; others: see FaceLabels
  std::vector<std::string> objects = {};      ///< OBJ "o", STL solids; others: see FaceLabels
  std::vector<std::string> materials = {};    ///< OBJ "usemtl", glTF materials
  std::vector<std::int32_t> components = {};  ///< ids of component_of_faces()
  std::vector<std::string> files = {};        ///< of a scene of several, see SceneDocument

  bool empty() const {
    return groups.empty() && objects.empty() && materials.empty() && components.empty() && files.empty();
  }
};

/// A part was asked for that the mesh does not have. The message lists the ones that it has.
class UnknownPart : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A part that the file names, by the name that Parts takes.
struct NamedPart {
  enum class Kind : std::uint8_t { object, group, material };
  Kind kind = Kind::object;
  std::string name;
  std::size_t faces = 0;
  std::size_t vertices = 0;  ///< of the file that these faces use; parts may share some
};

std::string_view to_string(NamedPart::Kind kind);  ///< as options name it: "object", "group", "material"

/// All parts that the labels of a file name: objects, then groups, then materials, each in the order of the file.
/// Those without faces too.
std::vector<NamedPart> named_parts(const SurfaceView& surface, std::span<const FaceLabels> labels);

/// The name that the file gives to the part of a face: that of its object, else of its group, else, where there are
/// several files, of its file; empty: none.
std::string part_of_face(std::span<const FaceLabels> labels, std::int32_t face);

/// Component of each face (faces joined by a shared vertex, after welding), numbered from 0 in the order of
/// their first faces, as `unsnarl check` lists them; -1 for a face without corners. Throws as
/// find_intersections does.
std::vector<std::int32_t> component_of_faces(const SurfaceView& surface, const FindOptions& options = {});

/// All that Parts can name each face by: labels of kind "component", whose names are their numbers and not listed; then
/// those of the file, of kind "object", "group" or "material", as options name these. Throws as find_intersections
/// does.
std::vector<FaceLabels> parts_of_faces(const SurfaceView& surface, std::span<const FaceLabels> labels,
                                       const FindOptions& options = {});

/// One flag a face: belongs to one of the parts. Throws UnknownPart.
std::vector<std::uint8_t> faces_in_parts(const SurfaceView& surface, std::span<const FaceLabels> labels,
                                         const Parts& parts, const FindOptions& options = {});

/// The pairs of faces that rules allow to pass through each other: "A:B" those of the parts A and B, "A" those of A
/// among each other. A part is the name of a file, an object, a group or a material, or the number of a component;
/// "object=A" (file=, group=, material=, component=) says which where a name is of several kinds. Throws UnknownPart
/// for a name that nothing has, and std::invalid_argument for a rule that can be read in two ways.
AllowedPairs allowed_pairs(const SurfaceView& surface, std::span<const FaceLabels> labels,
                           std::span<const std::string> rules, const FindOptions& options = {});

/// One flag a vertex: a flagged face uses it.
std::vector<std::uint8_t> vertices_of_faces(const SurfaceView& surface, std::span<const std::uint8_t> faces);

/// One flag a vertex: it lies on an edge of one face only, after welding, so that seams do not count.
std::vector<std::uint8_t> boundary_vertices(const SurfaceView& surface, const FindOptions& options = {});

}  // namespace unsnarl
