// Gmsh MSH 2.2 and 4.1, ASCII and binary (Gmsh reference manual, "File formats"). Triangles and quadrangles of the
// first order make the surface; all else is passed on.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "io/byte_order.h"
#include "io/formats.h"
#include "io/point_file.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

/// Types of elements that are of interest; the rest is skipped by its number of nodes.
enum Element : std::int64_t { line = 1, triangle = 2, quadrangle = 3 };

/// Nodes of an element by its type, 0 for unknown types (manual, section "Node ordering").
constexpr auto nodes_of_type = std::to_array<std::uint8_t>(
    {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5, 6, 20, 35, 56});
/// Element types of curved faces (fixed by the format)
constexpr std::array<std::int64_t, 9> curved_faces = {9, 10, 16, 20, 21, 22, 23, 24, 25};
/// Element types of solids with straight edges (fixed by the format)
constexpr std::array<std::int64_t, 4> linear_solids = {4, 5, 6, 7};

/// Reads the numbers of a section, as text or in binary.
class Source {
 public:
  Source(std::string_view bytes) : bytes_(bytes), text_(bytes, {}) {}

  TextScanner& text() { return text_; }
  std::size_t offset() const { return text_.offset(); }
  void set_binary(std::endian order) {
    is_binary_ = true;
    order_ = order;
  }
  bool is_binary() const { return is_binary_; }
  std::endian order() const { return order_; }

  [[noreturn]] void fail(const std::string& message) const {
    if (is_binary_) throw FileError(fmt::format("byte {}: {}", offset(), message));
    text_.fail(message);
  }
  template <class T>
  T binary(const char* what) {
    need(sizeof(T), what);
    const T value = load<T>(bytes_.data() + offset(), order_);
    text_.seek(offset() + sizeof(T));
    return value;
  }
  void need(std::size_t size, const char* what) const {
    if (size > text_.remaining()) fail(fmt::format("the file ends where {} should be; it is cut short", what));
  }
  void skip_bytes(std::size_t count, std::size_t size, const char* what) {
    if (count > text_.remaining() / size) fail(fmt::format("the file ends where {} should be; it is cut short", what));
    text_.seek(offset() + count * size);
  }
  /// A whole number: in binary of the type T.
  template <class T>
  std::int64_t whole(const char* what) {
    if (is_binary_) return static_cast<std::int64_t>(binary<T>(what));
    std::int64_t value = 0;
    if (!text_.skip_space()) fail(fmt::format("the file ends where {} should be; it is cut short", what));
    if (!text_.integer(value)) fail(fmt::format("{} where {} should be", in_quotes(text_.peek()), what));
    return value;
  }
  /// One that is a number of things which take at least `size` bytes each in binary.
  template <class T>
  std::size_t count(const char* what, std::size_t size) {
    const std::size_t start = offset();
    const std::int64_t value = whole<T>(what);
    const std::size_t least = is_binary_ ? size : 2;
    if (value < 0 || static_cast<std::uint64_t>(value) > (text_.remaining() + 1) / least) {
      text_.seek(start);
      fail(fmt::format("{} {} cannot be in the {} bytes that follow; the file is cut short or damaged", value, what,
                       text_.remaining()));
    }
    return static_cast<std::size_t>(value);
  }

 private:
  std::string_view bytes_;
  TextScanner text_;
  bool is_binary_ = false;
  std::endian order_ = std::endian::little;
};

/// Vertices and entity of a face.
using FaceKey = std::array<std::int64_t, 5>;
struct HashOfKey {
  std::size_t operator()(const FaceKey& key) const {
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, by numbers instead of bytes
    for (const std::int64_t number : key) hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x100000001b3;
    return hash ^ hash >> 32;
  }
};

class MshParser {
 public:
  explicit MshParser(PointFile& file) : file_(file), source_(file.bytes) {}

