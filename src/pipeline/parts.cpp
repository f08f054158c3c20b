#include "unsnarl/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "geometry/parallel.h"
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

using FaceFlags = std::vector<std::uint8_t>;

/// Finds the parts that rules name (see allowed_pairs).
class RuleNames {
 public:
  RuleNames(const SurfaceView& surface, std::span<const FaceLabels> labels, const FindOptions& options)
      : surface_(surface), labels_(labels), options_(options) {}

  /// The faces of a part, "kind=name" or a name of any kind; none: there is no such part. Throws std::invalid_argument
  /// where parts of several kinds have this name.
  std::optional<FaceFlags> faces_of(const std::string& text) const {
    for (const Kind& kind : kinds)
      if (text.starts_with(kind.prefix)) return of_kind(kind, rest(text, kind));
    std::optional<FaceFlags> found;
    std::string_view found_kind;
    for (const Kind& kind : kinds) {
      std::optional<FaceFlags> more = of_kind(kind, text);
      if (!more || (found && (*more == *found || kind.is_component))) continue;
      if (found)
        throw std::invalid_argument(fmt::format("'{0}' is the name of several parts; say which, as in {1}{0} or {2}{0}",
                                                text, found_kind, kind.prefix));
      found = std::move(more);
      found_kind = kind.prefix;
    }
    return found;
  }

  /// Throws UnknownPart, which says what parts there are.
  [[noreturn]] void complain_of(const std::string& text) const {
    for (const Kind& kind : kinds)
      if (text.starts_with(kind.prefix)) faces_in_parts(surface_, labels_, kind.named(rest(text, kind)), options_);
    throw UnknownPart(fmt::format("there is no part '{}'; there are: {}", text, known()));
  }

 private:
  /// All names, for a message.
  std::string known() const {
    std::string text;
    for (const Kind& kind : kinds) {
      if (kind.is_component) continue;
      const std::string names = list_of_names(labels_, *kind.labels);
      if (!names.empty()) text += fmt::format("{}{}s {}", text.empty() ? "" : "; ", kind.labels->front(), names);
    }
    return text + (text.empty() ? "" : "; ") + "the numbers of components ('unsnarl check' lists them)";
  }

  struct Kind {
    std::string_view prefix;
    const KindNames* labels;
    bool is_component;
    Parts (*named)(const std::string& name);
  };
  static const std::array<Kind, 5> kinds;

  static std::string rest(const std::string& text, const Kind& kind) { return text.substr(kind.prefix.size()); }
  static Parts component_named(const std::string& name) {
    std::int32_t number = -1;
    const char* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data(), end, number);
    if (error != std::errc() || stop != end || number < 0)
      throw UnknownPart(fmt::format("component={} is not the number of a component, counted from 0", name));
    return {.components = {number}};
  }

  /// The components are found once for all rules.
  std::optional<FaceFlags> of_component(std::int32_t number) const {
    if (!component_of_) component_of_ = component_of_faces(surface_, options_);
    FaceFlags faces;
    for (const std::int32_t component : *component_of_) faces.push_back(component == number);
    if (std::find(faces.begin(), faces.end(), 1) == faces.end()) return std::nullopt;
    return faces;
  }

  std::optional<FaceFlags> of_kind(const Kind& kind, const std::string& name) const {
    try {
      if (kind.is_component) return of_component(kind.named(name).components.front());
      return faces_in_parts(surface_, labels_, kind.named(name), options_);
    } catch (const UnknownPart&) {
      return std::nullopt;
    }
  }

  const SurfaceView& surface_;
  std::span<const FaceLabels> labels_;
  const FindOptions& options_;
  mutable std::optional<std::vector<std::int32_t>> component_of_;
};
const std::array<RuleNames::Kind, 5> RuleNames::kinds = {{
    {"file=", &file_kinds, false, [](const std::string& name) -> Parts { return {.files = {name}}; }},
    {"object=", &object_kinds, false, [](const std::string& name) -> Parts { return {.objects = {name}}; }},
    {"group=", &group_kinds, false, [](const std::string& name) -> Parts { return {.groups = {name}}; }},
    {"material=", &material_kinds, false, [](const std::string& name) -> Parts { return {.materials = {name}}; }},
    {"component=", nullptr, true, component_named},
}};

/// Two sets of faces that may pass through each other; the same set twice: through itself.
using Rule = std::array<FaceFlags, 2>;

