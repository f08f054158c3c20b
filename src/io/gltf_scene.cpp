#include "io/gltf_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/portable_math.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

/// A placement counts as flat where its axes span less volume than this: mapping back would lose ten of the sixteen
/// digits of a double, more than float32 can spare (unit: volume of a box with edges of the axes' lengths)
constexpr double smallest_volume_share = 1e-10;

/// The skin of a mesh whose node names it by something that is no number.
constexpr std::size_t no_skin = std::numeric_limits<std::size_t>::max();

template <std::size_t N>
std::optional<std::array<double, N>> numbers(const JsonText::Value& array) {
  const std::vector<JsonText::Value> elements = array.elements();
  if (elements.size() != N) return std::nullopt;
  std::array<double, N> result{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::optional<double> value = elements[i].number();
    if (!value) return std::nullopt;
    result[i] = *value;
  }
  return result;
}

template <std::size_t N>
std::array<double, N> member(const JsonText::Value& node, std::size_t id, const char* key,
                             const std::array<double, N>& otherwise) {
  const JsonText::Value value = node[key];
  if (!value) return otherwise;
  const std::optional<std::array<double, N>> result = numbers<N>(value);
  if (!result) throw FileError(fmt::format("node {}: '{}' should be {} numbers; the file is damaged", id, key, N));
  return *result;
}

Placement local_transform(const JsonText::Value& node, std::size_t id) {
  if (node["matrix"]) {
    return Placement::of_columns(member<16>(node, id, "matrix", {}));
  }
  const auto t = member<3>(node, id, "translation", {0, 0, 0});
  const auto [x, y, z, w] = member<4>(node, id, "rotation", {0, 0, 0, 1});
  const auto s = member<3>(node, id, "scale", {1, 1, 1});
  return Placement({(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0],
                    2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1],
                    2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]});
}

std::vector<std::size_t> ids(const JsonText::Value& array) {
  std::vector<std::size_t> result;
  for (const JsonText::Value& element : array.elements()) {
    const std::optional<std::size_t> id = element.index();
    if (!id) throw FileError("a list of nodes holds something that is not a node number; the file is damaged");
    result.push_back(*id);
  }
  return result;
}

/// Roots of the default scene; of all nodes where the file has no scenes.
std::vector<std::size_t> scene_roots(const JsonText::Value& root, const std::vector<JsonText::Value>& nodes) {
  const std::vector<JsonText::Value> scenes = root["scenes"].elements();
  if (!scenes.empty()) {
    const JsonText::Value scene = root["scene"];
    const std::optional<std::size_t> id = scene ? scene.index() : 0;
    if (!id || *id >= scenes.size()) throw FileError("'scene' names a scene that does not exist; the file is damaged");
    return ids(scenes[*id]["nodes"]);
  }
  std::vector<bool> is_child(nodes.size());
  for (const JsonText::Value& node : nodes) {
    for (const std::size_t child : ids(node["children"])) {
      if (child < nodes.size()) is_child[child] = true;
    }
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!is_child[i]) result.push_back(i);
  }
  return result;
}

}  // namespace

Placement::Placement(const std::array<double, 12>& rows) : rows_(rows) {
  is_identity_ = rows_ == Placement().rows_;
  const auto cofactor = [this](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return rows_[4 * r1 + c1] * rows_[4 * r2 + c2] - rows_[4 * r1 + c2] * rows_[4 * r2 + c1];
  };
  double determinant = 0, box = 1;
  for (int c = 0; c < 3; ++c) {
    determinant += rows_[c] * cofactor(0, c);
    box *= portable::length(rows_[c], rows_[4 + c], rows_[8 + c]);
  }
  is_invertible_ = std::isnormal(determinant) && std::abs(determinant) > smallest_volume_share * box;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      inverse_[3 * r + c] = cofactor(c, r) / determinant;
      is_invertible_ &= std::isfinite(inverse_[3 * r + c]);
    }
    is_invertible_ &= std::isfinite(rows_[4 * r + 3]);
  }
}

std::array<double, 3> Placement::to_world(const std::array<double, 3>& p) const {
  if (is_identity_) return p;
  std::array<double, 3> result{};
  for (int r = 0; r < 3; ++r) {
    result[r] = rows_[4 * r] * p[0] + rows_[4 * r + 1] * p[1] + rows_[4 * r + 2] * p[2] + rows_[4 * r + 3];
  }
  return result;
}

std::array<double, 3> Placement::to_local(const std::array<double, 3>& world) const {
  if (is_identity_) return world;
  const double x = world[0] - rows_[3], y = world[1] - rows_[7], z = world[2] - rows_[11];
  std::array<double, 3> result{};
  for (int r = 0; r < 3; ++r) {
    result[r] = inverse_[3 * r] * x + inverse_[3 * r + 1] * y + inverse_[3 * r + 2] * z;
  }
  return result;
}

Placement Placement::operator*(const Placement& inner) const {
  if (is_identity_) return inner;
  if (inner.is_identity_) return *this;
  std::array<double, 12> rows{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      double sum = c == 3 ? rows_[4 * r + 3] : 0;
      for (int k = 0; k < 3; ++k) sum += rows_[4 * r + k] * inner.rows_[4 * k + c];
      rows[4 * r + c] = sum;
    }
  }
  return Placement(rows);
}

ScenePlaces places_in_scene(const JsonText::Value& root, std::size_t mesh_count) {
  const std::vector<JsonText::Value> nodes = root["nodes"].elements();
  ScenePlaces places{std::vector<MeshPlace>(mesh_count), std::vector<std::optional<Placement>>(nodes.size())};
  struct Visit {
    std::size_t node;
    Placement parent;
  };
  std::vector<Visit> stack;  // depth first, in the order of the file
  const auto push = [&](const std::vector<std::size_t>& children, const Placement& parent) {
    for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, parent});
  };
  push(scene_roots(root, nodes), {});
  while (!stack.empty()) {
    const auto [id, parent] = stack.back();
    stack.pop_back();
    if (id >= nodes.size()) {
      throw FileError(fmt::format("node {} is used, but the file has {} nodes; it is damaged", id, nodes.size()));
    }
    if (places.of_nodes[id])
      throw FileError(fmt::format("node {} has several parents or contains itself; the file is damaged", id));
    const JsonText::Value& node = nodes[id];
    const Placement world = parent * local_transform(node, id);
    places.of_nodes[id] = world;
    push(ids(node["children"]), world);

    if (!node["mesh"]) continue;
    const std::optional<std::size_t> mesh = node["mesh"].index();
    if (!mesh || *mesh >= mesh_count) {
      throw FileError(fmt::format("node {} shows mesh {}, but the file has {} meshes; it is damaged", id,
                                  node["mesh"].text().substr(0, 20), mesh_count));
    }
    MeshPlace& place = places.of_meshes[*mesh];
    ++place.instances;
    // The joints alone place a skinned mesh; the transform of its node does not count (glTF 2.0, section 3.7.3.3).
    const bool is_skinned = static_cast<bool>(node["skin"]);
    const Placement placement = is_skinned ? Placement() : world;
    const bool is_first_usable = place.instances == 1 || (place.was_flat && placement.is_invertible());
    if (!is_first_usable) continue;
    place.node = node["name"].is_string() ? node["name"].string() : fmt::format("node {}", id);
    place.skin = is_skinned ? std::optional(node["skin"].index().value_or(no_skin)) : std::nullopt;
    place.was_flat = !placement.is_invertible();
    place.placement = place.was_flat ? Placement() : placement;
  }
  return places;
}

}  // namespace unsnarl
