// 3MF (3MF Core Specification 1.3): a ZIP archive whose model part is patched. The meshes of its objects are seen where
// the build shows them first.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "io/formats.h"
#include "io/gltf_scene.h"
#include "io/point_file.h"
#include "io/surface_builder.h"
#include "io/text_scanner.h"
#include "io/token_edits.h"
#include "io/xml_text.h"
#include "io/zip_archive.h"
#include "unsnarl/depth_limit.h"

namespace unsnarl {
namespace {

class ThreemfFile final : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    const TextPrecision digits = precision(float32_digits);
    std::vector<TextEdit> edits;
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      const std::array<double, 3> local = wanted(v, positions, digits);
      for (std::size_t k = 0; k < 3; ++k) {
        const NumberToken& token = tokens[3 * v + k];
        if (local[k] != locals[v][k])
          edits.push_back({token.begin, token.begin + token.length, number_text(local[k], digits)});
      }
    }
    if (edits.empty()) return {{{}, bytes}};
    return {{{}, ZipArchive(bytes).with_content(model_name, with_edits(model, std::move(edits)))}};
  }

  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const override {
    std::vector<double> result = surface.positions;
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      const std::array<double, 3> local = wanted(v, positions, precision(float32_digits));
      if (local == locals[v]) continue;
      const std::array<double, 3> world = placements[placement_of_vertex[v]].to_world(local);
      std::copy(world.begin(), world.end(), result.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
    return result;
  }

  std::string model_name, model;  ///< the part that holds the meshes
  std::vector<std::array<double, 3>> locals;
  std::vector<NumberToken> tokens;  ///< in `model`, 3 a vertex
  std::vector<Placement> placements;
  std::vector<std::size_t> placement_of_vertex;

 private:
  static TextPrecision precision(bool float32_digits) {
    return float32_digits ? TextPrecision::float_digits : TextPrecision::double_digits;
  }
  /// The numbers to store for a vertex; those stored where it did not move.
  std::array<double, 3> wanted(std::size_t v, std::span<const double> positions, TextPrecision digits) const {
    std::array<double, 3> local = locals[v];
    const std::array<double, 3> world = {positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
    if (std::equal(world.begin(), world.end(), surface.positions.begin() + static_cast<std::ptrdiff_t>(3 * v)))
      return local;
    const std::array<double, 3> exact = placements[placement_of_vertex[v]].to_local(world);
    for (std::size_t k = 0; k < 3; ++k) {
      const double written = exact[k] == local[k] ? local[k] : value_as_written(exact[k], digits);
      if (written != local[k]) local[k] = written;
    }
    return local;
  }
};

class ThreemfParser {
 public:
  explicit ThreemfParser(ThreemfFile& file) : file_(file), xml_(file.model, "model") {}

  void parse() {
    for (const pugi::xml_node& object : xml_.root().child("resources").children("object")) {
      if (!object_of_id_.try_emplace(object.attribute("id").value(), object).second)
        xml_.fail(object, fmt::format("object {} is there twice; the file is damaged", name_of(object)));
    }
    for (const pugi::xml_node& item : xml_.root().child("build").children("item")) {
      refuse_other_part(item);
      show(item, Placement());
    }
    std::size_t hidden = 0;
    for (const pugi::xml_node& object : xml_.root().child("resources").children("object"))
      hidden += object.child("mesh") && !shown_.contains(object.attribute("id").value());
    if (shown_.empty()) xml_.fail(xml_.root(), "the build shows no object with a mesh; the file is damaged or empty");
    if (hidden > 0)
      file_.notes.push_back(fmt::format("Objects that the build does not show ({}) stay as they are.", hidden));
    if (!repeated_.empty())
      file_.notes.push_back(fmt::format(
          "Objects that the build shows several times ({}) are repaired where it shows them first; the others "
          "follow.",
          repeated_.size()));
    faces_.note_ignored(file_.notes);
    objects_.finish(faces_.count(), file_.labels);
  }

 private:
  static std::string name_of(const pugi::xml_node& object) {
    const std::string_view name = object.attribute("name").value();
    return name.empty() ? fmt::format("object {}", object.attribute("id").value()) : std::string(name);
  }
  /// The production extension keeps objects in other parts, "p:path".
  void refuse_other_part(const pugi::xml_node& node) const {
    for (const pugi::xml_attribute& attribute : node.attributes())
      if (std::string_view(attribute.name()).ends_with(":path"))
        xml_.fail(node,
                  "objects in other parts of the archive (3MF production extension) are not supported; save the "
                  "file without it (Bambu Studio, OrcaSlicer: File > Export > Export Generic 3MF)");
  }

  Placement transform_of(const pugi::xml_node& node) const {
    const pugi::xml_attribute attribute = node.attribute("transform");
    if (!attribute) return Placement();
    const ByteRange range = xml_.range(attribute);
    TextScanner text(std::string_view(file_.model).substr(0, range.begin + range.size), {});
    text.seek(range.begin);
    std::array<double, 12> m{};  // four rows of three, for row vectors
    for (double& number : m)
      if (!text.skip_space() || text.number(number) != TextScanner::Number::ok)
        xml_.fail(range.begin, "a transform should be 12 numbers; the file is damaged");
    const Placement placement({m[0], m[3], m[6], m[9], m[1], m[4], m[7], m[10], m[2], m[5], m[8], m[11]});
    if (!placement.is_invertible()) xml_.fail(range.begin, "this transform makes the object flat; correct it");
    return placement;
  }

  /// An item of the build, or a component of an object. What refers to itself is deeper than the file has objects.
  void show(const pugi::xml_node& node, const Placement& outer, std::size_t depth = 0) {
    const auto found = object_of_id_.find(node.attribute("objectid").value());
    if (found == object_of_id_.end())
      xml_.fail(node, fmt::format("there is no object {}; the file is damaged", node.attribute("objectid").value()));
    if (depth > deepest_nesting)
      xml_.fail(node, "nested too deeply: components within each other, or within themselves; the file is damaged");
    if (++shows_ > largest_shows) xml_.fail(node, "components show more objects than can be read; the file is damaged");
    const pugi::xml_node object = found->second;
    const Placement placement = outer * transform_of(node);
    if (object.child("mesh")) {
      if (!shown_.insert(found->first).second) {
        repeated_.insert(found->first);
      } else {
        mesh(object, placement);
      }
    }
    for (const pugi::xml_node& component : object.child("components").children("component")) {
      refuse_other_part(component);
      show(component, placement, depth + 1);
    }
  }

  void mesh(const pugi::xml_node& object, const Placement& placement) {
    const auto first = static_cast<std::int64_t>(file_.locals.size());
    file_.placements.push_back(placement);
    objects_.start(name_of(object), faces_.count());
    for (const pugi::xml_node& vertex : object.child("mesh").child("vertices").children("vertex")) add_vertex(vertex);
    const auto count = static_cast<std::int64_t>(file_.locals.size()) - first;
    if (file_.locals.size() > std::numeric_limits<std::int32_t>::max() / 3)
      xml_.fail(object, "more vertices than 32-bit ids can count; split the file");
    std::size_t number = 0;
    for (const pugi::xml_node& triangle : object.child("mesh").child("triangles").children("triangle")) {
      std::array<std::int32_t, 3> face{};
      for (std::size_t k = 0; k < 3; ++k) {
        constexpr std::array<const char*, 3> names = {"v1", "v2", "v3"};
        const pugi::xml_attribute attribute = triangle.attribute(names[k]);
        const std::string_view digits = attribute.value();
        std::int64_t v = -1;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), v);
        if (error != std::errc{} || end != digits.data() + digits.size() || v < 0 || v >= count)
          xml_.fail(triangle, fmt::format("triangle {} of '{}' uses vertex {}, but there are {} (counting from 0)",
                                          number, name_of(object), in_quotes(digits), count));
        face[k] = static_cast<std::int32_t>(first + v);
      }
      if (!faces_.add(face)) xml_.fail(triangle, "more face corners than 32-bit ids can count; split the file");
      ++number;
    }
  }

  void add_vertex(const pugi::xml_node& vertex) {
    std::array<double, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::array<const char*, 3> names = {"x", "y", "z"};
      const pugi::xml_attribute attribute = vertex.attribute(names[k]);
      if (!attribute)
        xml_.fail(vertex,
                  fmt::format("vertex {} has fewer than three coordinates; give it x, y and z", file_.locals.size()));
      const ByteRange range = xml_.range(attribute);
      TextScanner text(std::string_view(file_.model).substr(0, range.begin + range.size), {});
      text.seek(range.begin);
      text.skip_space();
      const std::size_t begin = text.offset();
      local[k] = text.coordinate<double>(file_.locals.size());
      file_.tokens.push_back({begin, static_cast<std::uint32_t>(text.offset() - begin)});
      if (text.skip_space())
        xml_.fail(vertex, fmt::format("vertex {} has more than a number as '{}'", file_.locals.size(), names[k]));
    }
    const std::array<double, 3> world = file_.placements.back().to_world(local);
    for (const double x : world)
      if (!std::isfinite(x))
        xml_.fail(vertex, fmt::format("vertex {} is not finite where the build shows it", file_.locals.size()));
    file_.locals.push_back(local);
    file_.placement_of_vertex.push_back(file_.placements.size() - 1);
    file_.surface.positions.insert(file_.surface.positions.end(), world.begin(), world.end());
  }

  /// Objects that a model may show, each time counted: components that double at every level would take for ever (unit:
  /// objects)
  static constexpr std::size_t largest_shows = 1000000;
  ThreemfFile& file_;
  XmlText xml_;
  std::map<std::string, pugi::xml_node> object_of_id_;
  std::set<std::string> shown_, repeated_;
  std::size_t shows_ = 0;
  FaceCollector faces_{file_.surface};
  LabelCollector objects_{"object"};
};

