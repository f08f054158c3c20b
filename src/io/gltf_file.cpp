#include "io/gltf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/byte_order.h"
#include "io/token_edits.h"
#include "io/vertex_normals.h"
#include "text/write_number.h"

namespace unsnarl {
namespace {

/// In the JSON text, a float with the fewest digits.
std::string number_text(float value) {
  std::array<char, 32> digits;
  return {digits.data(), write_number(digits.data(), digits.data() + digits.size(), value)};
}

}  // namespace

GltfFile::Local GltfFile::stored(const GltfBlock& block, std::size_t vertex) const {
  return load_position(buffers.data(block.layout.buffer), offset_of(block, vertex));
}

GltfFile::Local GltfFile::wanted(const GltfBlock& block, std::size_t vertex, std::span<const double> positions) const {
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
  for (const GltfBlock& block : blocks) {
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
      const std::array<double, 3> world =
          placements[placement_of_vertex[v]].to_world(std::array<double, 3>{local[0], local[1], local[2]});
      std::copy(world.begin(), world.end(), result.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
  return result;
}

std::vector<OutputFile> GltfFile::patched_as(const std::string&, const std::string& infix,
                                             std::span<const double> positions, bool float32_digits) const {
  const std::vector<double> written = as_written(positions, float32_digits);  // refuses what cannot be changed
  std::map<std::size_t, std::string> changed;
  std::vector<bool> block_changed(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const GltfBlock& block = blocks[b];
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
  if (recompute_normals && !changed.empty()) turn_normals(positions, changed);
  std::vector<TextEdit> edits;
  for (const auto& [id, accessor] : accessors) {
    if (block_changed[accessor.block]) update_bounds(accessor, changed.at(accessor.layout.buffer), edits);
  }
  return buffers.rebuilt(bytes, container, std::move(edits), std::move(changed), infix);
}

bool GltfFile::has_vertex_normals() const {
  return std::any_of(accessors.begin(), accessors.end(), [](const auto& a) { return a.second.normals.has_value(); });
}

void GltfFile::turn_normals(std::span<const double> positions, std::map<std::size_t, std::string>& changed) const {
  std::vector<double> before(positions.size()), after(positions.size()), normals(positions.size());
  for (const GltfBlock& block : blocks) {
    for (std::size_t v = block.first_vertex; v < block.first_vertex + block.layout.count; ++v) {
      const Local old = stored(block, v), moved = wanted(block, v, positions);
      std::copy(old.begin(), old.end(), before.begin() + static_cast<std::ptrdiff_t>(3 * v));
      std::copy(moved.begin(), moved.end(), after.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
  // A vertex that two accessors share has the normal of the first one; that of the other stays.
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> buffer_of(positions.size() / 3, none), offset_of_normal(positions.size() / 3);
  for (const auto& [id, accessor] : accessors) {
    for (std::size_t i = 0; accessor.normals && i < accessor.layout.count; ++i) {
      const std::size_t v = blocks[accessor.block].first_vertex + accessor.first_in_block + i;
      if (buffer_of[v] != none) continue;
      buffer_of[v] = accessor.normals->buffer;
      offset_of_normal[v] = accessor.normals->start + i * accessor.normals->stride;
      const Local normal = load_position(buffers.data(buffer_of[v]), offset_of_normal[v]);
      std::copy(normal.begin(), normal.end(), normals.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
  }
  const std::vector<double> turned =
      turned_normals({before, surface.corners, surface.offsets}, after, normals, surface.corners);
  for (std::size_t v = 0; v < buffer_of.size(); ++v) {
    if (buffer_of[v] == none) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = static_cast<float>(turned[3 * v + k]);
      if (!(value != static_cast<float>(normals[3 * v + k])) || !std::isfinite(value)) continue;
      std::string& data = changed.try_emplace(buffer_of[v], buffers.data(buffer_of[v])).first->second;
      store(data.data() + offset_of_normal[v] + 4 * k, value, std::endian::little);
    }
  }
}

void GltfFile::update_bounds(const GltfPositions& accessor, std::string_view data, std::vector<TextEdit>& edits) const {
  const AccessorLayout& layout = accessor.layout;
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
    const std::vector<JsonText::Value> tokens = accessor.json[key].elements();
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

}  // namespace unsnarl
