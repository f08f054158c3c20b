// 3MF (3MF Core Specification 1.3, Production Extension 1.1): a ZIP archive whose model parts are patched. The meshes
// of their objects are seen where the build of the root model shows them first.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <deque>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <utility>

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

/// A part of the archive that holds objects.
struct ModelPart {
  std::string name, text;
};

/// Objects that are seen at one place, and the number of the part that they are in.
struct PlacedMesh {
  Placement placement;
  std::size_t part = 0;
};

class ThreemfFile final : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    const TextPrecision digits = precision(float32_digits);
    std::map<std::size_t, std::vector<TextEdit>> edits;  // by part
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      const std::array<double, 3> local = wanted(v, positions, digits);
      for (std::size_t k = 0; k < 3; ++k) {
        const NumberToken& token = tokens[3 * v + k];
        if (local[k] != locals[v][k])
          edits[meshes[mesh_of_vertex[v]].part].push_back(
              {token.begin, token.begin + token.length, number_text(local[k], digits)});
      }
    }
    if (edits.empty()) return {{{}, bytes}};
    std::map<std::string, std::string> contents;
    for (auto& [part, of_part] : edits) contents[parts[part].name] = with_edits(parts[part].text, std::move(of_part));
    return {{{}, ZipArchive(bytes).with_contents(contents)}};
  }

  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const override {
    std::vector<double> result = surface.positions;
    for (std::size_t v = 0; v < positions.size() / 3; ++v) {
      const std::array<double, 3> local = wanted(v, positions, precision(float32_digits));
      if (local == locals[v]) continue;
      const std::array<double, 3> world = meshes[mesh_of_vertex[v]].placement.to_world(local);
      std::copy(world.begin(), world.end(), result.begin() + static_cast<std::ptrdiff_t>(3 * v));
    }
    return result;
  }

  std::deque<ModelPart> parts;  ///< the root model first; those that it refers to stay where they are as more come
  std::vector<std::array<double, 3>> locals;
  std::vector<NumberToken> tokens;  ///< in the text of the vertex's part, 3 a vertex
  std::vector<PlacedMesh> meshes;
  std::vector<std::size_t> mesh_of_vertex;

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
    const std::array<double, 3> exact = meshes[mesh_of_vertex[v]].placement.to_local(world);
    for (std::size_t k = 0; k < 3; ++k) {
      const double written = exact[k] == local[k] ? local[k] : value_as_written(exact[k], digits);
      if (written != local[k]) local[k] = written;
    }
    return local;
  }
};

/// The objects of a part by their ids.
class Objects {
 public:
  explicit Objects(const ModelPart& part) : xml(part.text, "model") {
    for (const pugi::xml_node& object : all())
      if (!of_id_.try_emplace(object.attribute("id").value(), object).second)
        xml.fail(object, fmt::format("object {} is there twice; the file is damaged", object.attribute("id").value()));
  }

  pugi::xml_object_range<pugi::xml_named_node_iterator> all() const {
    return xml.root().child("resources").children("object");
  }
  /// The object that an item or a component refers to; null: there is none.
  pugi::xml_node shown_by(const pugi::xml_node& node) const {
    const auto found = of_id_.find(node.attribute("objectid").value());
    return found == of_id_.end() ? pugi::xml_node() : found->second;
  }

  XmlText xml;

 private:
  std::map<std::string, pugi::xml_node> of_id_;
};

/// Names of the parts of objects, as Bambu Studio and OrcaSlicer keep them beside the model: by the ids of an object of
/// the root model and of the object that is its component.
class NamesOfParts {
 public:
  explicit NamesOfParts(const std::optional<std::string>& settings) {
    pugi::xml_document document;
    if (!settings || !document.load_buffer(settings->data(), settings->size(), pugi::parse_escapes)) return;
    for (const pugi::xml_node& object : document.child("config").children("object"))
      for (const pugi::xml_node& part : object.children("part"))
        names_[{object.attribute("id").value(), part.attribute("id").value()}] =
            part.find_child_by_attribute("metadata", "key", "name").attribute("value").value();
  }
  /// Empty: it has none.
  std::string of(const std::string& object, const std::string& component) const {
    const auto found = names_.find({object, component});
    return found == names_.end() ? std::string() : found->second;
  }

 private:
  std::map<std::pair<std::string, std::string>, std::string> names_;
};

class ThreemfParser {
 public:
  /// `file` has its root model.
  ThreemfParser(ThreemfFile& file, const ZipArchive& archive)
      : file_(file), archive_(archive), part_of_name_{{in_small_letters(file.parts[0].name), 0}} {}

