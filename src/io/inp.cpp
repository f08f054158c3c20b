// Abaqus input files: the nodes and the shells, membranes and rigid faces of three and four nodes (Abaqus Keywords
// Guide, *NODE, *ELEMENT, *PART, *INSTANCE). Numbers belong to their part or instance. All else is passed on.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "io/formats.h"
#include "io/point_file.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

constexpr auto triangle_types = std::to_array<std::string_view>(
    {"S3", "S3R", "S3RS", "S3T", "S3RT", "STRI3", "DS3", "M3D3", "R3D3", "SFM3D3", "CPS3", "CPE3"});
constexpr auto quad_types =
    std::to_array<std::string_view>({"S4", "S4R", "S4RS", "S4RSW", "S4R5", "S4T", "S4RT", "DS4", "M3D4", "M3D4R",
                                     "R3D4", "SFM3D4", "SFM3D4R", "CPS4", "CPS4R", "CPS4I", "CPE4", "CPE4R", "CPE4I"});
constexpr auto curved_types = std::to_array<std::string_view>(
    {"S6",    "STRI65", "S8R",    "S8RT",    "S8R5", "S9R5",  "DS6",  "DS8",   "M3D6", "M3D8",  "M3D8R", "M3D9",
     "M3D9R", "SFM3D6", "SFM3D8", "SFM3D8R", "CPS6", "CPS6M", "CPS8", "CPS8R", "CPE6", "CPE6M", "CPE8",  "CPE8R"});
/// They make nodes and elements that the file does not list.
constexpr auto generators =
    std::to_array<std::string_view>({"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"});

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

/// Parts of `text` between commas, without the blanks around them.
std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> result;
  for (;;) {
    const std::size_t comma = std::min(text.find(','), text.size());
    result.push_back(trimmed(text.substr(0, comma)));
    if (comma == text.size()) return result;
    text.remove_prefix(comma + 1);
  }
}

class InpParser {
 public:
  explicit InpParser(PointFile& file) : file_(file), bytes_(file.bytes), scopes_(1) {}

  void parse() {
    if (bytes_.empty()) throw FileError("the file is empty; an Abaqus input file has '*NODE' and '*ELEMENT' lines");
    while (next_line()) {
      if (line_.starts_with("**") || line_.empty()) continue;
      if (line_.front() == '*') {
        keyword();
      } else {
        data();
      }
    }
    expect_end_of_element();
    if (scopes_.size() > 1) fail(fmt::format("{} is not ended; the file is cut short", scopes_.back().name));
    close_scope();
    if (!has_keyword_)
      throw FileError("line 1: there is no keyword like '*NODE'; check that it is an Abaqus input file");
    if (file_.vertex_count() == 0) throw FileError("the file has no nodes ('*NODE'); give the file that lists them");
    if (solids_ > 0)
      file_.notes.push_back(fmt::format(
          "Volume elements ({}) are not looked at; those at moved vertices follow and may lose their shape.", solids_));
    file_.finish();
    sets_.finish(file_.face_count(), file_.labels);
    parts_.finish(file_.face_count(), file_.labels);
  }

 private:
  struct Shell {
    std::int64_t id;
    std::size_t place;
    std::array<std::int64_t, 4> nodes;
    std::size_t count;
    std::string_view set;  ///< of the file
  };
  /// Numbers that are known in it: those of the file, of a part or of an instance.
  struct Scope {
    std::string name;
    std::unordered_map<std::int64_t, std::int64_t> vertex_of_node;  // only looked up, so its order shows nowhere
    std::vector<Shell> shells;
  };
  enum class Data : std::uint8_t { other, nodes, shells, solids, instance };

  bool next_line() {
    if (next_ >= bytes_.size()) return false;
    const std::size_t end = std::min(bytes_.find_first_of("\r\n", next_), bytes_.size());
    begin_ = next_;
    line_ = trimmed(bytes_.substr(begin_, end - begin_));
    next_ = end + 1;
    if (end + 1 < bytes_.size() && bytes_[end] == '\r' && bytes_[end + 1] == '\n') ++next_;
    return true;
  }
  [[noreturn]] void fail(const std::string& message) const { fail(begin_, message); }
  [[noreturn]] void fail(std::size_t place, const std::string& message) const {
    TextScanner(bytes_, {}).fail(message, std::min(place, bytes_.size()));
  }
  std::size_t place_of(std::string_view field) const { return static_cast<std::size_t>(field.data() - bytes_.data()); }