/// Name of the part that the package starts with (Open Packaging Conventions, section 9.3).
std::string name_of_model(const ZipArchive& archive) {
  constexpr std::string_view usual = "3D/3dmodel.model";
  const std::optional<std::string> relations = archive.content("_rels/.rels");
  if (!relations) return std::string(usual);
  const XmlText xml(*relations, "Relationships");
  for (const pugi::xml_node& relation : xml.root().children("Relationship")) {
    std::string_view target = relation.attribute("Target").value();
    if (!std::string_view(relation.attribute("Type").value()).ends_with("/3dmodel")) continue;
    if (target.starts_with('/')) target.remove_prefix(1);
    return std::string(target);
  }
  return std::string(usual);
}

}  // namespace

std::unique_ptr<MeshFile> parse_threemf(std::string bytes, const std::filesystem::path&) {
  if (bytes.empty()) throw FileError("the file is empty; a 3MF file is a ZIP archive");
  auto file = std::make_unique<ThreemfFile>();
  file->up = {0, 0, 1};  // 3MF core specification, section 3.2: the print goes up along z
  file->bytes = std::move(bytes);
  const ZipArchive archive(file->bytes);
  file->model_name = name_of_model(archive);
  std::optional<std::string> model = archive.content(file->model_name);
  if (!model) throw FileError(fmt::format("the archive has no '{}'; check that it is a 3MF file", file->model_name));
  file->model = std::move(*model);
  try {
    ThreemfParser(*file).parse();
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}, {}", file->model_name, error.what()));
  }
  return file;
}

}  // namespace unsnarl
