#include "unsnarl/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include "run/thread_limit.h"
#include "scene/prepared_surface.h"

namespace unsnarl {
namespace {

/// What formats call parts of each kind; the first is what a person calls them.
using KindNames = std::vector<std::string_view>;
const KindNames object_kinds = {"object", "node"}, group_kinds = {"group", "mesh"}, material_kinds = {"material"},
                file_kinds = {"file"};

bool is_of_kind(const FaceLabels& labels, const KindNames& kinds) {
  return std::find(kinds.begin(), kinds.end(), labels.kind) != kinds.end();
}

/// "body" names the part "body" and, as OBJ has it, each of "body left".
bool is_named(const std::string& label, const std::string& name) {
  if (label == name) return true;
  std::istringstream words(label);
  for (std::string word; words >> word;)
    if (word == name) return true;
  return false;
}

/// A message lists this many names of parts, at most (unit: names)
constexpr std::size_t names_in_message = 40;

std::string list_of_names(std::span<const FaceLabels> labels, const KindNames& kinds) {
  std::string text;
  std::size_t count = 0;
  for (const FaceLabels& label : labels) {
    if (!is_of_kind(label, kinds)) continue;
    for (const std::string& name : label.names)
      if (++count <= names_in_message) text += (text.empty() ? "'" : ", '") + name + "'";
  }
  if (count > names_in_message) text += fmt::format(" and {} more", count - names_in_message);
  return text;
}

/// Flags the faces called `name` in labels of these kinds.
void flag_named(std::span<const FaceLabels> labels, const KindNames& kinds, const std::string& name, bool by_words,
                std::vector<std::uint8_t>& faces) {
  bool found = false;
  for (const FaceLabels& label : labels) {
    if (!is_of_kind(label, kinds)) continue;
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
    if (!is_of_kind(label, kinds)) others += (others.empty() ? "" : ", ") + label.kind + "s";
  throw UnknownPart(known.empty() ? fmt::format("there is no {} '{}': the file names no {}s{}", kinds[0], name,
                                                kinds[0], others.empty() ? "" : ", only " + others)
                                  : fmt::format("there is no {} '{}'; there are: {}", kinds[0], name, known));
}

/// The parts of one kind of labels, with their faces and vertices.
std::vector<NamedPart> counted_parts(const SurfaceView& surface, const FaceLabels& labels, NamedPart::Kind kind) {
  std::vector<NamedPart> parts;
  for (const std::string& name : labels.names) parts.push_back({kind, name});
  std::vector<std::vector<std::int32_t>> faces_of(parts.size());
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    if (labels.of_face[f] >= 0) faces_of[labels.of_face[f]].push_back(static_cast<std::int32_t>(f));
  std::vector<std::size_t> counted_for(surface.vertex_count(), 0);  // the last part, from 1, that a vertex counted for
  for (std::size_t p = 0; p < parts.size(); ++p) {
    parts[p].faces = faces_of[p].size();
    for (const std::int32_t f : faces_of[p])
      for (const Index v : surface.face(f)) parts[p].vertices += std::exchange(counted_for[v], p + 1) != p + 1;
  }
  return parts;
}

}  // namespace

std::string_view to_string(NamedPart::Kind kind) {
  constexpr std::array<std::string_view, 3> names = {"object", "group", "material"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<NamedPart> named_parts(const SurfaceView& surface, std::span<const FaceLabels> labels) {
  std::vector<NamedPart> parts;
  for (const auto& [kinds, kind] :
       {std::pair{&object_kinds, NamedPart::Kind::object}, std::pair{&group_kinds, NamedPart::Kind::group},
        std::pair{&material_kinds, NamedPart::Kind::material}})
    for (const FaceLabels& of_kind : labels) {
      if (!is_of_kind(of_kind, *kinds)) continue;
      const std::vector<NamedPart> more = counted_parts(surface, of_kind, kind);
      parts.insert(parts.end(), more.begin(), more.end());
    }
  return parts;
}

std::string part_of_face(std::span<const FaceLabels> labels, std::int32_t face) {
  for (const KindNames* kinds : {&object_kinds, &group_kinds, &file_kinds})
    for (const FaceLabels& label : labels)
      if (is_of_kind(label, *kinds) && label.of_face[face] >= 0) return label.names[label.of_face[face]];
  return {};
}

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
  for (const std::string& name : parts.groups) flag_named(labels, group_kinds, name, true, faces);
  for (const std::string& name : parts.objects) flag_named(labels, object_kinds, name, false, faces);
  for (const std::string& name : parts.materials) flag_named(labels, material_kinds, name, false, faces);
  for (const std::string& name : parts.files) flag_named(labels, file_kinds, name, false, faces);
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
