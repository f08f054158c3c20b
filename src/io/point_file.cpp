#include "io/point_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/byte_order.h"
#include "io/text_scanner.h"

namespace unsnarl {
namespace {

bool is_nan(std::string_view token) {
  if (token.starts_with('-') || token.starts_with('+')) token.remove_prefix(1);
  const auto is_letter = [&](std::size_t i, char c) { return (token[i] | 0x20) == c; };
  return token.size() >= 3 && is_letter(0, 'n') && is_letter(1, 'a') && is_letter(2, 'n');
}

/// Names the place of this vertex in the file, for messages.
std::string place(const PointBlock& block, std::size_t vertex) {
  if (block.array.encoded) return block.array.where;
  const std::string in = block.array.external ? block.array.external->name.string() + ": " : "";
  return fmt::format("{}byte {}", in, block.array.start + vertex * block.vertex_step);
}

}  // namespace

void PointFile::mark_missing(std::size_t vertex) {
  if (missing_.size() <= vertex) missing_.resize(vertex + 1);
  missing_[vertex] = true;
}

void PointFile::add_points(NumberArray array, Layout layout, Missing missing, std::size_t* end) {
  array.check_size(bytes);
  PointBlock block;
  block.first_vertex = vertex_count();
  block.count = array.count / 3;
  if (!array.is_text) {
    block.vertex_step = layout.vertex * size_of(array.type);
    block.coordinate_step = layout.coordinate * size_of(array.type);
    block.array = std::move(array);
    return add_binary_points(std::move(block), missing);
  }
  TextScanner text(std::string_view(bytes).substr(0, array.text.begin + array.text.size), {});
  text.seek(array.text.begin);
  surface.positions.resize(surface.positions.size() + 3 * block.count);
  block.tokens.resize(3 * block.count);
  for (std::size_t i = 0; i < 3 * block.count; ++i) {
    const std::size_t k = layout.coordinate == 1 ? i % 3 : i / block.count;
    const std::size_t v = layout.coordinate == 1 ? i / 3 : i % block.count;
    if (!text.skip_space())
      text.fail(fmt::format("{} ends after {} of {} numbers; the file is cut short or damaged", array.where, i,
                            3 * block.count));
    block.tokens[3 * v + k].begin = text.offset();
    double& x = surface.positions[3 * (block.first_vertex + v) + k];
    if (missing == Missing::marked_by_nan && is_nan(text.peek())) {
      mark_missing(block.first_vertex + v);
      text.token();
    } else {
      x = array.type == NumberType::float32 ? text.coordinate<float>(block.first_vertex + v)
                                            : text.coordinate<double>(block.first_vertex + v);
    }
    block.tokens[3 * v + k].length = static_cast<std::uint32_t>(text.offset() - block.tokens[3 * v + k].begin);
  }
  if (end != nullptr) *end = text.offset();
  block.array = std::move(array);
  blocks_.push_back(std::move(block));
}

void PointFile::add_binary_points(PointBlock block, Missing missing) {
  block.first_vertex = vertex_count();
  surface.positions.reserve(surface.positions.size() + 3 * block.count);
  const char* data = block.array.data(bytes).data() + block.array.start;
  for (std::size_t v = 0; v < block.count; ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double x =
          load_number(data + v * block.vertex_step + k * block.coordinate_step, block.array.type, block.array.order) /
          block.divisor;
      if (std::isnan(x) && missing == Missing::marked_by_nan) {
        mark_missing(block.first_vertex + v);
      } else if (!std::isfinite(x)) {
        throw FileError(fmt::format("{}: vertex {} (counting from 0) is not finite; correct or remove it",
                                    place(block, v), block.first_vertex + v));
      }
      surface.positions.push_back(x);
    }
  }
  blocks_.push_back(std::move(block));
}

void PointFile::add_point(const std::array<double, 3>& position, const std::array<NumberToken, 3>& tokens) {
  if (blocks_.empty()) {
    blocks_.emplace_back();
    blocks_.back().array.type = NumberType::float64;
    blocks_.back().array.is_text = true;
  }
  surface.positions.insert(surface.positions.end(), position.begin(), position.end());
  blocks_.back().tokens.insert(blocks_.back().tokens.end(), tokens.begin(), tokens.end());
  ++blocks_.back().count;
}

std::string PointFile::add_face(std::span<const std::int64_t> face) {
  face_.clear();
  bool is_complete = true;
  for (const std::int64_t v : face) {
    if (v < 0 || static_cast<std::uint64_t>(v) >= vertex_count())
      return fmt::format("uses vertex {}, but the file has {} vertices (counting from 0)", v, vertex_count());
    is_complete &= !is_missing(static_cast<std::size_t>(v));
    face_.push_back(static_cast<std::int32_t>(v));
  }
  if (!is_complete) {
    ++faces_left_out_;
    return {};
  }
  return faces_.add(face_) ? "" : "is one of more faces than 32-bit ids can count; split the mesh";
}

std::string PointFile::add_strip(std::span<const std::int64_t> strip) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    const std::array<std::int64_t, 3> face = {strip[i + i % 2], strip[i + 1 - i % 2], strip[i + 2]};
    if (face[0] == face[1] || face[1] == face[2] || face[0] == face[2]) continue;
    std::string wrong = add_face(face);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

