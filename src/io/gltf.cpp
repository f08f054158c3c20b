// glTF 2.0 and its binary form GLB. What is repaired are the float32 POSITION accessors of triangle primitives, seen
// where the default scene places their meshes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "io/byte_order.h"
#include "io/gltf_container.h"
#include "io/gltf_scene.h"
#include "io/mesh_file.h"
#include "io/surface_builder.h"
#include "io/token_edits.h"

namespace unsnarl {
namespace {

using Value = JsonText::Value;

enum ComponentType : std::size_t { unsigned_byte = 5121, unsigned_short = 5123, unsigned_int = 5125, single = 5126 };
enum PrimitiveMode : std::size_t { triangles = 4, triangle_strip = 5, triangle_fan = 6 };
constexpr std::size_t position_size = 3 * sizeof(float);

/// Where the elements of an accessor lie.
struct Layout {
  std::size_t buffer = 0, start = 0, stride = 0, count = 0;
  std::size_t component_type = 0;
};

/// Positions that lie behind each other at one stride; accessors that overlap share a block.
struct Block {
  Layout layout;
  std::size_t first_vertex = 0;
  std::string other_use;  ///< set: what else these bytes mean, so that they must not change
};

/// A POSITION accessor of the surface.
struct PositionAccessor {
  Layout layout;
  std::size_t block = 0, first_in_block = 0;
  Value json;
};

/// In the JSON text, a float with the fewest digits.
std::string number_text(float value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

class GltfFile final : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool) const override;
  std::vector<double> as_written(std::span<const double> positions, bool) const override;

  std::optional<JsonText> json;
  GltfContainer container;
  GltfBuffers buffers;
  std::vector<Block> blocks;
  std::map<std::size_t, PositionAccessor> accessors;  ///< by accessor number
  std::vector<Placement> placements;
  std::vector<std::int32_t> placement_of_vertex;

 private:
  using Local = std::array<float, 3>;
  std::size_t block_of(std::size_t vertex) const;
  std::size_t offset_of(const Block& block, std::size_t vertex) const {
    return block.layout.start + (vertex - block.first_vertex) * block.layout.stride;
  }
  Local stored(const Block& block, std::size_t vertex) const;
  /// What to store for a vertex that should be at positions[3 vertex ...]; the stored numbers where it did not move.
  Local wanted(const Block& block, std::size_t vertex, std::span<const double> positions) const;
  void update_bounds(const PositionAccessor& accessor, std::string_view data, std::vector<TextEdit>& edits) const;
};

std::array<float, 3> load_position(std::string_view data, std::size_t offset) {
  std::array<float, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = load<float>(data.data() + offset + 4 * k, std::endian::little);
  return result;
}

std::array<double, 3> as_double(const std::array<float, 3>& p) {
  return {p[0], p[1], p[2]};
}

GltfFile::Local GltfFile::stored(const Block& block, std::size_t vertex) const {
  return load_position(buffers.data(block.layout.buffer), offset_of(block, vertex));
}

GltfFile::Local GltfFile::wanted(const Block& block, std::size_t vertex, std::span<const double> positions) const {
  const Local old = stored(block, vertex);
  const std::span<const double> world = positions.subspan(3 * vertex, 3);
  if (std::equal(world.begin(), world.end(), surface.positions.begin() + static_cast<std::ptrdiff_t>(3 * vertex)))
    return old;
  const std::array<double, 3> local = placements[placement_of_vertex[vertex]].to_local({world[0], world[1], world[2]});
  Local result{};
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = static_cast<float>(value_as_written(local[k], TextPrecision::stored_float));
    if (result[k] == old[k]) result[k] = old[k];  // keeps the sign of a zero
  }
  return result;
}

