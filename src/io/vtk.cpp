// VTK legacy files with a data set of type POLYDATA or UNSTRUCTURED_GRID, ASCII and binary, versions 1 to 5.1 (VTK
// User's Guide, "VTK File Formats"; vtkDataReader.cxx for 5.1). Polygons and triangle strips make the surface; all else
// is passed on.
#include <fmt/format.h>

#include <array>

#include "io/formats.h"
#include "io/point_file.h"
#include "io/text_scanner.h"
#include "io/vtk_cells.h"

namespace unsnarl {
namespace {

constexpr auto vtk_types = std::to_array<NumberTypeName>({{"float", NumberType::float32},
                                                          {"double", NumberType::float64},
                                                          {"char", NumberType::int8},
                                                          {"signed_char", NumberType::int8},
                                                          {"unsigned_char", NumberType::uint8},
                                                          {"short", NumberType::int16},
                                                          {"unsigned_short", NumberType::uint16},
                                                          {"int", NumberType::int32},
                                                          {"unsigned_int", NumberType::uint32},
                                                          {"long", NumberType::int64},
                                                          {"unsigned_long", NumberType::uint64},
                                                          {"vtkidtype", NumberType::int32},
                                                          {"vtktypeint64", NumberType::int64},
                                                          {"vtktypeuint64", NumberType::uint64}});

std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

class VtkParser {
 public:
  explicit VtkParser(PointFile& file) : file_(file), text_(file.bytes, {}) {}

  void parse() {
    header();
    bool has_points = false;
    while (text_.skip_space()) {
      const std::size_t start = text_.offset();
      const std::string word = lower_case(text_.token());
      if (word == "points") {
        if (has_points) text_.fail("a second POINTS; the file is damaged", start);
        has_points = true;
        points();
      } else if (word == "polygons" || word == "triangle_strips" || word == "vertices" || word == "lines") {
        if (!has_points && (word == "polygons" || word == "triangle_strips"))
          text_.fail("POINTS should come before the cells", start);
        cells(word);
      } else if (word == "cells" && is_grid_) {
        if (!grid_.offsets.empty() || has_types_) text_.fail("a second CELLS; the file is damaged", start);
        grid_ = cell_lists();
      } else if (word == "cell_types" && is_grid_) {
        if (!has_points) text_.fail("POINTS should come before the cells", start);
        if (has_types_) text_.fail("a second CELL_TYPES; the file is damaged", start);
        grid_cells();
      } else if (word == "field") {
        fields();
      } else if (word == "metadata") {
        metadata();
      } else if (word == "point_data" || word == "cell_data") {
        break;  // nothing after it is geometry
      } else {
        text_.fail(fmt::format("{} where POINTS, POLYGONS or another keyword should be", in_quotes(word)), start);
      }
    }
    if (!has_points) text_.fail("the file has no POINTS; it is cut short");
    if (!grid_.offsets.empty() && !has_types_) text_.fail("the file has CELLS, but no CELL_TYPES; it is cut short");
    file_.finish();
  }

 private:
  void header() {
    if (file_.bytes.empty()) throw FileError("the file is empty; a VTK file starts with '# vtk DataFile Version'");
    const std::string first = lower_case(text_.rest_of_line());
    constexpr std::string_view start = "# vtk datafile version ";
    if (!first.starts_with(start))
      text_.fail("'# vtk DataFile Version' should be here; check that it is a VTK legacy file", 0);
    has_offsets_ = first.size() > start.size() && first[start.size()] >= '5' && first[start.size()] <= '9';
    text_.next_line();  // the title
    text_.skip_space();
    const std::size_t at = text_.offset();
    const std::string encoding = lower_case(text_.token());
    if (encoding != "ascii" && encoding != "binary")
      text_.fail(fmt::format("{} where ASCII or BINARY should be", in_quotes(encoding)), at);
    is_text_ = encoding == "ascii";
    text_.skip_space();
    const std::size_t set = text_.offset();
    if (lower_case(text_.token()) != "dataset") text_.fail("DATASET should be here; the file is damaged", set);
    text_.skip_space();
    const std::string kind = lower_case(text_.token());
    is_grid_ = kind == "unstructured_grid";
    if (kind != "polydata" && !is_grid_) {
      text_.fail(fmt::format("DATASET {}: only POLYDATA and UNSTRUCTURED_GRID are read; extract the surface first (in "
                             "ParaView: Filters > Extract Surface, and save as .vtk or .vtp)",
                             in_quotes(kind)),
                 set);
    }
  }