  /// Throws FileError, with the name of the part that it is about.
  void parse() {
    try {
      objects_.emplace_back(file_.parts[0]);
      for (const pugi::xml_node& item : objects_[0].xml.root().child("build").children("item"))
        show(item, 0, Placement(), {}, 0);
      finish();
    } catch (const FileError& error) {
      throw FileError(fmt::format("{}, {}", file_.parts[at_].name, error.what()));
    }
  }

 private:
  /// Entries of archives are found whatever the case of their names.
  static std::string in_small_letters(std::string name) {
    for (char& c : name)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
  }
  static std::string own_name(const pugi::xml_node& object) {
    const std::string_view name = object.attribute("name").value();
    return name.empty() ? fmt::format("object {}", object.attribute("id").value()) : std::string(name);
  }

  void finish() {
    std::size_t hidden = 0;
    for (std::size_t part = 0; part < objects_.size(); ++part)
      for (const pugi::xml_node& object : objects_[part].all())
        hidden += object.child("mesh") && !shown_.contains({part, object.attribute("id").value()});
    const pugi::xml_node& root = objects_[0].xml.root();
    if (shown_.empty())
      objects_[0].xml.fail(root, "the build shows no object with a mesh; the file is damaged or empty");
    if (hidden > helpers_.size())
      file_.notes.push_back(
          fmt::format("Objects that the build does not show ({}) stay as they are.", hidden - helpers_.size()));
    if (!helpers_.empty())
      file_.notes.push_back(
          fmt::format("Objects that are not printed (modifiers, supports: {}) are left out and stay as they are.",
                      helpers_.size()));
    if (!repeated_.empty())
      file_.notes.push_back(fmt::format(
          "Objects that the build shows several times ({}) are repaired where it shows them first; the others "
          "follow.",
          repeated_.size()));
    faces_.note_ignored(file_.notes);
    labels_.finish(faces_.count(), file_.labels);
  }

