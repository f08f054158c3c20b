#include "io/ply_header.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/byte_order.h"
#include "io/text_scanner.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

std::optional<PlyScalar> scalar_by_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, PlyScalar>, 16> names = {{{"char", PlyScalar::int8},
                                                                             {"int8", PlyScalar::int8},
                                                                             {"uchar", PlyScalar::uint8},
                                                                             {"uint8", PlyScalar::uint8},
                                                                             {"short", PlyScalar::int16},
                                                                             {"int16", PlyScalar::int16},
                                                                             {"ushort", PlyScalar::uint16},
                                                                             {"uint16", PlyScalar::uint16},
                                                                             {"int", PlyScalar::int32},
                                                                             {"int32", PlyScalar::int32},
                                                                             {"uint", PlyScalar::uint32},
                                                                             {"uint32", PlyScalar::uint32},
                                                                             {"float", PlyScalar::float32},
                                                                             {"float32", PlyScalar::float32},
                                                                             {"double", PlyScalar::float64},
                                                                             {"float64", PlyScalar::float64}}};
  for (const auto& [known, type] : names) {
    if (known == name) return type;
  }
  return std::nullopt;
}

class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : text_(text), lines_(text, {}) {}

  PlyHeader parse() {
    if (text_.empty()) throw FileError("the file is empty; a PLY file starts with 'ply'");
    if (next_word() != "ply" || !at_line_end()) throw FileError("line 1: 'ply' missing; check that it is a PLY file");
    // In a binary file the byte after the last line could be anything, so its end looks like that of the first line.
    const bool crlf = text_.substr(lines_.offset()).starts_with("\r\n");
    lines_.next_line();
    bool has_format = false;
    for (;;) {
      if (lines_.at_end()) lines_.fail("the file ends within the header ('end_header' missing); it is cut short");
      line_ = lines_.offset();
      const std::string_view word = next_word();
      if (word == "end_header") {
        finish(crlf);
        break;
      }
      if (word == "format") {
        format();
        has_format = true;
      } else if (word == "element") {
        element();
      } else if (word == "property") {
        property();
      } else if (word != "comment" && word != "obj_info" && !word.empty()) {
        lines_.fail(fmt::format("{} is not a PLY header line", in_quotes(word)), line_);
      }
      lines_.next_line();
    }
    if (!has_format) lines_.fail("the header has no 'format' line", line_);
    return std::move(header_);
  }

 private:
  std::string_view next_word() {
    lines_.skip_blanks();
    return lines_.token();
  }
  bool at_line_end() { return !lines_.skip_blanks(); }

  void format() {
    const std::string_view name = next_word();
    header_.ascii = name == "ascii";
    header_.order = name == "binary_big_endian" ? std::endian::big : std::endian::little;
    if (!header_.ascii && name != "binary_little_endian" && name != "binary_big_endian") {
      lines_.fail(fmt::format("unknown format {}; ascii, binary_little_endian or binary_big_endian is possible",
                              in_quotes(name)),
                  line_);
    }
  }
  void element() {
    PlyElement result;
    result.name = next_word();
    lines_.skip_blanks();
    std::int64_t count = 0;
    if (!lines_.integer(count) || count < 0) lines_.fail("an element line is 'element NAME COUNT'", line_);
    result.count = static_cast<std::size_t>(count);
    header_.elements.push_back(std::move(result));
  }
  PlyScalar scalar() {
    const std::string_view name = next_word();
    const std::optional<PlyScalar> type = scalar_by_name(name);
    if (!type) lines_.fail(fmt::format("unknown property type {}", in_quotes(name)), line_);
    return *type;
  }
  void property() {
    if (header_.elements.empty()) lines_.fail("a property before the first element", line_);
    PlyProperty result;
    lines_.skip_blanks();
    if (lines_.peek() == "list") {
      lines_.token();
      result.count_type = scalar();
      if (!is_integer(*result.count_type)) lines_.fail("the length of a list must have an integer type", line_);
    }
    result.type = scalar();
    result.name = next_word();
    header_.elements.back().properties.push_back(std::move(result));
  }
  void finish(bool crlf) {
    lines_.skip_blanks();
    const std::size_t end = lines_.offset();
    const std::string_view rest = text_.substr(end);
    if (rest.empty()) {
      header_.size = end;
    } else if (rest[0] == '\n') {
      header_.size = end + 1;
    } else if (rest[0] == '\r') {
      header_.size = end + (crlf && rest.starts_with("\r\n") ? 2 : 1);
    } else {
      lines_.fail("'end_header' is not alone on its line", line_);
    }
  }

  std::string_view text_;
  TextScanner lines_;
  PlyHeader header_;
  std::size_t line_ = 0;
};

}  // namespace

double load_scalar(const char* from, PlyScalar type, std::endian order) {
  switch (type) {
    case PlyScalar::int8: return load<std::int8_t>(from, order);
    case PlyScalar::uint8: return load<std::uint8_t>(from, order);
    case PlyScalar::int16: return load<std::int16_t>(from, order);
    case PlyScalar::uint16: return load<std::uint16_t>(from, order);
    case PlyScalar::int32: return load<std::int32_t>(from, order);
    case PlyScalar::uint32: return load<std::uint32_t>(from, order);
    case PlyScalar::float32: return load<float>(from, order);
    case PlyScalar::float64: break;
  }
  return load<double>(from, order);
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property) return i;
  }
  return std::nullopt;
}

std::size_t PlyElement::smallest_record() const {
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.count_type.value_or(p.type));
  return size;
}

PlyHeader parse_ply_header(std::string_view text) {
  return HeaderParser(text).parse();
}

}  // namespace unsnarl