  std::size_t count(const char* what) {
    text_.skip_space();
    std::int64_t value = 0;
    if (!text_.integer(value) || value < 0)
      text_.fail(fmt::format("{} where the {} should be", in_quotes(text_.peek()), what));
    return static_cast<std::size_t>(value);
  }
  NumberType type() {
    text_.skip_space();
    const std::string name = lower_case(text_.peek());
    const std::optional<NumberType> known = number_type(name, vtk_types);
    if (!known) text_.fail(fmt::format("{} is not a supported number type", in_quotes(name)));
    text_.token();
    return *known;
  }

  /// The array that starts here; in binary that is the next line.
  NumberArray array(NumberType type, std::size_t count, const char* where) {
    NumberArray result;
    result.type = type;
    result.count = count;
    result.where = where;
    result.order = std::endian::big;
    result.is_text = is_text_;
    if (is_text_) {
      result.text = {text_.offset(), text_.remaining()};
    } else {
      text_.next_line();
      result.start = text_.offset();
    }
    result.check_size(file_.bytes);
    return result;
  }
  void skip(const NumberArray& array) {
    if (!is_text_) return text_.seek(array.start + array.count * size_of(array.type));
    for (std::size_t i = 0; i < array.count; ++i) {
      if (!text_.skip_space()) text_.fail(fmt::format("{} ends too early; the file is cut short", array.where));
      text_.token();
    }
  }
  std::vector<std::int64_t> whole_numbers(NumberType type, std::size_t count, const char* where) {
    const NumberArray numbers = array(type, count, where);
    if (is_integer(type)) {
      std::size_t end = numbers.start + count * size_of(type);
      std::vector<std::int64_t> result = unsnarl::whole_numbers(numbers, file_.bytes, &end);
      text_.seek(end);
      return result;
    }
    text_.fail(fmt::format("{} should be whole numbers", where));
  }

  void points() {
    const std::size_t n = count("number of points");
    if (n > file_.bytes.size()) text_.fail(fmt::format("{} points cannot be in this file; it is damaged", n));
    NumberArray numbers = array(type(), 3 * n, "POINTS");
    if (is_integer(numbers.type))
      file_.notes.emplace_back(
          "The positions are stored as integers, which cannot hold a repaired mesh; convert them first.");
    std::size_t end = numbers.start + numbers.count * size_of(numbers.type);
    file_.add_points(std::move(numbers), {}, PointFile::Missing::refused, &end);
    text_.seek(end);
  }

  /// The points of cell c are corners[offsets[c]] to corners[offsets[c + 1] - 1].
  struct CellLists {
    std::vector<std::int64_t> offsets, corners;
  };