  void parse() {
    if (file_.bytes.empty()) throw FileError("the file is empty; a Gmsh file starts with '$MeshFormat'");
    TextScanner& text = source_.text();
    bool has_nodes = false, has_elements = false;
    while (text.skip_space()) {
      const std::size_t start = text.offset();
      const std::string_view section = text.token();
      if (!has_format_ && section == "$NOD")
        text.fail("version 1 of Gmsh's format is not read; convert it: gmsh IN -save -format msh22 -o OUT.msh", start);
      if (!has_format_ && section != "$MeshFormat")
        text.fail("'$MeshFormat' should be here; check that it is a Gmsh file", start);
      if (section == "$MeshFormat") {
        format();
      } else if (section == "$PhysicalNames") {
        physical_names();
      } else if (section == "$Entities" && is_version_4_) {
        entities();
      } else if (section == "$Nodes") {
        if (has_nodes) text.fail("a second $Nodes; the file is damaged", start);
        has_nodes = true;
        text.next_line();
        is_version_4_ ? nodes_4() : nodes_2();
        end_of("$EndNodes");
      } else if (section == "$Elements") {
        if (!has_nodes) text.fail("$Nodes should come before $Elements", start);
        if (has_elements) text.fail("a second $Elements; the file is damaged", start);
        has_elements = true;
        text.next_line();
        is_version_4_ ? elements_4() : elements_2();
        end_of("$EndElements");
      } else {
        skip_section(section, start);
      }
    }
    if (!has_nodes) text.fail("the file has no $Nodes; it is cut short");
    finish();
  }

 private:
  void format() {
    TextScanner& text = source_.text();
    text.skip_space();
    const std::string_view version = text.token();
    if (version != "2.2" && version != "2" && version != "2.0" && version != "2.1" && version != "4.1") {
      text.fail(
          fmt::format("version {}, but only 2.2 and 4.1 are read; convert it with 'gmsh IN -save -format msh41 -o OUT'",
                      in_quotes(version)));
    }
    is_version_4_ = version == "4.1";
    const std::int64_t kind = source_.whole<std::int32_t>("the kind of file"),
                       size = source_.whole<std::int32_t>("the size of numbers");
    if (kind != 0 && kind != 1) text.fail(fmt::format("file type {} is none of 0 (text) and 1 (binary)", kind));
    if (size != 8)
      text.fail(fmt::format("numbers of {} bytes, but only 8 are read; write the file on a 64-bit machine", size));
    text.next_line();
    if (kind == 1) {
      source_.set_binary(std::endian::little);
      if (source_.binary<std::int32_t>("the number 1") != 1) {
        text.seek(text.offset() - 4);
        source_.set_binary(std::endian::big);
        if (source_.binary<std::int32_t>("the number 1") != 1)
          source_.fail("the number 1 should be here; the file is damaged");
      }
    }
    has_format_ = true;
    end_of("$EndMeshFormat");
  }

  void end_of(std::string_view word) {
    TextScanner& text = source_.text();
    if (!text.skip_space()) text.fail(fmt::format("the file ends where '{}' should be; it is cut short", word));
    if (text.peek() != word) source_.fail(fmt::format("{} where '{}' should be", in_quotes(text.peek()), word));
    text.token();
  }
  /// By its closing word: what is within may be anything.
  void skip_section(std::string_view section, std::size_t start) {
    TextScanner& text = source_.text();
    if (!section.starts_with('$') || section.starts_with("$End"))
      text.fail(fmt::format("{} where a section like '$Nodes' should be", in_quotes(section)), start);
    const std::string end = "$End" + std::string(section.substr(1));
    const std::size_t found = file_.bytes.find(end, text.offset());
    if (found == std::string::npos)
      text.fail(fmt::format("{} has no {}; the file is cut short", in_quotes(section), in_quotes(end)), start);
    text.seek(found + end.size());
  }

