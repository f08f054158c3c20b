// VTK's XML files of type PolyData (.vtp) and UnstructuredGrid (.vtu): numbers as text, as base64, or appended as
// base64 or raw bytes; compressed by zlib or not (VTK User's Guide, "XML File Formats"; vtkXMLDataParser.cxx). Polygons
// and triangle strips make the surface; all else is passed on.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "io/base64.h"
#include "io/base64_numbers.h"
#include "io/byte_order.h"
#include "io/formats.h"
#include "io/point_file.h"
#include "io/text_scanner.h"
#include "io/vtk_cells.h"
#include "io/xml_text.h"
#include "io/zlib_stream.h"

namespace unsnarl {
namespace {

constexpr auto vtp_types = std::to_array<NumberTypeName>({{"Int8", NumberType::int8},
                                                          {"UInt8", NumberType::uint8},
                                                          {"Int16", NumberType::int16},
                                                          {"UInt16", NumberType::uint16},
                                                          {"Int32", NumberType::int32},
                                                          {"UInt32", NumberType::uint32},
                                                          {"Int64", NumberType::int64},
                                                          {"UInt64", NumberType::uint64},
                                                          {"Float32", NumberType::float32},
                                                          {"Float64", NumberType::float64}});

/// Numbers before a piece of binary data, which say how long it is.
struct Headers {
  NumberType type = NumberType::uint32;
  std::endian order = std::endian::little;

  std::size_t size() const { return size_of(type); }
  /// All bits set (so larger than any file) where `bytes` is too short.
  std::size_t at(std::string_view bytes, std::size_t i) const {
    if (bytes.size() / size() <= i) return ~std::size_t{0};
    return static_cast<std::size_t>(*load_whole_number(bytes.data() + i * size(), type, order));
  }
  void append(std::string& bytes, std::size_t value) const {
    std::array<char, 8> raw{};
    if (type == NumberType::uint32) {
      store(raw.data(), static_cast<std::uint32_t>(value), order);
    } else {
      store(raw.data(), static_cast<std::uint64_t>(value), order);
    }
    bytes.append(raw.data(), size());
  }
};

std::size_t base64_size(std::size_t bytes) {
  return bytes / 3 * 4 + (bytes % 3 == 0 ? 0 : 4);
}

/// Data in blocks that are compressed one by one: headers (number of blocks, size of a block, size of the last one if
/// it is smaller, compressed sizes), then the blocks; each of the two parts in base64, or raw.
class CompressedBlocks final : public EncodedNumbers {
 public:
  /// `available` is the part of the file from the first header on. Throws FileError, without a place.
  CompressedBlocks(std::string_view file, ByteRange available, bool is_base64, Headers headers)
      : range_(available), is_base64_(is_base64), headers_(headers) {
    std::string_view text = file.substr(available.begin, available.size);
    while (is_base64 && !text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
    range_.begin = available.begin + available.size - text.size();
    const std::size_t count = headers.at(part(text, 0, headers.size()), 0);
    if (count > text.size() / headers.size()) throw FileError("the number of blocks is larger than the file");
    const std::size_t header_size = (3 + count) * headers.size();
    const std::string header = part(text, 0, header_size);
    block_size_ = headers.at(header, 1);
    last_size_ = headers.at(header, 2);
    std::size_t packed = 0;
    for (std::size_t b = 0; b < count; ++b) {
      packed_sizes_.push_back(headers.at(header, 3 + b));
      if (packed_sizes_.back() > text.size() - std::min(packed, text.size()))
        throw FileError(fmt::format("compressed block {} reaches beyond the end", b));
      packed += packed_sizes_.back();
    }
    const std::size_t header_length = is_base64 ? base64_size(header_size) : header_size;
    packed_ = part(text, header_length, packed);
    range_.size = header_length + (is_base64 ? base64_size(packed) : packed);
    std::size_t at = 0;
    for (std::size_t b = 0; b < count; ++b) {
      const std::optional<std::string> block =
          inflated(std::string_view(packed_).substr(at, packed_sizes_[b]), size_of_block(b));
      if (!block) throw FileError(fmt::format("compressed block {} of {} (counting from 0) is damaged", b, count));
      bytes += *block;
      at += packed_sizes_[b];
    }
  }

  ByteRange range() const { return range_; }
  void replace(std::string_view, std::string_view changed, std::vector<TextEdit>& edits) const override {
    std::string header, body;
    headers_.append(header, packed_sizes_.size());
    headers_.append(header, block_size_);
    headers_.append(header, last_size_);
    std::size_t at = 0, packed_at = 0;
    for (std::size_t b = 0; b < packed_sizes_.size(); ++b) {
      const std::string_view block = changed.substr(at, size_of_block(b));
      const std::size_t before = body.size();
      if (block == std::string_view(bytes).substr(at, block.size())) {
        body.append(packed_, packed_at, packed_sizes_[b]);
      } else {
        body += deflated(block, false);
      }
      headers_.append(header, body.size() - before);
      at += block.size();
      packed_at += packed_sizes_[b];
    }
    edits.push_back({range_.begin, range_.begin + range_.size,
                     is_base64_ ? base64_encoded(header) + base64_encoded(body) : header + body});
  }

 private:
  /// The `size` bytes that are stored at `at`.
  std::string part(std::string_view text, std::size_t at, std::size_t size) const {
    const std::size_t length = is_base64_ ? base64_size(size) : size;
    if (at > text.size() || length > text.size() - at || size > text.size())
      throw FileError("it ends too early; the file is cut short");
    const std::string_view stored = text.substr(at, length);
    std::optional<std::string> result = is_base64_ ? base64_decoded(stored) : std::string(stored);
    if (!result || result->size() < size) throw FileError("it holds characters that are not base64");
    result->resize(size);
    return *result;
  }
  std::size_t size_of_block(std::size_t b) const {
    return b + 1 == packed_sizes_.size() && last_size_ != 0 ? last_size_ : block_size_;
  }

  ByteRange range_;
  bool is_base64_;
  Headers headers_;
  std::size_t block_size_ = 0, last_size_ = 0;
  std::vector<std::size_t> packed_sizes_;
  std::string packed_;
};

/// Appended data that changes its length moves what is behind it.
class VtpFile final : public PointFile {
 public:
  struct Offset {
    ByteRange text;
    std::size_t value;
  };
  std::vector<Offset> offsets;  ///< attributes that count from `appended`
  std::size_t appended = 0;