void PointFile::finish() {
  faces_.note_ignored(notes);
  if (vertex_count() > std::numeric_limits<std::int32_t>::max() / 3)
    throw FileError(fmt::format("{} vertices are more than 32-bit ids can count; split the mesh", vertex_count()));
  stores_float32 = !blocks_.empty() && std::all_of(blocks_.begin(), blocks_.end(), [](const PointBlock& block) {
    return block.array.type == NumberType::float32;
  });
  if (missing_.empty()) return;
  missing_.resize(vertex_count());
  place_missing(surface.positions);
  const auto count = static_cast<std::size_t>(std::count(missing_.begin(), missing_.end(), true));
  notes.push_back(fmt::format("{} missing {} (NaN) and the {} {} around stay as they are.", count,
                              count == 1 ? "vertex" : "vertices", faces_left_out_,
                              faces_left_out_ == 1 ? "face" : "faces"));
}

/// No face uses these vertices, so any finite position will do; that of another vertex keeps the bounding box.
void PointFile::place_missing(std::vector<double>& positions) const {
  if (missing_.empty()) return;
  const auto there = static_cast<std::size_t>(std::find(missing_.begin(), missing_.end(), false) - missing_.begin());
  for (std::size_t v = 0; v < missing_.size(); ++v) {
    if (!missing_[v]) continue;
    for (std::size_t k = 0; k < 3; ++k) positions[3 * v + k] = there < missing_.size() ? positions[3 * there + k] : 0;
  }
}

TextPrecision PointFile::precision(const NumberArray& array, bool float32_digits) {
  if (array.type == NumberType::float32) return TextPrecision::stored_float;
  // In binary a double holds the float itself; only digits need the detour through text.
  if (float32_digits) return array.is_text ? TextPrecision::float_digits : TextPrecision::stored_float;
  return TextPrecision::double_digits;
}

std::vector<double> PointFile::as_written(std::span<const double> positions, bool float32_digits) const {
  std::vector<double> result = surface.positions;
  for (const PointBlock& block : blocks_) {
    const TextPrecision digits = precision(block.array, float32_digits);
    for (std::size_t i = 3 * block.first_vertex; i < 3 * (block.first_vertex + block.count); ++i) {
      if (positions[i] == result[i] || is_missing(i / 3)) continue;
      if (is_integer(block.array.type)) {
        throw FileError(
            fmt::format("the positions are stored as integers and cannot hold the new position of vertex {} (counting "
                        "from 0); convert the file to one with floating-point positions",
                        i / 3));
      }
      const double written = value_as_written(positions[i], digits);
      if (written != result[i]) result[i] = written;
    }
  }
  place_missing(result);
  return result;
}

bool PointFile::has_moved(const PointBlock& block, std::span<const double> written) const {
  for (std::size_t i = 3 * block.first_vertex; i < 3 * (block.first_vertex + block.count); ++i)
    if (written[i] != surface.positions[i] && !is_missing(i / 3)) return true;
  return false;
}

void PointFile::patch_text(const PointBlock& block, std::span<const double> written, std::span<const double> positions,
                           bool float32_digits, std::vector<TextEdit>& edits) const {
  const TextPrecision digits = precision(block.array, float32_digits);
  for (std::size_t i = 0; i < 3 * block.count; ++i) {
    const std::size_t at = 3 * block.first_vertex + i;
    if (written[at] == surface.positions[at] || is_missing(at / 3)) continue;
    edits.push_back(
        {block.tokens[i].begin, block.tokens[i].begin + block.tokens[i].length, number_text(positions[at], digits)});
  }
}

void PointFile::patch_binary(const PointBlock& block, std::span<const double> written, char* data) const {
  for (std::size_t i = 0; i < 3 * block.count; ++i) {
    const std::size_t at = 3 * block.first_vertex + i;
    if (written[at] == surface.positions[at] || is_missing(at / 3)) continue;
    char* to = data + block.array.start + i / 3 * block.vertex_step + i % 3 * block.coordinate_step;
    if (block.array.type == NumberType::float32) {
      store(to, static_cast<float>(written[at]), block.array.order);
    } else {
      store(to, written[at], block.array.order);
    }
  }
}

std::vector<OutputFile> PointFile::patched(std::span<const double> positions, bool float32_digits) const {
  return patched_with({}, positions, float32_digits);
}

std::vector<OutputFile> PointFile::patched_with(std::vector<TextEdit> edits, std::span<const double> positions,
                                                bool float32_digits) const {
  const std::vector<double> written = as_written(positions, float32_digits);
  std::vector<OutputFile> files = {{{}, bytes}};
  for (const auto& file : external_files) files.push_back({file->name, file->bytes, file->stamp});
  for (const PointBlock& block : blocks_) {
    if (!has_moved(block, written)) continue;
    if (block.array.is_text) {
      patch_text(block, written, positions, float32_digits, edits);
    } else if (!block.array.encoded) {
      const auto file = std::find(external_files.begin(), external_files.end(), block.array.external);
      const std::size_t i = block.array.external ? 1 + static_cast<std::size_t>(file - external_files.begin()) : 0;
      patch_binary(block, written, files[i].bytes.data());
    } else {
      std::string changed = block.array.encoded->bytes;
      patch_binary(block, written, changed.data());
      block.array.encoded->replace(bytes, changed, edits);
    }
  }
  if (edits.empty()) return files;
  add_consequences(edits);
  files[0].bytes = with_edits(files[0].bytes, std::move(edits));
  return files;
}

}  // namespace unsnarl
