// Object File Format (Geomview): OFF with optional ST, C and N prefixes, as text.
#include <fmt/format.h>

#include "io/coordinate_text_file.h"
#include "io/formats.h"
#include "io/surface_builder.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

class OffParser {
 public:
  explicit OffParser(CoordinateTextFile& file)
      : file_(file), text_(without_end_marks(file.bytes), {.hash_comments = true}) {}

  void parse() {
    if (file_.bytes.empty()) throw FileError("the file is empty; an OFF file starts with 'OFF'");
    keyword();
    counts();
    one_line_each_ = lines_left_are_at_least(vertex_count_ + face_count_);
    for (std::size_t v = 0; v < vertex_count_; ++v) vertex(v);
    for (std::size_t f = 0; f < face_count_; ++f) face(f);
    faces_.note_ignored(file_.notes);
  }

 private:
  void keyword() {
    text_.skip_space();
    const std::size_t start = text_.offset();
    std::string_view word = text_.peek();
    const std::string shown = in_quotes(word);
    const auto take = [&word](std::string_view prefix) {
      if (!word.starts_with(prefix)) return std::size_t{0};
      word.remove_prefix(prefix.size());
      return prefix.size();
    };
    std::size_t length = 0;
    const auto take_flag = [&](std::string_view prefix, std::size_t numbers) {
      const std::size_t taken = take(prefix);
      length += taken;
      if (taken > 0) extra_numbers_ += numbers;
    };
    take_flag("ST", 2);
    take_flag("C", 4);
    take_flag("N", 3);
    if (word.starts_with("4") || word.starts_with("n")) {
      text_.fail(fmt::format("{} holds vertices of another dimension than three; only three is supported", shown),
                 start);
    }
    const std::size_t taken = take("OFF");
    // Some data sets have the first count stuck to the keyword: 'OFF490 518 0'.
    if (taken == 0 || (!word.empty() && (word[0] < '0' || word[0] > '9'))) {
      text_.fail(fmt::format("{} where 'OFF' should be; check that it is an OFF file", shown), start);
    }
    text_.seek(start + length + taken);
    if (text_.skip_blanks() && text_.peek() == "BINARY") {
      text_.fail("binary OFF is not supported; convert it to text OFF or PLY");
    }
  }

  std::size_t count(const char* what) {
    text_.skip_space();
    std::int64_t value = 0;
    if (!text_.integer(value) || value < 0) {
      text_.fail(fmt::format("{} where the number of {} should be", in_quotes(text_.peek()), what));
    }
    // Each vertex and face takes at least two characters of the file.
    if (static_cast<std::uint64_t>(value) > text_.remaining() / 2 || value > std::numeric_limits<std::int32_t>::max()) {
      text_.fail(fmt::format("the header promises {} {}, but only {} bytes follow; the file is cut short or damaged",
                             value, what, text_.remaining()));
    }
    return static_cast<std::size_t>(value);
  }

  void counts() {
    vertex_count_ = count("vertices");
    face_count_ = count("faces");
    std::int64_t edges = 0;
    if (text_.skip_blanks() && !text_.integer(edges)) {  // often missing, never used
      text_.fail(fmt::format("{} where the number of edges should be", in_quotes(text_.peek())));
    }
    file_.surface.positions.reserve(3 * vertex_count_);
    file_.begins.reserve(3 * vertex_count_);
    file_.surface.corners.reserve(3 * face_count_);
  }

  /// Usual files have a line for each vertex and face, and whatever else the line holds is not ours. The format also
  /// allows any other layout; then the keyword alone says how many numbers a vertex has.
  bool lines_left_are_at_least(std::size_t wanted) {
    const std::size_t start = text_.offset();
    std::size_t lines = 0;
    while (lines < wanted && text_.skip_space()) {
      ++lines;
      text_.next_line();
    }
    text_.seek(start);
    return lines >= wanted;
  }

  void vertex(std::size_t v) {
    if (!text_.skip_space()) {
      text_.fail(fmt::format("the file ends after {} of {} vertices; it is cut short", v, vertex_count_));
    }
    for (int k = 0; k < 3; ++k) {
      if (!one_line_each_) text_.skip_space();
      text_.skip_blanks();
      file_.begins.push_back(text_.offset());
      file_.surface.positions.push_back(text_.coordinate<double>(v));
    }
    if (one_line_each_) {
      text_.next_line();
    } else {
      for (std::size_t k = 0; k < extra_numbers_; ++k) {
        text_.skip_space();
        text_.token();
      }
    }
  }

  std::int64_t face_number(std::size_t f) {
    if (one_line_each_) {
      text_.skip_blanks();
    } else {
      text_.skip_space();
    }
    std::int64_t value = 0;
    if (!text_.integer(value)) {
      text_.fail(text_.at_end() ? fmt::format("the file ends after {} of {} faces; it is cut short", f, face_count_)
                                : fmt::format("{} in face {} where a whole number should be (faces count from 0)",
                                              in_quotes(text_.peek()), f));
    }
    return value;
  }

  void face(std::size_t f) {
    text_.skip_space();
    const std::size_t start = text_.offset();
    const std::int64_t size = face_number(f);
    if (size < 0 || static_cast<std::uint64_t>(size) > text_.remaining()) {
      text_.fail(fmt::format("face {} claims {} corners, more than the file can hold (faces count from 0)", f, size),
                 start);
    }
    face_.clear();
    for (std::int64_t k = 0; k < size; ++k) {
      const std::int64_t v = face_number(f);
      if (v < 0 || static_cast<std::uint64_t>(v) >= vertex_count_) {
        text_.fail(fmt::format("face {} uses vertex {}, but the file has {} vertices (faces and vertices count from 0)",
                               f, v, vertex_count_),
                   start);
      }
      face_.push_back(static_cast<std::int32_t>(v));
    }
    if (one_line_each_) text_.next_line();
    if (!faces_.add(face_)) text_.fail("more face corners than 32-bit ids can count; split the mesh", start);
  }

  CoordinateTextFile& file_;
  TextScanner text_;
  FaceCollector faces_{file_.surface};
  std::vector<std::int32_t> face_;
  std::size_t vertex_count_ = 0, face_count_ = 0;
  std::size_t extra_numbers_ = 0;
  bool one_line_each_ = true;
};

}  // namespace

std::unique_ptr<MeshFile> parse_off(std::string bytes, const std::filesystem::path&) {
  auto file = std::make_unique<CoordinateTextFile>();
  file->bytes = std::move(bytes);
  OffParser(*file).parse();
  return file;
}

}  // namespace unsnarl