 protected:
  void add_consequences(std::vector<TextEdit>& edits) const override {
    const std::size_t count = edits.size();
    for (const Offset& offset : offsets) {
      std::size_t moved = offset.value;
      for (std::size_t e = 0; e < count; ++e)
        if (edits[e].begin >= appended && edits[e].begin < appended + offset.value)
          moved += edits[e].text.size() - (edits[e].end - edits[e].begin);
      if (moved != offset.value)
        edits.push_back({offset.text.begin, offset.text.begin + offset.text.size, std::to_string(moved)});
    }
  }
};

/// The part of the file that is XML: up to the appended data.
std::string_view xml_part(std::string_view bytes) {
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) return bytes;
  const std::size_t end = bytes.find('>', tag);
  return end == std::string_view::npos ? bytes : bytes.substr(0, end + 1);
}

class VtpParser {
 public:
  explicit VtpParser(VtpFile& file)
      : file_(file),
        bytes_(file.bytes),
        xml_(xml_part(bytes_), "VTKFile",
             xml_part(bytes_).size() < bytes_.size() ? "</AppendedData></VTKFile>" : std::string_view{}) {}

  void parse() {
    const pugi::xml_node root = xml_.root();
    const std::string_view kind = root.attribute("type").value();
    is_grid_ = kind == "UnstructuredGrid";
    if (kind != "PolyData" && !is_grid_) {
      xml_.fail(root, fmt::format("type {}: only PolyData and UnstructuredGrid are read; extract the surface first (in "
                                  "ParaView: Filters > Extract Surface, and save as .vtp)",
                                  in_quotes(kind)));
    }
    const bool is_big = root.attribute("byte_order").value() == std::string_view("BigEndian");
    headers_.order = is_big ? std::endian::big : std::endian::little;
    if (root.attribute("header_type").value() == std::string_view("UInt64")) headers_.type = NumberType::uint64;
    const std::string_view compressor = root.attribute("compressor").value();
    is_compressed_ = !compressor.empty();
    if (is_compressed_ && compressor != "vtkZLibDataCompressor") {
      xml_.fail(root, fmt::format("compressor {}: only vtkZLibDataCompressor is read; save the file with it or without "
                                  "compression",
                                  in_quotes(compressor)));
    }
    find_appended_data();
    const pugi::xml_node data = root.child(std::string(kind).c_str());
    if (!data) xml_.fail(root, fmt::format("it has no <{}>; the file is damaged", kind));
    std::size_t number = 0;
    for (const pugi::xml_node& element : data.children("Piece")) piece(element, number++);
    if (number == 0) xml_.fail(data, "it has no <Piece>; the file is damaged");
    check_overlaps();
    file_.finish();
  }

