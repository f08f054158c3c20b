// glTF 2.0 and its binary form GLB. What is repaired are the float32 POSITION accessors of triangle primitives, seen
// where the default scene places their meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "geometry/portable_math.h"
#include "io/formats.h"
#include "io/gltf_file.h"
#include "io/surface_builder.h"

namespace unsnarl {
namespace {

using Value = JsonText::Value;

enum PrimitiveMode : std::size_t { triangles = 4, triangle_strip = 5, triangle_fan = 6 };

class GltfParser {
 public:
  explicit GltfParser(GltfFile& file) : file_(file), root_(file.json->root()) {}

  void parse(const std::filesystem::path& folder) {
    if (!root_.is_object()) throw FileError("the JSON text is not an object; check that it is a glTF file");
    const std::string version = root_["asset"]["version"].string();
    if (!version.starts_with("2")) {
      throw FileError(version.empty()
                          ? std::string("'asset' with a version is missing; check that it is a glTF file")
                          : fmt::format("glTF version {}, but only version 2 is supported; convert the file",
                                        version.substr(0, 20)));
    }
    file_.folder = folder;
    meshes_ = root_["meshes"].elements();
    file_.buffers = GltfBuffers(root_["buffers"].elements(), file_.bytes, file_.container, folder);
    accessors_ = GltfAccessors(root_, file_.buffers);
    file_.stores_float32 = true;
    ScenePlaces places = places_in_scene(root_, meshes_.size());
    places_ = std::move(places.of_meshes);
    node_places_ = std::move(places.of_nodes);

    collect_primitives();
    build_blocks();
    find_other_uses();
    build_faces();
    place_vertices();
    file_.up = up();
    notes();
  }

 private:
  /// The direction that is up, glTF 2.0, section 3.4 (fixed by the format)
  static constexpr std::array<double, 3> world_up = {0, 1, 0};

  struct Primitive {
    std::size_t mesh = 0, number = 0, mode = triangles;
    std::size_t positions = 0;  ///< accessor
    Value attributes, indices, material;
  };

  static std::string name_of(const Value& named, const char* kind, std::size_t id) {
    return named["name"].is_string() ? named["name"].string() : fmt::format("{} {}", kind, id);
  }
  std::string where(const Primitive& p) const {
    return fmt::format("mesh {} ({}), primitive {}", p.mesh, name_of(meshes_[p.mesh], "mesh", p.mesh), p.number);
  }
  void collect_primitives() {
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
      const std::vector<Value> primitives = meshes_[m]["primitives"].elements();
      for (std::size_t n = 0; n < primitives.size(); ++n) {
        const Value& json = primitives[n];
        Primitive p;
        p.mesh = m;
        p.number = n;
        p.mode = member_index(json, "mode", triangles, where(p));
        has_morph_targets_ |= static_cast<bool>(json["targets"]);
        if (p.mode < triangles || p.mode > triangle_fan || !json["attributes"]["POSITION"]) {
          ++ignored_primitives_;
          continue;
        }
        if (json["extensions"]["KHR_draco_mesh_compression"]) {
          throw FileError(where(p) +
                          ": compressed with KHR_draco_mesh_compression, which is not supported; "
                          "decompress the file first, as by importing it into Blender and exporting it without "
                          "compression");
        }
        p.positions = member_index(json["attributes"], "POSITION", 0, where(p));
        p.attributes = json["attributes"];
        p.indices = json["indices"];
        p.material = json["material"];
        if (!file_.accessors.contains(p.positions)) {
          GltfPositions accessor;
          accessor.layout = accessors_.positions(p.positions, where(p) + ", POSITION");
          accessor.json = accessors_.json(p.positions);
          file_.accessors[p.positions] = accessor;
          order_.push_back(p.positions);
        }
        find_normals(json["attributes"], file_.accessors[p.positions]);
        primitives_.push_back(p);
      }
    }
  }

  /// Normals may be compressed or missing: they need not follow what moves.
  void find_normals(const Value& attributes, GltfPositions& accessor) const {
    if (accessor.normals || !attributes["NORMAL"]) return;
    try {
      const AccessorLayout normals = accessors_.positions(member_index(attributes, "NORMAL", 0, "NORMAL"), "NORMAL");
      if (normals.count == accessor.layout.count) accessor.normals = normals;
    } catch (const FileError&) {
      return;
    }
  }

