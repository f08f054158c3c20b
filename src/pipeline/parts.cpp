#include "unsnarl/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "pipeline/threads.h"
#include "scene/prepared_surface.h"

namespace unsnarl {
namespace {

/// "body" names the part "body" and, as OBJ has it, each of "body left".
bool is_named(const std::string& label, const std::string& name) {
  if (label == name) return true;
  std::istringstream words(label);
  for (std::string word; words >> word;)
    if (word == name) return true;
  return false;
}

constexpr std::size_t names_in_message = 40;

std::string list_of_names(std::span<const FaceLabels> labels, const std::vector<std::string_view>& kinds) {
  std::string text;
  std::size_t count = 0;
  for (const FaceLabels& label : labels) {
    if (std::find(kinds.begin(), kinds.end(), label.kind) == kinds.end()) continue;
    for (const std::string& name : label.names)
      if (++count <= names_in_message) text += (text.empty() ? "'" : ", '") + name + "'";
  }
  if (count > names_in_message) text += fmt::format(" and {} more", count - names_in_message);
  return text;
}

/// Flags the faces called `name` in labels of these kinds; the first kind is what a person calls it.
void flag_named(std::span<const FaceLabels> labels, const std::vector<std::string_view>& kinds, const std::string& name,
                bool by_words, std::vector<std::uint8_t>& faces) {
  bool found = false;
  for (const FaceLabels& label : labels) {
    if (std::find(kinds.begin(), kinds.end(), label.kind) == kinds.end()) continue;
    std::vector<std::uint8_t> matches;
    for (const std::string& known : label.names) matches.push_back(by_words ? is_named(known, name) : known == name);
    found |= std::find(matches.begin(), matches.end(), 1) != matches.end();
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (label.of_face[f] >= 0 && matches[label.of_face[f]]) faces[f] = 1;
  }
  if (found) return;
  const std::string known = list_of_names(labels, kinds);
  std::string others;
  for (const FaceLabels& label : labels)
    if (std::find(kinds.begin(), kinds.end(), label.kind) == kinds.end())
      others += (others.empty() ? "" : ", ") + label.kind + "s";
  throw UnknownPart(known.empty() ? fmt::format("there is no {} '{}': the file names no {}s{}", kinds[0], name,
                                                kinds[0], others.empty() ? "" : ", only " + others)
                                  : fmt::format("there is no {} '{}'; there are: {}", kinds[0], name, known));
}

}  // namespace

std::vector<std::int32_t> component_of_faces(const SurfaceView& surface, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  const std::span<const Triangle> triangles = prepared.triangles();
  const Components components = find_components(surface, prepared.weld_map, triangles, build_edges(triangles));
  std::vector<std::int32_t> component_of(surface.face_count());
  for (std::size_t f = 0; f < component_of.size(); ++f)
    component_of[f] = component_of_face(surface, prepared.weld_map, components, static_cast<Index>(f));
  return component_of;
}

std::vector<std::uint8_t> faces_in_parts(const SurfaceView& surface, std::span<const FaceLabels> labels,
                                         const Parts& parts, const FindOptions& options) {
  std::vector<std::uint8_t> faces(surface.face_count(), 0);
  for (const std::string& name : parts.groups) flag_named(labels, {"group", "mesh"}, name, true, faces);
  for (const std::string& name : parts.objects) flag_named(labels, {"object", "node"}, name, false, faces);
  for (const std::string& name : parts.materials) flag_named(labels, {"material"}, name, false, faces);
  for (const std::string& name : parts.files) flag_named(labels, {"file"}, name, false, faces);
  if (parts.components.empty()) return faces;
  const std::vector<std::int32_t> component_of = component_of_faces(surface, options);
  const std::int32_t count = component_of.empty() ? 0 : *std::max_element(component_of.begin(), component_of.end()) + 1;
  for (const std::int32_t component : parts.components) {
    if (component < 0 || component >= count)
      throw UnknownPart(count == 0 ? fmt::format("there is no component {}: the mesh has no faces", component)
                                   : fmt::format("there is no component {}; the mesh has {}, counted from 0 "
                                                 "('unsnarl check' lists them)",
                                                 component, count));
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] |= component_of[f] == component;
  }
  return faces;
}

std::vector<std::uint8_t> vertices_of_faces(const SurfaceView& surface, std::span<const std::uint8_t> faces) {
  std::vector<std::uint8_t> vertices(surface.vertex_count(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f])
      for (const Index v : surface.face(f)) vertices[v] = 1;
  return vertices;
}

std::vector<std::uint8_t> boundary_vertices(const SurfaceView& surface, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  const EdgeTable table = build_edges(prepared.triangles());
  std::vector<std::uint8_t> on_boundary(prepared.weld_map.count, 0);
  for (std::size_t e = 0; e < table.edges.size(); ++e)
    if (table.triangles_of_edge[static_cast<Index>(e)].size() == 1)
      for (const Index v : table.edges[e]) on_boundary[v] = 1;
  std::vector<std::uint8_t> vertices(surface.vertex_count(), 0);
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = on_boundary[prepared.weld_map.vertex_of[v]];
  return vertices;
}

}  // namespace unsnarl