  void physical_names() {
    TextScanner& text = source_.text();
    std::int64_t count = 0;
    text.skip_space();
    if (!text.integer(count)) text.fail("the number of names should be here");
    for (std::int64_t i = 0; i < count && text.skip_space() && text.peek() != "$EndPhysicalNames"; ++i) {
      std::int64_t dimension = 0, tag = 0;
      if (!text.integer(dimension) || !text.skip_blanks() || !text.integer(tag))
        text.fail("a dimension and a number should be before each name");
      std::string_view name = text.rest_of_line();
      if (name.starts_with('"')) name.remove_prefix(1);
      if (name.ends_with('"')) name.remove_suffix(1);
      if (dimension == 2) names_[tag] = std::string(name);
    }
    end_of("$EndPhysicalNames");
  }

  /// Which physical group each surface belongs to (the first one, where there are several).
  void entities() {
    source_.text().next_line();
    std::array<std::size_t, 4> counts{};
    for (std::size_t& count : counts) count = source_.count<std::uint64_t>("entities", 4);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const std::int64_t tag = source_.whole<std::int32_t>("the number of an entity");
        for (std::size_t k = 0; k < (dimension == 0 ? 3 : 6); ++k) skip_number();
        const std::size_t groups = source_.count<std::uint64_t>("physical groups", 4);
        for (std::size_t g = 0; g < groups; ++g) {
          const std::int64_t group = source_.whole<std::int32_t>("a physical group");
          if (g == 0 && dimension == 2) group_of_entity_[tag] = group;
        }
        if (dimension == 0) continue;
        const std::size_t bounds = source_.count<std::uint64_t>("bounding entities", 4);
        for (std::size_t b = 0; b < bounds; ++b) source_.whole<std::int32_t>("a bounding entity");
      }
    }
    end_of("$EndEntities");
  }
  void skip_number() {
    if (source_.is_binary()) return source_.skip_bytes(1, sizeof(double), "a number");
    if (!source_.text().skip_space()) source_.fail("the file ends within a section; it is cut short");
    source_.text().token();
  }

  void add_node(std::int64_t tag) {
    const auto [entry, is_new] = vertex_of_node_.try_emplace(tag, static_cast<std::int64_t>(vertex_of_node_.size()));
    if (!is_new) source_.fail(fmt::format("node {} is there twice; number the nodes uniquely", tag));
  }
  /// Three coordinates, and `more` numbers after them.
  void add_text_node(std::int64_t tag, std::size_t more) {
    TextScanner& text = source_.text();
    std::array<double, 3> position{};
    std::array<NumberToken, 3> tokens;
    for (std::size_t k = 0; k < 3; ++k) {
      text.skip_space();
      tokens[k].begin = text.offset();
      position[k] = text.coordinate<double>(static_cast<std::size_t>(std::max<std::int64_t>(tag, 0)));
      tokens[k].length = static_cast<std::uint32_t>(text.offset() - tokens[k].begin);
    }
    for (std::size_t i = 0; i < more; ++i) skip_number();
    file_.add_point(position, tokens);
  }
  void add_binary_nodes(std::size_t begin, std::size_t count, std::size_t step) {
    PointBlock block;
    block.array = {
        .type = NumberType::float64, .count = 3 * count, .where = "$Nodes", .order = source_.order(), .start = begin};
    block.count = count;
    block.vertex_step = step;
    block.coordinate_step = sizeof(double);
    file_.add_binary_points(std::move(block));
  }

  void nodes_2() {
    const bool is_binary = source_.is_binary();
    std::int64_t stated = 0;
    source_.text().skip_space();
    if (!source_.text().integer(stated) || stated < 0) source_.text().fail("the number of nodes should be here");
    source_.text().next_line();
    /// Size of a vertex, its number and three coordinates (fixed by the format, in bytes)
    constexpr std::size_t record = sizeof(std::int32_t) + 3 * sizeof(double);
    const std::size_t least = is_binary ? record : 8;
    if (static_cast<std::uint64_t>(stated) > (source_.text().remaining() + 1) / least)
      source_.fail(fmt::format("{} nodes cannot be in the {} bytes that follow; the file is cut short or damaged",
                               stated, source_.text().remaining()));
    const auto n = static_cast<std::size_t>(stated);
    vertex_of_node_.reserve(n);
    const std::size_t begin = source_.offset();
    for (std::size_t i = 0; i < n; ++i) {
      const std::int64_t tag = source_.whole<std::int32_t>("the number of a node");
      add_node(tag);
      if (is_binary) {
        source_.skip_bytes(3, sizeof(double), "a node");
      } else {
        add_text_node(tag, 0);
      }
    }
    if (is_binary && n > 0) add_binary_nodes(begin + sizeof(std::int32_t), n, record);
  }

  void nodes_4() {
    const std::size_t blocks = source_.count<std::uint64_t>("blocks of nodes", 16);
    for (int i = 0; i < 3; ++i) source_.whole<std::uint64_t>("the numbers of nodes");
    for (std::size_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = source_.whole<std::int32_t>("the dimension of an entity");
      source_.whole<std::int32_t>("the number of an entity");
      const std::int64_t is_parametric = source_.whole<std::int32_t>("the flag of parameters");
      if (dimension < 0 || dimension > 3)
        source_.fail(fmt::format("an entity of dimension {}; the file is damaged", dimension));
      const std::size_t more = is_parametric == 0 ? 0 : static_cast<std::size_t>(dimension);
      parametric_ |= more > 0;
      const std::size_t step = (3 + more) * sizeof(double);
      const std::size_t n = source_.count<std::uint64_t>("nodes", sizeof(std::uint64_t) + step);
      std::vector<std::int64_t> tags(n);
      for (std::int64_t& tag : tags) add_node(tag = source_.whole<std::uint64_t>("the number of a node"));
      if (source_.is_binary()) {
        const std::size_t begin = source_.offset();
        source_.skip_bytes(n, step, "the nodes");
        if (n > 0) add_binary_nodes(begin, n, step);
      } else {
        for (const std::int64_t tag : tags) add_text_node(tag, more);
      }
    }
  }

  std::size_t nodes_of(std::int64_t type) const {
    if (type < 1 || type >= static_cast<std::int64_t>(nodes_of_type.size()) || nodes_of_type[type] == 0)
      source_.fail(
          fmt::format("elements of type {} are not known; save the mesh with elements of the first order", type));
    if (std::find(curved_faces.begin(), curved_faces.end(), type) != curved_faces.end())
      source_.fail(
          fmt::format("elements of type {} are curved faces, which are not read; make them of the first order "
                      "(in Gmsh: Modules > Mesh > Set order 1, then save)",
                      type));
    return nodes_of_type[type];
  }

  void elements_2() {
    std::int64_t count = 0;
    source_.text().skip_space();
    if (!source_.text().integer(count) || count < 0) source_.text().fail("the number of elements should be here");
    source_.text().next_line();
    while (count > 0) {
      std::int64_t type = 0, tags = 0, here = 1;
      if (source_.is_binary()) {
        type = source_.binary<std::int32_t>("elements");
        here = source_.binary<std::int32_t>("elements");
        tags = source_.binary<std::int32_t>("elements");
        if (here <= 0 || here > count) source_.fail(fmt::format("{} elements of {}; the file is damaged", here, count));
      }
      for (std::int64_t e = 0; e < here; ++e) {
        const std::int64_t id = source_.whole<std::int32_t>("the number of an element");
        if (!source_.is_binary()) {
          type = source_.whole<std::int32_t>("the type of an element");
          tags = source_.whole<std::int32_t>("the number of tags");
        }
        const std::size_t nodes = nodes_of(type);
        if (tags < 0 || static_cast<std::uint64_t>(tags) > source_.text().remaining())
          source_.fail(fmt::format("element {} has {} tags; the file is damaged", id, tags));
        std::array<std::int64_t, 2> groups{};
        for (std::int64_t t = 0; t < tags; ++t) {
          const std::int64_t tag = source_.whole<std::int32_t>("a tag");
          if (t < 2) groups[static_cast<std::size_t>(t)] = tag;
        }
        element<std::int32_t>(id, type, nodes, groups[0], groups[1]);
      }
      count -= here;
    }
  }

  void elements_4() {
    const std::size_t blocks = source_.count<std::uint64_t>("blocks of elements", 16);
    for (int i = 0; i < 3; ++i) source_.whole<std::uint64_t>("the numbers of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
      source_.whole<std::int32_t>("the dimension of an entity");
      const std::int64_t entity = source_.whole<std::int32_t>("the number of an entity"),
                         type = source_.whole<std::int32_t>("the type of elements");
      const std::size_t nodes = nodes_of(type);
      const std::size_t n = source_.count<std::uint64_t>("elements", (1 + nodes) * sizeof(std::uint64_t));
      const auto group = group_of_entity_.find(entity);
      for (std::size_t e = 0; e < n; ++e)
        element<std::uint64_t>(source_.whole<std::uint64_t>("the number of an element"), type, nodes,
                               group == group_of_entity_.end() ? 0 : group->second, entity);
    }
  }

  template <class T>
  void element(std::int64_t id, std::int64_t type, std::size_t nodes, std::int64_t group, std::int64_t entity) {
    const bool is_face = type == triangle || type == quadrangle;
    solids_ += std::find(linear_solids.begin(), linear_solids.end(), type) != linear_solids.end();
    std::array<std::int64_t, 4> face{};
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::int64_t tag = source_.whole<T>("a node of an element");
      if (!is_face) continue;
      const auto vertex = vertex_of_node_.find(tag);
      if (vertex == vertex_of_node_.end())
        source_.fail(fmt::format("element {} uses node {}, but there is none of this number", id, tag));
      face[k] = vertex->second;
    }
    if (!is_face || is_repeated(face, group, entity)) return;
    if (group != last_group_ || file_.face_count() == 0) {
      last_group_ = group;
      const auto name = names_.find(group);
      groups_.start(name == names_.end() ? fmt::format("{}", group) : name->second, file_.face_count());
    }
    if (entity != last_entity_ || file_.face_count() == 0) {
      last_entity_ = entity;
      entities_.start(fmt::format("{}", entity), file_.face_count());
    }
    const std::string wrong = file_.add_face({face.data(), nodes});
    if (!wrong.empty()) source_.fail(fmt::format("element {} {}", id, wrong));
  }

  /// Version 2 lists an element once for each physical group that its entity is in.
  bool is_repeated(const std::array<std::int64_t, 4>& face, std::int64_t group, std::int64_t entity) {
    if (is_version_4_) return false;
    const auto [known, is_new] = group_of_face_.try_emplace({face[0], face[1], face[2], face[3], entity}, group);
    const bool result = !is_new && known->second != group;
    repeated_ += result;
    return result;
  }

  void finish() {
    if (repeated_ > 0)
      file_.notes.push_back(
          fmt::format("Elements that are there again for another physical group ({}) count once.", repeated_));
    if (parametric_)
      file_.notes.emplace_back("Parametric coordinates of nodes are kept as they are, also where the nodes move.");
    if (solids_ > 0)
      file_.notes.push_back(fmt::format(
          "Volume elements ({}) are not looked at; those at moved vertices follow and may lose their shape.", solids_));
    file_.finish();
    groups_.finish(file_.face_count(), file_.labels);
    entities_.finish(file_.face_count(), file_.labels);
  }

  PointFile& file_;
  Source source_;
  bool has_format_ = false, is_version_4_ = false, parametric_ = false;
  std::unordered_map<std::int64_t, std::int64_t> vertex_of_node_;  // only looked up, so its order shows nowhere
  std::map<std::int64_t, std::int64_t> group_of_entity_;
  std::map<std::int64_t, std::string> names_;
  LabelCollector groups_{"group"}, entities_{"object"};
  std::int64_t last_group_ = 0, last_entity_ = 0;
  std::unordered_map<FaceKey, std::int64_t, HashOfKey> group_of_face_;  // only looked up, like the nodes
  std::size_t solids_ = 0, repeated_ = 0;
};

}  // namespace

std::unique_ptr<MeshFile> parse_msh(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PointFile>();
  file->bytes = std::move(bytes);
  MshParser(*file).parse();
  return file;
}

}  // namespace unsnarl
