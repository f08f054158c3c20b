#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_accessors.h"
#include "io/gltf_appearance.h"
#include "io/gltf_container.h"
#include "io/gltf_scene.h"
#include "io/mesh_file.h"

namespace unsnarl {

/// Positions that lie behind each other at one stride; accessors that overlap share a block.
struct GltfBlock {
  AccessorLayout layout;
  std::size_t first_vertex = 0;
  std::string other_use;  ///< set: what else these bytes mean, so that they must not change
};

/// A POSITION accessor of the surface.
struct GltfPositions {
  AccessorLayout layout;
  std::size_t block = 0, first_in_block = 0;
  JsonText::Value json;
  std::optional<AccessorLayout> normals;  ///< of the first primitive that has some; as many as positions
};

/// A parsed glTF or GLB: which bytes of its buffers are the positions, and how new ones get there.
class GltfFile final : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    return patched_as({}, {}, positions, float32_digits);
  }
  std::vector<OutputFile> patched_as(const std::string& main_name, const std::string& infix,
                                     std::span<const double> positions, bool float32_digits) const override;
  std::vector<double> as_written(std::span<const double> positions, bool) const override;
  bool has_vertex_normals() const override;
  Appearance appearance(std::size_t room) const override {
    return gltf_appearance(json->root(), buffers, parts, surface, folder, room);
  }

  std::optional<JsonText> json;
  GltfContainer container;
  GltfBuffers buffers;
  std::vector<GltfBlock> blocks;
  std::map<std::size_t, GltfPositions> accessors;  ///< by accessor number
  std::vector<Placement> placements;
  std::vector<std::int32_t> placement_of_vertex;
  std::vector<GltfPart> parts;
  std::filesystem::path folder;  ///< that files which this one names are relative to

 private:
  using Local = std::array<float, 3>;
  std::size_t offset_of(const GltfBlock& block, std::size_t vertex) const {
    return block.layout.start + (vertex - block.first_vertex) * block.layout.stride;
  }
  Local stored(const GltfBlock& block, std::size_t vertex) const;
  /// The numbers to store for a vertex that should be at positions[3 vertex ...]; those stored where it did not move.
  Local wanted(const GltfBlock& block, std::size_t vertex, std::span<const double> positions) const;
  /// Turns stored normals with the faces around them, in the space of their meshes.
  void turn_normals(std::span<const double> positions, std::map<std::size_t, std::string>& changed) const;
  void update_bounds(const GltfPositions& accessor, std::string_view data, std::vector<TextEdit>& edits) const;
};

}  // namespace unsnarl