/// The sets of faces that a rule names. Names may hold colons: the way to read it counts in which all parts are known.
Rule rule_of(const RuleNames& names, const std::string& text) {
  std::vector<Rule> readings;
  if (const auto faces = names.faces_of(text)) readings.push_back({*faces, *faces});
  std::string unknown = text;
  for (std::size_t colon = text.find(':'); colon != std::string::npos; colon = text.find(':', colon + 1)) {
    const std::string first = text.substr(0, colon), second = text.substr(colon + 1);
    const auto a = names.faces_of(first), b = names.faces_of(second);
    if (a && b) readings.push_back({*a, *b});
    if (a.has_value() != b.has_value() || text.find(':') == text.rfind(':')) unknown = a ? second : first;
  }
  if (readings.empty()) names.complain_of(unknown);
  if (readings.size() > 1)
    throw std::invalid_argument(
        fmt::format("'{}' can be read in {} ways, since names hold colons; say which part is of which kind, as in "
                    "object=A:object=B",
                    text, readings.size()));
  return readings.front();
}

/// Splits parts into the faces that are flagged and those that are not; parts keep the order of their first faces.
void refine(const FaceFlags& flags, std::vector<std::int32_t>& part_of_face) {
  std::map<std::pair<std::int32_t, std::uint8_t>, std::int32_t> number;
  for (std::size_t f = 0; f < flags.size(); ++f) {
    const auto next = static_cast<std::int32_t>(number.size());
    part_of_face[f] = number.try_emplace({part_of_face[f], flags[f]}, next).first->second;
  }
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

/// Calls visit(labels, kind) for those that Parts names: objects, then groups, then materials.
template <class Visit>
void for_each_named_kind(std::span<const FaceLabels> labels, const Visit& visit) {
  for (const auto& [kinds, kind] :
       {std::pair{&object_kinds, NamedPart::Kind::object}, std::pair{&group_kinds, NamedPart::Kind::group},
        std::pair{&material_kinds, NamedPart::Kind::material}})
    for (const FaceLabels& of_kind : labels)
      if (is_of_kind(of_kind, *kinds)) visit(of_kind, kind);
}

}  // namespace

std::string_view to_string(NamedPart::Kind kind) {
  constexpr std::array<std::string_view, 3> names = {"object", "group", "material"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<NamedPart> named_parts(const SurfaceView& surface, std::span<const FaceLabels> labels) {
  std::vector<NamedPart> parts;
  for_each_named_kind(labels, [&](const FaceLabels& of_kind, NamedPart::Kind kind) {
    const std::vector<NamedPart> more = counted_parts(surface, of_kind, kind);
    parts.insert(parts.end(), more.begin(), more.end());
  });
  return parts;
}

std::vector<FaceLabels> parts_of_faces(const SurfaceView& surface, std::span<const FaceLabels> labels,
                                       const FindOptions& options) {
  std::vector<FaceLabels> parts = {{"component", {}, component_of_faces(surface, options)}};
  for_each_named_kind(labels, [&](const FaceLabels& of_kind, NamedPart::Kind kind) {
    parts.push_back({std::string(to_string(kind)), of_kind.names, of_kind.of_face});
  });
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

AllowedPairs allowed_pairs(const SurfaceView& surface, std::span<const FaceLabels> labels,
                           std::span<const std::string> rules, const FindOptions& options) {
  AllowedPairs allowed;
  if (rules.empty()) return allowed;
  const RuleNames names(surface, labels, options);
  std::vector<Rule> all;
  for (const std::string& text : rules) all.push_back(rule_of(names, text));
  allowed.part_of_face.assign(surface.face_count(), 0);
  for (const Rule& rule : all)
    for (const FaceFlags& flags : rule) refine(flags, allowed.part_of_face);
  std::vector<std::size_t> face_of_part;  // the first
  for (std::size_t f = 0; f < surface.face_count(); ++f)
    if (allowed.part_of_face[f] == static_cast<std::int32_t>(face_of_part.size())) face_of_part.push_back(f);
  for (std::size_t p = 0; p < face_of_part.size(); ++p)
    for (std::size_t q = p; q < face_of_part.size(); ++q) {
      const auto f = face_of_part[p], g = face_of_part[q];
      if (std::any_of(all.begin(), all.end(),
                      [&](const Rule& rule) { return (rule[0][f] && rule[1][g]) || (rule[0][g] && rule[1][f]); }))
        allowed.parts.push_back({static_cast<std::int32_t>(p), static_cast<std::int32_t>(q)});
    }
  return allowed;
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
