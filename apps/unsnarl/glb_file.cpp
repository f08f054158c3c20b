#include "glb_file.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace unsnarl::app {
namespace {

using Json = nlohmann::ordered_json;

// Values of the format.
constexpr int of_float32 = 5126, of_uint32 = 5125;          // component types
constexpr int vertex_buffer = 34962, index_buffer = 34963;  // targets

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((word >> shift) & 0xFF);
}

std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void append_chunk(std::string& file, const char* type, std::string bytes, char padding) {
  bytes.resize((bytes.size() + 3) / 4 * 4, padding);
  append_word(file, static_cast<std::uint32_t>(bytes.size()));
  file.append(type, 4);
  file += bytes;
}

}  // namespace

std::string glb_file(const SurfaceView& surface, std::span<const std::int32_t> part_of,
                     const std::vector<std::string>& names, const std::string& generator) {
  Json views = Json::array(), accessors = Json::array(), meshes = Json::array(), nodes = Json::array();
  std::string buffer;
  const auto add_view = [&](const std::string& bytes, int target, int type, std::size_t count, const char* shape) {
    views.push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}, {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1}, {"componentType", type}, {"count", count}, {"type", shape}});
    buffer += bytes;
    return accessors.size() - 1;
  };
  const std::int32_t parts = part_of.empty() ? 0 : *std::max_element(part_of.begin(), part_of.end()) + 1;
  for (std::int32_t part = 0; part < parts; ++part) {
    std::vector<std::int64_t> number(surface.vertex_count(), -1);  // of each vertex within the part
    std::vector<float> low(3), high(3);
    std::string positions, indices;
    std::int64_t count = 0;
    std::size_t corners = 0;
    const auto add_corner = [&](std::int32_t v) {
      std::int64_t& own = number[static_cast<std::size_t>(v)];
      if (own < 0) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto value = static_cast<float>(surface.positions[3 * static_cast<std::size_t>(v) + k]);
          low[k] = count == 0 ? value : std::min(low[k], value);
          high[k] = count == 0 ? value : std::max(high[k], value);
          append_word(positions, bits_of(value));
        }
        own = count++;
      }
      append_word(indices, static_cast<std::uint32_t>(own));
      ++corners;
    };
    for (std::size_t f = 0; f < surface.face_count(); ++f) {
      if (part_of[f] != part) continue;
      const auto face = surface.face(f);
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        for (const std::int32_t v : {face[0], face[k], face[k + 1]}) add_corner(v);
    }
    if (corners == 0) continue;
    const std::size_t position =
        add_view(positions, vertex_buffer, of_float32, static_cast<std::size_t>(count), "VEC3");
    accessors.back()["min"] = low;
    accessors.back()["max"] = high;
    const std::size_t index = add_view(indices, index_buffer, of_uint32, corners, "SCALAR");
    const std::string& name = names[static_cast<std::size_t>(part)];
    meshes.push_back({{"name", name},
                      {"primitives", Json::array({{{"attributes", {{"POSITION", position}}}, {"indices", index}}})}});
    nodes.push_back({{"name", name}, {"mesh", meshes.size() - 1}});
  }
  Json scene_nodes = Json::array();
  for (std::size_t k = 0; k < nodes.size(); ++k) scene_nodes.push_back(k);
  const Json json = {{"asset", {{"version", "2.0"}, {"generator", generator}}},
                     {"scene", 0},
                     {"scenes", Json::array({{{"nodes", scene_nodes}}})},
                     {"nodes", nodes},
                     {"meshes", meshes},
                     {"accessors", accessors},
                     {"bufferViews", views},
                     {"buffers", Json::array({{{"byteLength", buffer.size()}}})}};
  std::string chunks;
  append_chunk(chunks, "JSON", json.dump(), ' ');
  append_chunk(chunks, "BIN\0", std::move(buffer), '\0');
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, static_cast<std::uint32_t>(12 + chunks.size()));
  return file + chunks;
}

}  // namespace unsnarl::app