  /// Goes on over lines that end with a comma.
  void keyword() {
    expect_end_of_element();
    has_keyword_ = true;
    const std::size_t start = begin_;
    std::vector<std::string_view> fields = fields_of(line_.substr(1));
    while (line_.ends_with(',') && next_line())
      for (const std::string_view field : fields_of(line_)) fields.push_back(field);
    begin_ = start;
    const std::string name = upper_case(fields[0]);
    parameters_.clear();
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const std::size_t sign = std::min(fields[i].find('='), fields[i].size());
      parameters_[upper_case(trimmed(fields[i].substr(0, sign)))] =
          trimmed(fields[i].substr(std::min(sign + 1, fields[i].size())));
    }
    data_ = Data::other;
    if (name == "NODE") {
      start_nodes();
    } else if (name == "ELEMENT") {
      start_elements();
    } else if (name == "PART") {
      open_scope("part " + std::string(parameters_["NAME"]));
      part_ = parameters_["NAME"];
    } else if (name == "INSTANCE") {
      start_instance();
    } else if (name == "ENDPART" || name == "END PART" || name == "END INSTANCE" || name == "ENDINSTANCE") {
      if (scopes_.size() < 2) fail(fmt::format("'*{}' without its beginning; the file is damaged", name));
      close_scope();
      scopes_.pop_back();
      part_ = {};
    } else if (contains(generators, name)) {
      fail(
          fmt::format("*{} makes or places nodes and elements that are not listed, which is not supported; write the "
                      "mesh in full",
                      name));
    } else if (name == "INCLUDE") {
      file_.notes.emplace_back("Files named by *INCLUDE are not looked at.");
    }
  }

  void start_nodes() {
    data_ = Data::nodes;
    refuse_other_file();
    if (const auto system = parameters_.find("SYSTEM");
        system != parameters_.end() && upper_case(system->second) != "R")
      fail("*NODE with cylindrical or spherical coordinates is not supported; write x, y and z");
  }
  void start_elements() {
    const std::string type = upper_case(parameters_["TYPE"]);
    if (contains(curved_types, type))
      fail(fmt::format("elements {} are curved, which is not supported; make them of the first order (S3, S4)", type));
    corners_ = contains(triangle_types, type) ? 3 : contains(quad_types, type) ? 4 : 0;
    set_ = parameters_["ELSET"];
    data_ = corners_ > 0                                          ? Data::shells
            : type.starts_with("C3D") || type.starts_with("DC3D") ? Data::solids
                                                                  : Data::other;
    if (corners_ > 0) refuse_other_file();
  }
  void refuse_other_file() const {
    if (parameters_.contains("INPUT"))
      fail("INPUT names another file, which is not supported; put its lines into this one");
  }
  void start_instance() {
    open_scope("instance " + std::string(parameters_["NAME"]));
    const std::string part = upper_case(parameters_["PART"]);
    if (!part.empty() && !instances_.insert(part).second)
      fail(fmt::format("part {} has a second instance, which is not supported; {}", part, flat_hint));
    data_ = Data::instance;
  }
  void open_scope(std::string name) {
    if (scopes_.size() > 1) fail(fmt::format("{} begins within {}; the file is damaged", name, scopes_.back().name));
    scopes_.emplace_back().name = std::move(name);
  }

  void data() {
    switch (data_) {
      case Data::nodes: return node();
      case Data::shells: return shell();
      case Data::solids: solids_ += !line_.ends_with(','); return;
      case Data::instance:
        fail(fmt::format("this instance is moved from where its part is, which is not supported; {}", flat_hint));
      default:
        if (!has_keyword_)
          fail("a keyword like '*NODE' should be before the first data; check that it is an Abaqus file");
    }
  }

  std::int64_t whole_number(std::string_view field, const char* what) const {
    std::int64_t value = 0;
    TextScanner text(bytes_.substr(0, place_of(field) + field.size()), {});
    text.seek(place_of(field));
    if (!text.integer(value)) fail(fmt::format("{} where {} should be", in_quotes(field), what));
    return value;
  }

  void node() {
    const std::vector<std::string_view> fields = fields_of(line_);
    const std::int64_t id = whole_number(fields[0], "the number of a node");
    std::array<double, 3> position{};
    std::array<NumberToken, 3> tokens;
    for (std::size_t k = 0; k < 3; ++k) {
      if (fields.size() < k + 2 || fields[k + 1].empty())
        fail(fmt::format("node {} has fewer than three coordinates; give it x, y and z", id));
      tokens[k] = {place_of(fields[k + 1]), static_cast<std::uint32_t>(fields[k + 1].size())};
      TextScanner text(bytes_.substr(0, tokens[k].begin + tokens[k].length), {});
      text.seek(tokens[k].begin);
      position[k] = text.coordinate<double>(static_cast<std::size_t>(std::max<std::int64_t>(id, 0)));
      if (!text.at_end()) fail(fmt::format("coordinate {} of node {} is not a number", in_quotes(fields[k + 1]), id));
    }
    if (!scopes_.back().vertex_of_node.try_emplace(id, static_cast<std::int64_t>(file_.vertex_count())).second)
      fail(fmt::format("node {} is there twice; number the nodes uniquely", id));
    file_.add_point(position, tokens);
  }

  /// An element goes on in the next line where one ends with a comma.
  void shell() {
    std::vector<std::string_view> fields = fields_of(line_);
    if (fields.back().empty()) fields.pop_back();
    std::size_t next = 0;
    if (!in_element_) {
      shell_ = {whole_number(fields.empty() ? line_ : fields[0], "the number of an element"), begin_, {}, 0, set_};
      next = 1;
    }
    for (; next < fields.size() && shell_.count < corners_; ++next)
      shell_.nodes[shell_.count++] = whole_number(fields[next], "a node of an element");
    in_element_ = shell_.count < corners_;
    if (in_element_ && !line_.ends_with(',')) expect_end_of_element();
    if (!in_element_) scopes_.back().shells.push_back(shell_);
  }
  void expect_end_of_element() const {
    if (in_element_)
      fail(shell_.place, fmt::format("element {} has {} of {} nodes; the file is cut short or damaged", shell_.id,
                                     shell_.count, corners_));
  }

  /// Nodes may come after the elements that use them, so faces are made where a scope ends.
  void close_scope() {
    Scope& scope = scopes_.back();
    if (!part_.empty()) {
      parts_.start(part_, file_.face_count());
    } else {
      parts_.stop(file_.face_count());
    }
    for (const Shell& shell : scope.shells) {
      if (shell.set.empty()) {
        sets_.stop(file_.face_count());
      } else {
        sets_.start(shell.set, file_.face_count());
      }
      std::array<std::int64_t, 4> face{};
      for (std::size_t k = 0; k < shell.count; ++k) {
        const auto vertex = scope.vertex_of_node.find(shell.nodes[k]);
        if (vertex == scope.vertex_of_node.end())
          fail(shell.place, fmt::format("element {} uses node {}, but {} lists none of this number", shell.id,
                                        shell.nodes[k], scope.name.empty() ? "the file" : scope.name));
        face[k] = vertex->second;
      }
      const std::string wrong = file_.add_face({face.data(), shell.count});
      if (!wrong.empty()) fail(shell.place, fmt::format("element {} {}", shell.id, wrong));
    }
  }

  static constexpr std::string_view flat_hint =
      "write the model without parts and assemblies (Abaqus/CAE: Model > Edit Attributes > Do not use parts and "
      "assemblies in input files)";
  PointFile& file_;
  std::string_view bytes_, line_;
  std::size_t begin_ = 0, next_ = 0;
  std::map<std::string, std::string_view> parameters_;  ///< of the keyword, in upper case
  Data data_ = Data::other;
  std::size_t corners_ = 0, solids_ = 0;
  std::string_view set_, part_;
  Shell shell_{};
  bool in_element_ = false, has_keyword_ = false;
  std::vector<Scope> scopes_;
  std::set<std::string> instances_;  ///< their parts
  LabelCollector sets_{"group"}, parts_{"object"};
};

}  // namespace

std::unique_ptr<MeshFile> parse_inp(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PointFile>();
  file->bytes = std::move(bytes);
  InpParser(*file).parse();
  return file;
}

}  // namespace unsnarl