 private:
  void find_appended_data() {
    const pugi::xml_node element = xml_.root().child("AppendedData");
    if (!element) return;
    std::size_t at = xml_part(bytes_).size();
    while (at < bytes_.size() && static_cast<unsigned char>(bytes_[at]) <= ' ') ++at;
    if (at >= bytes_.size() || bytes_[at] != '_')
      xml_.fail(element, "<AppendedData> should start with '_'; the file is cut short or damaged");
    file_.appended = at + 1;
    const std::string_view encoding = element.attribute("encoding").value();
    if (encoding != "raw" && encoding != "base64")
      xml_.fail(element, fmt::format("encoding {} of <AppendedData> is none of raw and base64", in_quotes(encoding)));
    is_raw_ = encoding == "raw";
    collect_offsets();
  }
  /// In the order of the text, without recursion: the depth is up to the file.
  void collect_offsets() {
    for (pugi::xml_node node = xml_.root(); node;) {
      if (const pugi::xml_attribute offset = node.attribute("offset");
          offset && node.attribute("format").value() == std::string_view("appended")) {
        file_.offsets.push_back({xml_.range(offset), xml_.whole_number(node, "offset", 0)});
      }
      pugi::xml_node next = node.first_child();
      for (; !next && node; node = node.parent()) next = node.next_sibling();
      node = next;
    }
  }

  void piece(const pugi::xml_node& piece, std::size_t number) {
    const std::size_t n = xml_.whole_number(piece, "NumberOfPoints", 0);
    const auto first = static_cast<std::int64_t>(file_.vertex_count());
    const pugi::xml_node points = piece.child("Points").child("DataArray");
    if (!points) {
      if (n > 0) xml_.fail(piece, fmt::format("piece {} has no points, but promises {}", number, n));
      return;
    }
    if (xml_.whole_number(points, "NumberOfComponents", 1) != 3)
      xml_.fail(points, "the points should have 3 components");
    NumberArray numbers = array(points, 3, n, fmt::format("the points of piece {}", number));
    if (is_integer(numbers.type))
      file_.notes.emplace_back(
          "The positions are stored as integers, which cannot hold a repaired mesh; convert them first.");
    try {
      file_.add_points(std::move(numbers), {});
    } catch (const FileError& error) {
      fail_in(points, error);
    }
    const PieceOfPoints of = {piece, number, first, static_cast<std::int64_t>(n)};
    if (is_grid_) return grid_cells(of);
    cells(of, "Polys", "NumberOfPolys", [&](std::size_t, const auto& cell) { return file_.add_face(cell); });
    cells(of, "Strips", "NumberOfStrips", [&](std::size_t, const auto& cell) { return file_.add_strip(cell); });
  }

  /// A piece, its number, its first point in the file and how many it has.
  struct PieceOfPoints {
    pugi::xml_node element;
    std::size_t number;
    std::int64_t first, points;
  };