  /// The part that a component or an item of the build refers to ("p:path" of the production extension); its own: it
  /// names none. Only the root model refers to others.
  std::size_t part_shown_by(const pugi::xml_node& node, std::size_t own) {
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      if (!std::string_view(attribute.name()).ends_with(":path")) continue;
      if (own != 0) objects_[own].xml.fail(node, "only the root model may refer to other parts; the file is damaged");
      return part_called(node, XmlText::value(attribute));
    }
    return own;
  }

  std::size_t part_called(const pugi::xml_node& node, std::string name) {
    if (name.starts_with('/')) name.erase(0, 1);
    const auto [entry, is_new] = part_of_name_.try_emplace(in_small_letters(name), file_.parts.size());
    if (!is_new) return entry->second;
    std::optional<std::string> text = archive_.content(name);
    if (!text) objects_[0].xml.fail(node, fmt::format("the archive has no part '{}'; the file is damaged", name));
    file_.parts.push_back({name, std::move(*text)});
    at_ = entry->second;
    objects_.emplace_back(file_.parts.back());
    at_ = 0;
    return entry->second;
  }

  Placement transform_of(const pugi::xml_node& node, std::size_t part) const {
    const pugi::xml_attribute attribute = node.attribute("transform");
    if (!attribute) return Placement();
    const XmlText& xml = objects_[part].xml;
    const ByteRange range = xml.range(attribute);
    TextScanner text(std::string_view(file_.parts[part].text).substr(0, range.begin + range.size), {});
    text.seek(range.begin);
    std::array<double, 12> m{};  // four rows of three, for row vectors
    for (double& number : m)
      if (!text.skip_space() || text.number(number) != TextScanner::Number::ok)
        xml.fail(range.begin, "a transform should be 12 numbers; the file is damaged");
    const Placement placement({m[0], m[3], m[6], m[9], m[1], m[4], m[7], m[10], m[2], m[5], m[8], m[11]});
    if (!placement.is_invertible()) xml.fail(range.begin, "this transform makes the object flat; correct it");
    return placement;
  }

  /// An item of the build, or a component of the object `of`, in this part. What refers to itself is deeper than the
  /// file has objects.
  void show(const pugi::xml_node& node, std::size_t part, const Placement& outer, const pugi::xml_node& of,
            std::size_t depth) {
    at_ = part;
    const XmlText& xml = objects_[part].xml;
    const std::size_t target = part_shown_by(node, part);
    const pugi::xml_node object = objects_[target].shown_by(node);
    if (!object)
      xml.fail(node, fmt::format("there is no object {}; the file is damaged", node.attribute("objectid").value()));
    if (depth > deepest_nesting)
      xml.fail(node, "nested too deeply: components within each other, or within themselves; the file is damaged");
    if (++shows_ > largest_shows) xml.fail(node, "components show more objects than can be read; the file is damaged");
    const Placement placement = outer * transform_of(node, part);
    if (object.child("mesh")) show_mesh(object, target, placement, of);
    for (const pugi::xml_node& component : object.child("components").children("component"))
      show(component, target, placement, object, depth + 1);
    at_ = part;
  }

  void show_mesh(const pugi::xml_node& object, std::size_t part, const Placement& placement, const pugi::xml_node& of) {
    const std::string id = object.attribute("id").value();
    if (of && std::string_view(object.attribute("type").value()) == "other") {
      helpers_.insert({part, id});
    } else if (shown_.insert({part, id}).second) {
      at_ = part;
      if (part != 0 && !names_) names_.emplace(archive_.content("Metadata/model_settings.config"));
      const std::string kept = part == 0 ? "" : names_->of(of.attribute("id").value(), id);
      mesh(object, kept.empty() ? own_name(object) : kept, part, placement);
    } else {
      repeated_.insert({part, id});
    }
  }

  void mesh(const pugi::xml_node& object, const std::string& name, std::size_t part, const Placement& placement) {
    const XmlText& xml = objects_[part].xml;
    const auto first = static_cast<std::int64_t>(file_.locals.size());
    file_.meshes.push_back({placement, part});
    labels_.start(name, faces_.count());
    for (const pugi::xml_node& vertex : object.child("mesh").child("vertices").children("vertex"))
      add_vertex(vertex, part);
    const auto count = static_cast<std::int64_t>(file_.locals.size()) - first;
    if (file_.locals.size() > std::numeric_limits<std::int32_t>::max() / 3)
      xml.fail(object, "more vertices than 32-bit ids can count; split the file");
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
          xml.fail(triangle, fmt::format("triangle {} of '{}' uses vertex {}, but there are {} (counting from 0)",
                                         number, name, in_quotes(digits), count));
        face[k] = static_cast<std::int32_t>(first + v);
      }
      if (!faces_.add(face)) xml.fail(triangle, "more face corners than 32-bit ids can count; split the file");
      ++number;
    }
  }

  void add_vertex(const pugi::xml_node& vertex, std::size_t part) {
    const XmlText& xml = objects_[part].xml;
    std::array<double, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr std::array<const char*, 3> names = {"x", "y", "z"};
      const pugi::xml_attribute attribute = vertex.attribute(names[k]);
      if (!attribute)
        xml.fail(vertex,
                 fmt::format("vertex {} has fewer than three coordinates; give it x, y and z", file_.locals.size()));
      const ByteRange range = xml.range(attribute);
      TextScanner text(std::string_view(file_.parts[part].text).substr(0, range.begin + range.size), {});
      text.seek(range.begin);
      text.skip_space();
      const std::size_t begin = text.offset();
      local[k] = text.coordinate<double>(file_.locals.size());
      file_.tokens.push_back({begin, static_cast<std::uint32_t>(text.offset() - begin)});
      if (text.skip_space())
        xml.fail(vertex, fmt::format("vertex {} has more than a number as '{}'", file_.locals.size(), names[k]));
    }
    const std::array<double, 3> world = file_.meshes.back().placement.to_world(local);
    for (const double x : world)
      if (!std::isfinite(x))
        xml.fail(vertex, fmt::format("vertex {} is not finite where the build shows it", file_.locals.size()));
    file_.locals.push_back(local);
    file_.mesh_of_vertex.push_back(file_.meshes.size() - 1);
    file_.surface.positions.insert(file_.surface.positions.end(), world.begin(), world.end());
  }

  /// Objects that a model may show, each time counted: components that double at every level would take for ever (unit:
  /// objects)
  static constexpr std::size_t largest_shows = 1000000;
  using ObjectOfPart = std::pair<std::size_t, std::string>;  // the part, and the id
  ThreemfFile& file_;
  const ZipArchive& archive_;
  std::optional<NamesOfParts> names_;  // read once they are needed
  std::deque<Objects> objects_;        // of the file's parts
  std::map<std::string, std::size_t> part_of_name_;
  std::size_t at_ = 0;  // the part that is read, for messages
  std::set<ObjectOfPart> shown_, repeated_, helpers_;
  std::size_t shows_ = 0;
  FaceCollector faces_{file_.surface};
  LabelCollector labels_{"object"};
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
  const std::string name = name_of_model(archive);
  std::optional<std::string> model = archive.content(name);
  if (!model) throw FileError(fmt::format("the archive has no '{}'; check that it is a 3MF file", name));
  file->parts.push_back({name, std::move(*model)});
  ThreemfParser(*file, archive).parse();
  return file;
}

}  // namespace unsnarl