  CellLists cell_lists() {
    const std::size_t n = count("number of cells"), size = count("size of the list");
    if (!has_offsets_) return counted_lists(whole_numbers(NumberType::int32, size, "the list of cells"), n);
    CellLists lists;
    lists.offsets = section("offsets", n);
    lists.corners = section("connectivity", size);
    return lists;
  }
  std::span<const std::int64_t> cell(const CellLists& lists, std::size_t c, const std::string& kind) const {
    const std::int64_t begin = lists.offsets[c], end = lists.offsets[c + 1];
    if (begin < 0 || end < begin || end > static_cast<std::int64_t>(lists.corners.size()))
      text_.fail(fmt::format("{}: cell {} (counting from 0) reaches beyond the list; the file is damaged", kind, c));
    return {lists.corners.data() + begin, static_cast<std::size_t>(end - begin)};
  }
  void cells(const std::string& kind) {
    const CellLists lists = cell_lists();
    if (kind != "polygons" && kind != "triangle_strips") return;
    for (std::size_t c = 0; c + 1 < lists.offsets.size(); ++c) {
      const std::span<const std::int64_t> points = cell(lists, c, kind);
      const std::string wrong = kind == "polygons" ? file_.add_face(points) : file_.add_strip(points);
      if (!wrong.empty()) text_.fail(fmt::format("{}: cell {} (counting from 0) {}", kind, c, wrong));
    }
  }
  /// The cells of an unstructured grid, once their types are here.
  void grid_cells() {
    has_types_ = true;
    const std::size_t n = count("number of cells"), cells = grid_.offsets.empty() ? 0 : grid_.offsets.size() - 1;
    if (n != cells) text_.fail(fmt::format("{} types for {} cells; the file is damaged", n, cells));
    const std::vector<std::int64_t> types = whole_numbers(NumberType::int32, n, "CELL_TYPES");
    for (std::size_t c = 0; c < n; ++c) {
      const std::string wrong = add_vtk_cell(file_, types[c], cell(grid_, c, "CELLS"));
      if (!wrong.empty()) text_.fail(fmt::format("CELLS: cell {} (counting from 0) {}", c, wrong));
    }
  }
  std::vector<std::int64_t> section(const char* keyword, std::size_t n) {
    text_.skip_space();
    if (lower_case(text_.peek()) != keyword)
      text_.fail(fmt::format("{} where {} should be", in_quotes(text_.peek()), keyword));
    text_.token();
    return whole_numbers(type(), n, keyword);
  }
  /// From lists "3 0 1 2 4 0 1 2 3" to offsets and corners.
  CellLists counted_lists(std::vector<std::int64_t> list, std::size_t n) const {
    CellLists result;
    auto& [offsets, corners] = result;
    offsets.push_back(0);
    std::size_t at = 0;
    for (std::size_t c = 0; c < n; ++c) {
      if (at >= list.size() || list[at] < 0 || static_cast<std::uint64_t>(list[at]) > list.size() - at - 1) {
        text_.fail(fmt::format("cell {} of {} (counting from 0) reaches beyond the list of {} numbers; it is damaged",
                               c, n, list.size()));
      }
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(at) + 1;
      corners.insert(corners.end(), first, first + list[at]);
      offsets.push_back(static_cast<std::int64_t>(corners.size()));
      at += 1 + static_cast<std::size_t>(list[at]);
    }
    return result;
  }

  void fields() {
    text_.skip_blanks();
    text_.token();  // the name
    const std::size_t arrays = count("number of arrays");
    for (std::size_t i = 0; i < arrays; ++i) {
      if (!text_.skip_space()) text_.fail("the file ends within a FIELD; it is cut short");
      if (lower_case(text_.peek()) == "metadata") {
        text_.token();
        metadata();
        text_.skip_space();
      }
      text_.token();  // the name
      const std::size_t components = count("number of components"), tuples = count("number of tuples");
      const NumberType numbers = type();
      if (tuples > 0 && components > file_.bytes.size() / tuples)
        text_.fail(fmt::format("{} x {} numbers cannot be in this file; it is damaged", tuples, components));
      skip(array(numbers, components * tuples, "FIELD"));
    }
  }
  /// Lines up to an empty one.
  void metadata() {
    text_.next_line();
    while (!text_.at_end() && !text_.rest_of_line().empty()) continue;
  }

  PointFile& file_;
  TextScanner text_;
  bool is_text_ = false, has_offsets_ = false, is_grid_ = false, has_types_ = false;
  CellLists grid_;  // until the types of its cells are known
};

}  // namespace

std::unique_ptr<MeshFile> parse_vtk(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<PointFile>();
  file->bytes = std::move(bytes);
  VtkParser(*file).parse();
  return file;
}

}  // namespace unsnarl