  void grid_cells(const PieceOfPoints& of) {
    const std::size_t count = xml_.whole_number(of.element, "NumberOfCells", 0);
    if (count == 0) return;
    const pugi::xml_node types_element = named(of.element.child("Cells"), "types");
    if (!types_element) xml_.fail(of.element, "<Cells> should have the array 'types'");
    const std::vector<std::int64_t> types =
        whole_numbers(types_element, count, fmt::format("Cells of piece {}, types", of.number));
    cells(of, "Cells", "NumberOfCells",
          [&](std::size_t c, const auto& cell) { return add_vtk_cell(file_, types[c], cell); });
  }

  /// add(c, points): adds cell c of the piece; returns what is wrong with it.
  template <class Add>
  void cells(const PieceOfPoints& of, const char* kind, const char* counter, const Add& add) {
    const auto& [piece, number, first, points] = of;
    const std::size_t count = xml_.whole_number(piece, counter, 0);
    if (count == 0) return;
    const pugi::xml_node ends_element = named(piece.child(kind), "offsets"),
                         corners_element = named(piece.child(kind), "connectivity");
    if (!ends_element || !corners_element)
      xml_.fail(piece, fmt::format("<{}> should have the arrays 'offsets' and 'connectivity'", kind));
    const std::string where = fmt::format("{} of piece {}", kind, number);
    const std::vector<std::int64_t> ends = whole_numbers(ends_element, count, where + ", offsets");
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < count; ++c) {
      if (ends[c] < begin) xml_.fail(ends_element, fmt::format("{}: the offset of cell {} decreases", where, c));
      begin = ends[c];
    }
    std::vector<std::int64_t> corners =
        whole_numbers(corners_element, static_cast<std::size_t>(ends.back()), where + ", connectivity");
    begin = 0;
    for (std::size_t c = 0; c < count; ++c) {
      const std::span<std::int64_t> cell(corners.data() + begin, static_cast<std::size_t>(ends[c] - begin));
      begin = ends[c];
      for (std::int64_t& v : cell) {
        if (v < 0 || v >= points)
          xml_.fail(corners_element,
                    fmt::format("{}: cell {} uses point {}, but there are {} (counting from 0)", where, c, v, points));
        v += first;
      }
      const std::string wrong = add(c, std::span<const std::int64_t>(cell));
      if (!wrong.empty()) xml_.fail(corners_element, fmt::format("{}: cell {} {}", where, c, wrong));
    }
  }

  static pugi::xml_node named(const pugi::xml_node& of, const char* name) {
    return of.find_child_by_attribute("DataArray", "Name", name);
  }
  std::vector<std::int64_t> whole_numbers(const pugi::xml_node& element, std::size_t count, const std::string& where) {
    const NumberArray numbers = array(element, 1, count, where);
    if (!is_integer(numbers.type)) xml_.fail(element, where + " should be whole numbers");
    try {
      return unsnarl::whole_numbers(numbers, bytes_);
    } catch (const FileError& error) {
      fail_in(element, error);
    }
  }
  /// Adds the line to messages that lack it.
  [[noreturn]] void fail_in(const pugi::xml_node& element, const FileError& error) const {
    const std::string_view what = error.what();
    if (what.starts_with("line ") || what.starts_with("byte ")) throw FileError(error);
    xml_.fail(element, error.what());
  }

  NumberArray array(const pugi::xml_node& element, std::size_t components, std::size_t rows, std::string where) {
    NumberArray result;
    result.where = std::move(where);
    const std::string_view type_name = element.attribute("type").value();
    const std::optional<NumberType> type = number_type(type_name, vtp_types);
    if (!type) xml_.fail(element, fmt::format("{}: type {} is not read", result.where, in_quotes(type_name)));
    if (rows > bytes_.size() * largest_numbers_per_byte)
      xml_.fail(element, fmt::format("{}: {} rows cannot be in a file of {} bytes; it is cut short or damaged",
                                     result.where, rows, bytes_.size()));
    result.type = *type;
    result.count = components * rows;
    result.order = headers_.order;
    const std::string_view format = element.attribute("format").value();
    if (format == "ascii" || format.empty()) {
      result.is_text = true;
      result.text = xml_.content(element);
      return result;
    }
    if (result.count == 0) {  // some writers leave out even the header
      result.is_text = true;
      return result;
    }
    try {
      if (format == "binary") {
        in_base64(result, xml_.content(element), false);
      } else if (format == "appended") {
        appended(result, element);
      } else {
        throw FileError("format " + in_quotes(format) + " is none of ascii, binary and appended");
      }
    } catch (const FileError& error) {
      xml_.fail(element, fmt::format("{}: {}", result.where, error.what()));
    }
    return result;
  }