  /// Accessors that share bytes (several views of one vertex buffer) become one block, so that each number has one
  /// vertex.
  void build_blocks() {
    const auto key = [this](std::size_t id) {
      const AccessorLayout& l = file_.accessors[id].layout;
      return std::array{l.buffer, l.stride, l.start % l.stride, l.start};
    };
    std::map<std::size_t, std::size_t> rank;
    for (const std::size_t id : order_) rank.try_emplace(id, rank.size());
    std::vector<std::size_t> sorted = order_;
    std::sort(sorted.begin(), sorted.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(key(a), rank[a]) < std::pair(key(b), rank[b]); });
    struct Group {
      AccessorLayout layout;
      std::size_t rank;
      std::vector<std::size_t> members;
    };
    std::vector<Group> groups;
    for (const std::size_t id : sorted) {
      const AccessorLayout& l = file_.accessors[id].layout;
      if (!groups.empty()) {
        AccessorLayout& last = groups.back().layout;
        const bool same_lattice =
            last.buffer == l.buffer && last.stride == l.stride && last.start % l.stride == l.start % l.stride;
        const std::size_t first = same_lattice ? (l.start - last.start) / l.stride : 0;
        if (same_lattice && (first < last.count || l.start == last.start)) {
          last.count = std::max(last.count, first + l.count);
          groups.back().rank = std::min(groups.back().rank, rank[id]);
          groups.back().members.push_back(id);
          continue;
        }
      }
      groups.push_back({l, rank[id], {id}});
    }
    std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.rank < b.rank; });
    std::size_t vertices = 0;
    for (const Group& group : groups) {
      for (const std::size_t id : group.members) {
        GltfPositions& accessor = file_.accessors[id];
        accessor.block = file_.blocks.size();
        accessor.first_in_block = (accessor.layout.start - group.layout.start) / group.layout.stride;
      }
      file_.blocks.push_back({group.layout, vertices, {}});
      vertices += group.layout.count;
    }
    if (vertices > std::numeric_limits<std::int32_t>::max() / 3) {
      throw FileError(fmt::format("{} vertices are more than 32-bit ids can count; split the file", vertices));
    }
    refuse_overlaps();
    file_.surface.positions.resize(3 * vertices);
    file_.placement_of_vertex.assign(vertices, -1);
  }

  /// Positions that cut through each other have no meaning, and patching one would break the other.
  void refuse_overlaps() const {
    std::map<std::size_t, std::size_t> blocks_in;
    for (const GltfBlock& block : file_.blocks) ++blocks_in[block.layout.buffer];
    std::map<std::size_t, std::vector<bool>> claimed;
    for (const GltfBlock& block : file_.blocks) {
      const AccessorLayout& l = block.layout;
      if (blocks_in[l.buffer] < 2) continue;
      std::vector<bool>& bytes = claimed.try_emplace(l.buffer, file_.buffers.data(l.buffer).size()).first->second;
      for (std::size_t i = 0; i < l.count; ++i) {
        for (std::size_t byte = 0; byte < GltfAccessors::position_size; ++byte) {
          const std::size_t at = l.start + i * l.stride + byte;
          if (bytes[at]) {
            throw FileError(fmt::format("two POSITION accessors overlap at byte {} of buffer {}; the file is damaged",
                                        at, l.buffer));
          }
          bytes[at] = true;
        }
      }
    }
  }

  /// An accessor may serve as POSITION and as something else; then no position in it can change alone.
  void find_other_uses() {
    const auto use = [this](const Value& accessor, const std::string& what) {
      const std::optional<std::size_t> id = accessor.index();
      const auto found = id ? file_.accessors.find(*id) : file_.accessors.end();
      if (found == file_.accessors.end()) return;
      mark_other_use(file_.blocks[found->second.block], what);
    };
    for (const Value& mesh : meshes_) {
      for (const Value& primitive : mesh["primitives"].elements()) {
        for (const char* semantic : {"NORMAL", "COLOR_0", "TEXCOORD_0"})
          use(primitive["attributes"][semantic], semantic);
        for (const Value& target : primitive["targets"].elements()) {
          for (const char* semantic : {"POSITION", "NORMAL"}) use(target[semantic], "a morph target");
        }
      }
    }
  }

  void mark_other_use(GltfBlock& block, const std::string& what) {
    if (block.other_use.empty()) {
      file_.notes.push_back(
          fmt::format("Some positions are {} too; a repair would have to change both, so it is refused where these "
                      "vertices have to move.",
                      what));
    }
    block.other_use = what;
  }

  /// In a damaged file the indices may lie in the bytes of positions.
  void find_positions_below(const AccessorLayout& indices) {
    for (GltfBlock& block : file_.blocks) {
      const bool are_apart = block.layout.buffer != indices.buffer || block.layout.start >= indices.end() ||
                             indices.start >= block.layout.end();
      if (!are_apart) mark_other_use(block, "indices");
    }
  }

  std::vector<std::int32_t> corners_of(const Primitive& p) {
    const GltfPositions& positions = file_.accessors[p.positions];
    const std::size_t base = file_.blocks[positions.block].first_vertex + positions.first_in_block;
    const std::size_t vertices = positions.layout.count;
    std::size_t count = vertices;
    AccessorLayout indices;
    if (p.indices) {
      indices = accessors_.indices(accessor_number(p.indices, where(p)), where(p) + ", indices");
      count = indices.count;
      find_positions_below(indices);
    }
    limit_corners(count * (p.mode == triangles ? 1 : 3), p);
    const auto vertex = [&](std::size_t i) {
      if (!p.indices) return static_cast<std::int32_t>(base + i);
      const std::size_t id = accessors_.index(indices, i);
      if (id >= vertices) {
        throw FileError(
            fmt::format("{}: index {} uses vertex {}, but the primitive has {} vertices (all counting from 0)",
                        where(p), i, id, vertices));
      }
      return static_cast<std::int32_t>(base + id);
    };
    std::vector<std::int32_t> corners;
    if (p.mode == triangles) {
      corners.resize(count / 3 * 3);
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = vertex(i);
      return corners;
    }
    for (std::size_t i = 0; i + 2 < count; ++i) {
      // glTF 2.0, section 3.7.2.1
      const std::array<std::int32_t, 3> face = p.mode == triangle_strip
                                                   ? std::array{vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2)}
                                                   : std::array{vertex(i + 1), vertex(i + 2), vertex(0)};
      // Strips repeat vertices to jump from one place to another; these triangles are no faces.
      const bool is_jump = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
      if (p.mode == triangle_strip && is_jump) continue;
      corners.insert(corners.end(), face.begin(), face.end());
    }
    return corners;
  }
  static std::size_t accessor_number(const Value& value, const std::string& where) {
    const std::optional<std::size_t> result = value.index();
    if (!result) throw FileError(where + ": 'indices' is not an accessor; the file is damaged");
    return *result;
  }

  /// A small file can name the same indices again and again. No real one has more corners than this.
  void limit_corners(std::size_t more, const Primitive& p) {
    std::size_t most = file_.bytes.size();
    for (const GltfBlock& block : file_.blocks) most += block.layout.count * GltfAccessors::position_size;
    corners_ += more;
    if (corners_ > 8 * most || corners_ > std::numeric_limits<std::int32_t>::max()) {
      throw FileError(where(p) + ": more face corners than a file of this size can mean; it is damaged");
    }
  }

  std::int32_t placement_number(const Placement& placement) {
    if (file_.placements.empty() || !(file_.placements.back() == placement)) file_.placements.push_back(placement);
    return static_cast<std::int32_t>(file_.placements.size() - 1);
  }

  void build_faces() {
    FaceCollector faces(file_.surface);
    LabelCollector nodes("node"), meshes("mesh"), materials("material");
    const std::vector<Value> material_list = root_["materials"].elements();
    block_placement_.assign(file_.blocks.size(), -1);
    for (const Primitive& p : primitives_) {
      const MeshPlace& place = places_[p.mesh];
      const std::int32_t placement = placement_number(place.placement);
      const GltfPositions& positions = file_.accessors[p.positions];
      if (block_placement_[positions.block] < 0) block_placement_[positions.block] = placement;

      if (place.node.empty()) {
        nodes.stop(faces.count());
      } else {
        nodes.start(place.node, faces.count());
      }
      meshes.start(name_of(meshes_[p.mesh], "mesh", p.mesh), faces.count());
      const std::optional<std::size_t> material = p.material.index();
      if (material && *material < material_list.size()) {
        materials.start(name_of(material_list[*material], "material", *material), faces.count());
      } else {
        materials.stop(faces.count());
      }

      const std::size_t first_vertex = file_.blocks[positions.block].first_vertex + positions.first_in_block;
      file_.parts.push_back({faces.count(), first_vertex, positions.layout.count, p.attributes, p.material});
      const std::vector<std::int32_t> corners = corners_of(p);
      for (std::size_t i = 0; i < corners.size(); i += 3) {
        const std::span<const std::int32_t> face(corners.data() + i, 3);
        if (claim(face, placement)) {
          faces.add(face);
        } else {
          ++faces_elsewhere_;
        }
      }
    }
    nodes.finish(faces.count(), file_.labels);
    meshes.finish(faces.count(), file_.labels);
    materials.finish(faces.count(), file_.labels);
  }

  /// A vertex belongs to the first place that shows it. False: some corner belongs to another place.
  bool claim(std::span<const std::int32_t> face, std::int32_t placement) {
    for (const std::int32_t v : face) {
      const std::int32_t owner = file_.placement_of_vertex[v];
      if (owner >= 0 && owner != placement && !(file_.placements[owner] == file_.placements[placement])) return false;
    }
    for (const std::int32_t v : face) {
      if (file_.placement_of_vertex[v] < 0) file_.placement_of_vertex[v] = placement;
    }
    return true;
  }

  void place_vertices() {
    for (std::size_t b = 0; b < file_.blocks.size(); ++b) {
      const GltfBlock& block = file_.blocks[b];
      const std::string_view data = file_.buffers.data(block.layout.buffer);
      for (std::size_t i = 0; i < block.layout.count; ++i) {
        const std::size_t v = block.first_vertex + i;
        if (file_.placement_of_vertex[v] < 0) file_.placement_of_vertex[v] = block_placement_[b];
        const std::size_t offset = block.layout.start + i * block.layout.stride;
        const std::array<float, 3> local = load_position(data, offset);
        const std::array<double, 3> world =
            file_.placements[file_.placement_of_vertex[v]].to_world({local[0], local[1], local[2]});
        for (std::size_t k = 0; k < 3; ++k) {
          if (!std::isfinite(world[k])) {
            throw FileError(
                fmt::format("byte {} of buffer {}: vertex {} (counting from 0) is not finite; correct or remove it",
                            offset, block.layout.buffer, v));
          }
          file_.surface.positions[3 * v + k] = world[k];
        }
      }
    }
  }

  /// The axis nearest to what the scene's y is in the positions, on the mean over the meshes: joints turn a skinned one
  /// after its positions.
  std::array<double, 3> up() const {
    std::array<double, 3> sum{};
    std::set<std::size_t> shown;
    for (const Primitive& p : primitives_) shown.insert(p.mesh);
    for (const std::size_t m : shown) {
      const std::array<double, 3> one = places_[m].skin ? up_before_skin(*places_[m].skin) : world_up;
      for (std::size_t k = 0; k < 3; ++k) sum[k] += one[k];
    }
    std::size_t axis = 1;
    for (const std::size_t k : {std::size_t{0}, std::size_t{2}})
      if (std::abs(sum[k]) > std::abs(sum[axis])) axis = k;
    std::array<double, 3> result{};
    result[axis] = sum[axis] < 0 ? -1 : 1;
    return result;
  }

  /// Returns the direction that the joints of a skin turn to y, on their mean; y where the skin does not say.
  std::array<double, 3> up_before_skin(std::size_t id) const {
    try {
      const std::vector<Value> skins = root_["skins"].elements();
      if (id >= skins.size()) return world_up;
      const std::vector<Value> joints = skins[id]["joints"].elements();
      std::optional<AccessorLayout> inverse;
      if (skins[id]["inverseBindMatrices"])
        inverse = accessors_.matrices(member_index(skins[id], "inverseBindMatrices", 0, "skin"), "skin");
      std::array<double, 3> sum{};
      for (std::size_t j = 0; j < joints.size(); ++j) {
        const std::size_t node = joints[j].index().value_or(node_places_.size());
        if (node >= node_places_.size() || !node_places_[node] || (inverse && j >= inverse->count)) continue;
        Placement skinning = *node_places_[node];
        if (inverse)
          skinning = skinning * Placement::of_columns(load_matrix(file_.buffers.data(inverse->buffer),
                                                                  inverse->start + j * inverse->stride));
        if (!skinning.is_invertible()) continue;
        const std::array<double, 3> origin = skinning.to_world({0, 0, 0});
        const std::array<double, 3> before = skinning.to_local({origin[0], origin[1] + 1, origin[2]});
        const double length = portable::length(before[0], before[1], before[2]);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += before[k] / length;
      }
      const double length = portable::length(sum[0], sum[1], sum[2]);
      if (!std::isnormal(length)) return world_up;
      return {sum[0] / length, sum[1] / length, sum[2] / length};
    } catch (const FileError&) {  // nothing but a view depends on it
      return world_up;
    }
  }

  void notes() {
    std::vector<std::string>& notes = file_.notes;
    std::set<std::size_t> shown;
    for (const Primitive& p : primitives_) shown.insert(p.mesh);
    std::size_t skinned = 0, hidden = 0, flat = 0, instanced = 0;
    for (const std::size_t m : shown) {
      const MeshPlace& place = places_[m];
      skinned += place.skin.has_value();
      hidden += place.instances == 0;
      flat += place.was_flat;
      instanced += place.instances > 1;
    }
    const auto meshes = [](std::size_t n) { return n == 1 ? std::string("1 mesh") : fmt::format("{} meshes", n); };
    if (skinned > 0) notes.push_back(fmt::format("{} with a skin: the bind pose is repaired.", meshes(skinned)));
    if (has_morph_targets_) notes.emplace_back("Morph targets: the base shape is repaired.");
    if (instanced > 0) {
      notes.push_back(fmt::format(
          "{} shown by several nodes: repaired where the first one shows it, the others follow.", meshes(instanced)));
    }
    if (flat > 0) {
      notes.push_back(fmt::format("{} with a node transform that cannot be inverted: repaired without the transform.",
                                  meshes(flat)));
    }
    if (hidden > 0) {
      notes.push_back(fmt::format("{} not shown by the default scene: repaired without a transform.", meshes(hidden)));
    }
    if (faces_elsewhere_ > 0) {
      notes.push_back(
          fmt::format("{} faces share vertices with a mesh that stands elsewhere and are left out; they follow.",
                      faces_elsewhere_));
    }
    if (ignored_primitives_ > 0) {
      notes.push_back(
          fmt::format("{} primitives without triangles or positions are left as they are.", ignored_primitives_));
    }
  }

  GltfFile& file_;
  Value root_;
  std::vector<Value> meshes_;
  GltfAccessors accessors_;
  std::vector<MeshPlace> places_;
  std::vector<std::optional<Placement>> node_places_;
  std::vector<Primitive> primitives_;
  std::vector<std::size_t> order_;             ///< POSITION accessors in the order of their first use
  std::vector<std::int32_t> block_placement_;  ///< for vertices that no face uses
  std::size_t corners_ = 0, faces_elsewhere_ = 0, ignored_primitives_ = 0;
  bool has_morph_targets_ = false;
};

std::unique_ptr<MeshFile> parse_container(std::unique_ptr<GltfFile> file, const std::filesystem::path& folder) {
  const ByteRange range = file->container.json;
  file->json.emplace(std::string_view(file->bytes).substr(range.begin, range.size));
  GltfParser(*file).parse(folder);
  return file;
}

}  // namespace

std::unique_ptr<MeshFile> parse_glb(std::string bytes, const std::filesystem::path& folder) {
  auto file = std::make_unique<GltfFile>();
  file->bytes = std::move(bytes);
  file->container = GltfContainer::of_glb(file->bytes);
  return parse_container(std::move(file), folder);
}

std::unique_ptr<MeshFile> parse_gltf(std::string bytes, const std::filesystem::path& folder) {
  if (bytes.empty()) throw FileError("the file is empty; a glTF file is a JSON text");
  auto file = std::make_unique<GltfFile>();
  file->bytes = std::move(bytes);
  file->container = GltfContainer::of_gltf(file->bytes);
  return parse_container(std::move(file), folder);
}

}  // namespace unsnarl