std::vector<double> GltfFile::as_written(std::span<const double> positions, bool) const {
  std::vector<double> result = surface.positions;
  for (const Block& block : blocks) {
    for (std::size_t i = 0; i < block.layout.count; ++i) {
      const std::size_t v = block.first_vertex + i;
      const Local local = wanted(block, v, positions);
      if (local == stored(block, v)) continue;
      if (!block.other_use.empty()) {
        throw FileError(
            fmt::format("the positions of vertex {} (counting from 0) are {} too, which must not change; store "
                        "them apart",
                        v, block.other_use));
      }
      const std::array<double, 3> world = placements[placement_of_vertex[v]].to_world(as_double(local));
      std::copy(world.begin(), world.end(), result.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
  return result;
}

std::vector<OutputFile> GltfFile::patched(std::span<const double> positions, bool float32_digits) const {
  const std::vector<double> written = as_written(positions, float32_digits);  // refuses what cannot be changed
  std::map<std::size_t, std::string> changed;
  std::vector<bool> block_changed(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Block& block = blocks[b];
    for (std::size_t i = 0; i < block.layout.count; ++i) {
      const std::size_t v = block.first_vertex + i;
      const Local local = wanted(block, v, positions);
      const Local old = stored(block, v);
      if (local == old) continue;
      block_changed[b] = true;
      std::string& data = changed.try_emplace(block.layout.buffer, buffers.data(block.layout.buffer)).first->second;
      for (std::size_t k = 0; k < 3; ++k) {
        if (local[k] != old[k]) store(data.data() + offset_of(block, v) + 4 * k, local[k], std::endian::little);
      }
    }
  }
  std::vector<TextEdit> edits;
  for (const auto& [id, accessor] : accessors) {
    if (block_changed[accessor.block]) update_bounds(accessor, changed.at(accessor.layout.buffer), edits);
  }
  return buffers.rebuilt(bytes, container, std::move(edits), std::move(changed));
}

void GltfFile::update_bounds(const PositionAccessor& accessor, std::string_view data,
                             std::vector<TextEdit>& edits) const {
  const Layout& layout = accessor.layout;
  const std::string_view old = buffers.data(layout.buffer);
  Local lo = load_position(data, layout.start), hi = lo;
  bool is_changed = false;
  for (std::size_t i = 0; i < layout.count; ++i) {
    const std::size_t offset = layout.start + i * layout.stride;
    const Local p = load_position(data, offset);
    is_changed |= p != load_position(old, offset);
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  if (!is_changed) return;
  const auto update = [&](const char* key, const Local& bound) {
    const std::vector<Value> tokens = accessor.json[key].elements();
    if (tokens.size() != 3) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::optional<double> value = tokens[k].number();
      if (value && static_cast<float>(*value) == bound[k]) continue;
      edits.push_back({tokens[k].begin(), tokens[k].end(), number_text(bound[k])});
    }
  };
  update("min", lo);
  update("max", hi);
}

class GltfParser {
 public:
  explicit GltfParser(GltfFile& file) : file_(file), root_(file.json->root()) {}

  void parse(const std::filesystem::path& folder) {
    if (!root_.is_object()) throw FileError("the JSON text is no object; check that it is a glTF file");
    const std::string version = root_["asset"]["version"].string();
    if (!version.starts_with("2")) {
      throw FileError(version.empty()
                          ? std::string("'asset' with a version is missing; check that it is a glTF file")
                          : fmt::format("glTF version {}, but only version 2 is supported; convert the file",
                                        version.substr(0, 20)));
    }
    accessors_ = root_["accessors"].elements();
    views_ = root_["bufferViews"].elements();
    meshes_ = root_["meshes"].elements();
    file_.buffers = GltfBuffers(root_["buffers"].elements(), file_.bytes, file_.container, folder);
    file_.stores_float32 = true;
    places_ = places_of_meshes(root_, meshes_.size());

    collect_primitives();
    build_blocks();
    find_other_uses();
    build_faces();
    place_vertices();
    notes();
  }

 private:
  struct Primitive {
    std::size_t mesh = 0, number = 0, mode = triangles;
    std::size_t positions = 0;  ///< accessor
    Value indices, material;
  };

  static std::string name_of(const Value& named, const char* kind, std::size_t id) {
    return named["name"].is_string() ? named["name"].string() : fmt::format("{} {}", kind, id);
  }
  std::string where(const Primitive& p) const {
    return fmt::format("mesh {} ({}), primitive {}", p.mesh, name_of(meshes_[p.mesh], "mesh", p.mesh), p.number);
  }
  static std::size_t member_index(const Value& of, const char* key, std::size_t otherwise, const std::string& where) {
    const Value value = of[key];
    if (!value) return otherwise;
    const std::optional<std::size_t> result = value.index();
    if (!result) throw FileError(fmt::format("{}: '{}' is no whole number; the file is damaged", where, key));
    return *result;
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
                          "decompress the file first");
        }
        p.positions = member_index(json["attributes"], "POSITION", 0, where(p));
        p.indices = json["indices"];
        p.material = json["material"];
        if (!file_.accessors.contains(p.positions)) {
          PositionAccessor accessor;
          accessor.layout = layout(p.positions, "VEC3", where(p) + ", POSITION");
          accessor.json = accessors_[p.positions];
          file_.accessors[p.positions] = accessor;
          order_.push_back(p.positions);
        }
        primitives_.push_back(p);
      }
    }
  }

  /// Checked against the view and the buffer: all elements are there.
  Layout layout(std::size_t id, const char* type, const std::string& user) const {
    const std::string name = fmt::format("{}: accessor {}", user, id);
    if (id >= accessors_.size()) {
      throw FileError(fmt::format("{} does not exist, the file has {}; it is damaged", name, accessors_.size()));
    }
    const Value& accessor = accessors_[id];
    if (accessor["sparse"]) throw FileError(name + " is sparse, which is not supported; store it in full");
    if (accessor["type"].string() != type) {
      throw FileError(fmt::format("{} should be of type {}; the file is damaged", name, type));
    }
    Layout result;
    result.component_type = member_index(accessor, "componentType", 0, name);
    std::size_t size = 0;
    if (std::string_view(type) == "VEC3") {
      if (result.component_type != single) {
        throw FileError(name +
                        " is quantised (KHR_mesh_quantization), which is not supported; "
                        "convert the positions to 32-bit floats first");
      }
      size = position_size;
    } else {
      size = result.component_type == unsigned_byte ? 1 : result.component_type == unsigned_short ? 2 : 4;
      if (size == 4 && result.component_type != unsigned_int) {
        throw FileError(name + ": indices should be unsigned integers; the file is damaged");
      }
    }
    result.count = member_index(accessor, "count", 0, name);
    if (!accessor["bufferView"]) {
      throw FileError(name + " has no bufferView; geometry that an extension stores elsewhere is not supported");
    }
    const std::size_t view_id = member_index(accessor, "bufferView", 0, name);
    if (view_id >= views_.size())
      throw FileError(fmt::format("{}: bufferView {} does not exist; it is damaged", name, view_id));
    const Value& view = views_[view_id];
    for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      if (view["extensions"][extension]) {
        throw FileError(
            fmt::format("{}: compressed with {}, which is not supported; decompress the file first", name, extension));
      }
    }
    result.buffer = file_.buffers.resolve(member_index(view, "buffer", std::numeric_limits<std::size_t>::max(), name));
    result.stride = member_index(view, "byteStride", size, name);
    if (result.stride < size || result.stride > 1u << 20) {
      throw FileError(fmt::format("{}: a byteStride of {} is impossible; the file is damaged", name, result.stride));
    }
    const std::size_t view_start = member_index(view, "byteOffset", 0, name);
    const std::size_t view_size = member_index(view, "byteLength", 0, name);
    const std::size_t start = member_index(accessor, "byteOffset", 0, name);
    const std::size_t available = file_.buffers.data(result.buffer).size();
    if (view_start > available || view_size > available - view_start) {
      throw FileError(
          fmt::format("{}: bufferView {} reaches beyond its buffer of {} bytes; the file is cut short or damaged", name,
                      view_id, available));
    }
    if (result.count > 0 && (start > view_size || view_size - start < size ||
                             (view_size - start - size) / result.stride < result.count - 1)) {
      throw FileError(
          fmt::format("{}: {} elements do not fit into bufferView {} of {} bytes; the file is cut short or damaged",
                      name, result.count, view_id, view_size));
    }
    result.start = view_start + start;
    return result;
  }

  /// Accessors that share bytes (several views of one vertex buffer) become one block, so that each number has one
  /// vertex.
  void build_blocks() {
    const auto key = [this](std::size_t id) {
      const Layout& l = file_.accessors[id].layout;
      return std::array{l.buffer, l.stride, l.start % l.stride, l.start};
    };
    std::map<std::size_t, std::size_t> rank;
    for (const std::size_t id : order_) rank.try_emplace(id, rank.size());
    std::vector<std::size_t> sorted = order_;
    std::sort(sorted.begin(), sorted.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(key(a), rank[a]) < std::pair(key(b), rank[b]); });
    struct Group {
      Layout layout;
      std::size_t rank;
      std::vector<std::size_t> members;
    };
    std::vector<Group> groups;
    for (const std::size_t id : sorted) {
      const Layout& l = file_.accessors[id].layout;
      if (!groups.empty()) {
        Layout& last = groups.back().layout;
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
        PositionAccessor& accessor = file_.accessors[id];
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
    for (const Block& block : file_.blocks) ++blocks_in[block.layout.buffer];
    std::map<std::size_t, std::vector<bool>> claimed;
    for (const Block& block : file_.blocks) {
      const Layout& l = block.layout;
      if (blocks_in[l.buffer] < 2) continue;
      std::vector<bool>& bytes = claimed.try_emplace(l.buffer, file_.buffers.data(l.buffer).size()).first->second;
      for (std::size_t i = 0; i < l.count; ++i) {
        for (std::size_t byte = 0; byte < position_size; ++byte) {
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
      Block& block = file_.blocks[found->second.block];
      if (block.other_use.empty()) {
        file_.notes.push_back(
            fmt::format("Accessor {} holds positions and {}; a repair would have to change both, so it is "
                        "refused where these vertices have to move.",
                        *id, what));
      }
      block.other_use = what;
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

  std::vector<std::int32_t> corners_of(const Primitive& p) {
    const PositionAccessor& positions = file_.accessors[p.positions];
    const std::size_t base = file_.blocks[positions.block].first_vertex + positions.first_in_block;
    const std::size_t vertices = positions.layout.count;
    std::size_t count = vertices;
    Layout indices;
    std::string_view data;
    if (p.indices) {
      indices = layout(accessor_number(p.indices, where(p)), "SCALAR", where(p) + ", indices");
      data = file_.buffers.data(indices.buffer);
      count = indices.count;
    }
    limit_corners(count * (p.mode == triangles ? 1 : 3), p);
    const auto vertex = [&](std::size_t i) {
      if (!p.indices) return static_cast<std::int32_t>(base + i);
      const char* at = data.data() + indices.start + i * indices.stride;
      const std::size_t id = indices.component_type == unsigned_byte    ? load<std::uint8_t>(at, std::endian::little)
                             : indices.component_type == unsigned_short ? load<std::uint16_t>(at, std::endian::little)
                                                                        : load<std::uint32_t>(at, std::endian::little);
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
    if (!result) throw FileError(where + ": 'indices' is no accessor; the file is damaged");
    return *result;
  }

  /// A small file can name the same indices again and again. No real one has more corners than this.
  void limit_corners(std::size_t more, const Primitive& p) {
    std::size_t most = file_.bytes.size();
    for (const Block& block : file_.blocks) most += block.layout.count * position_size;
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
      const PositionAccessor& positions = file_.accessors[p.positions];
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
    if (faces.count() == 0) file_.notes.emplace_back("The file has no faces.");
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
      const Block& block = file_.blocks[b];
      const std::string_view data = file_.buffers.data(block.layout.buffer);
      for (std::size_t i = 0; i < block.layout.count; ++i) {
        const std::size_t v = block.first_vertex + i;
        if (file_.placement_of_vertex[v] < 0) file_.placement_of_vertex[v] = block_placement_[b];
        const std::size_t offset = block.layout.start + i * block.layout.stride;
        const std::array<double, 3> local = as_double(load_position(data, offset));
        const std::array<double, 3> world = file_.placements[file_.placement_of_vertex[v]].to_world(local);
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

  void notes() {
    std::vector<std::string>& notes = file_.notes;
    std::set<std::size_t> shown;
    for (const Primitive& p : primitives_) shown.insert(p.mesh);
    std::size_t skinned = 0, hidden = 0, flat = 0, instanced = 0;
    for (const std::size_t m : shown) {
      const MeshPlace& place = places_[m];
      skinned += place.is_skinned;
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
  std::vector<Value> accessors_, views_, meshes_;
  std::vector<MeshPlace> places_;
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