  void appended(NumberArray& array, const pugi::xml_node& element) {
    const std::size_t offset = xml_.whole_number(element, "offset", 0);
    if (file_.appended == 0) throw FileError("its data are appended, but there is no <AppendedData>; it is cut short");
    if (offset > bytes_.size() - file_.appended) throw FileError("its offset lies beyond the file; it is cut short");
    const std::size_t begin = file_.appended + offset;
    if (!is_raw_) return in_base64(array, {begin, bytes_.size() - begin}, true);
    if (is_compressed_) return in_blocks(array, {begin, bytes_.size() - begin}, false);
    const std::string_view data = bytes_.substr(begin);
    const std::size_t size = headers_.at(data, 0);
    if (data.size() < headers_.size() || size > data.size() - headers_.size())
      throw FileError("its data reach beyond the end of the file; it is cut short");
    if (size / size_of(array.type) < array.count)
      throw FileError(fmt::format("{} bytes of data are too few; the file is damaged", size));
    array.start = begin + headers_.size();
    used_.push_back({begin, headers_.size() + size});
  }
  void in_blocks(NumberArray& array, ByteRange range, bool is_base64) {
    const auto blocks = std::make_shared<CompressedBlocks>(bytes_, range, is_base64, headers_);
    used_.push_back(blocks->range());
    array.encoded = blocks;
  }

  /// `goes_on`: other digits follow.
  void in_base64(NumberArray& array, ByteRange range, bool goes_on) {
    if (is_compressed_) return in_blocks(array, range, true);
    if (goes_on) {
      const std::size_t length = base64_size(headers_.size());
      const std::optional<std::string> header =
          base64_decoded(bytes_.substr(range.begin, std::min(length, range.size)));
      const std::size_t size = header ? headers_.at(*header, 0) : ~std::size_t{0};
      if (size > range.size || base64_size(headers_.size() + size) > range.size)
        throw FileError("its data reach beyond the end of the file; it is cut short or damaged");
      range.size = base64_size(headers_.size() + size);
    }
    used_.push_back(range);
    array.start = headers_.size();
    array.encoded = std::make_shared<Base64Numbers>(bytes_, range, false, 0, "it");
    if (array.encoded->bytes.size() < headers_.size() ||
        headers_.at(array.encoded->bytes, 0) > array.encoded->bytes.size() - headers_.size())
      throw FileError("its base64 digits are fewer than its header says; the file is cut short");
  }

  /// Bytes that mean two things cannot be changed for one of them.
  void check_overlaps() {
    std::sort(used_.begin(), used_.end(), [](const ByteRange& a, const ByteRange& b) { return a.begin < b.begin; });
    for (std::size_t i = 1; i < used_.size(); ++i)
      if (used_[i].begin < used_[i - 1].begin + used_[i - 1].size)
        throw FileError(fmt::format("byte {}: two arrays share their data, or the file is damaged; store them apart",
                                    used_[i].begin));
  }

  /// A file that declares more numbers than this for each of its bytes is refused: deflate cannot pack them (fixed by
  /// deflate)
  static constexpr std::size_t largest_numbers_per_byte = 1100;
  VtpFile& file_;
  std::string_view bytes_;
  XmlText xml_;
  Headers headers_;
  std::vector<ByteRange> used_;  ///< binary data of the arrays that were read
  bool is_compressed_ = false, is_raw_ = false, is_grid_ = false;
};

}  // namespace

std::unique_ptr<MeshFile> parse_vtp(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<VtpFile>();
  file->bytes = std::move(bytes);
  VtpParser(*file).parse();
  return file;
}

}  // namespace unsnarl
