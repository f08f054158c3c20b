#include "unsnarl/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "io/content.h"
#include "io/foreign_formats.h"
#include "io/formats.h"
#include "io/mesh_file.h"
#include "unsnarl/paths.h"
#include "unsnarl/visible_text.h"

namespace unsnarl {
namespace {

/// Notes on images that are listed one by one; more are counted, since a file may name hundreds that are missing (unit:
/// notes)
constexpr std::size_t most_appearance_notes = 8;

/// Notes quote names of the file.
void make_visible(std::vector<std::string>& notes) {
  for (std::string& note : notes) note = visible_text(note);
}

void check_positions(const Surface& surface, std::span<const double> positions) {
  if (positions.size() != surface.positions.size()) {
    throw std::invalid_argument(
        fmt::format("{} coordinates given for a file with {}", positions.size(), surface.positions.size()));
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isfinite(positions[i])) {
      throw std::invalid_argument(fmt::format("vertex {} (counting from 0) is not finite", i / 3));
    }
  }
}

/// What is cut short after its points would pass for a surface without self-intersections.
void require_faces(const SurfaceView& surface) {
  if (surface.face_count() > 0) return;
  const std::size_t count = surface.vertex_count();
  throw FileError(
      fmt::format("the file has {} vert{} and no faces, so there is nothing to repair; it is cut short, or holds "
                  "points or lines only",
                  count, count == 1 ? "ex" : "ices"));
}

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (words.substr(0, end) == word) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

}  // namespace

std::filesystem::path with_infix(const std::filesystem::path& path, std::string_view infix) {
  return path.parent_path() / path_of(path.stem().string() + std::string(infix) + path.extension().string());
}

std::string_view to_string(Format format) {
  return formats[static_cast<std::size_t>(format)].name;
}

std::optional<Format> format_from_extension(std::string_view path) {
  std::string extension(path.substr(path.find_last_of("./\\") + 1));
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const FormatEntry& entry : formats) {
    if (extension == entry.name || has_word(entry.other_extensions, extension)) return entry.format;
  }
  return std::nullopt;
}

std::string format_names(std::string_view before_last) {
  std::string text;
  for (const FormatEntry& entry : formats) {
    if (!text.empty()) text += &entry == &formats.back() ? before_last : ", ";
    text += entry.name;
  }
  return text;
}

Document::Document(Format format, std::unique_ptr<MeshFile> file) : format_(format), file_(std::move(file)) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Document Document::read(const std::filesystem::path& path, std::optional<Format> format) {
  if (!format) format = format_from_extension(path.string());
  FileRead file = read_stamped_file(path, [&](std::string_view start) {
    try {
      if (!format) refuse_foreign_format(start, path.string());
      if (!format) format = format_of_content(start);
      if (!format)
        throw FileError(fmt::format("neither the extension nor the content tells the format; add --format: {}",
                                    format_names(" or ")));
      refuse_other_content(start, *format);
    } catch (const FileError& error) {
      throw FileError(fmt::format("{}: {}", path.string(), error.what()), error.error_number());
    }
  });
  try {
    Document document = parse(std::move(file.bytes), *format, path.parent_path());
    document.read_from_ = file.stamp;
    return document;
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: {}", path.string(), error.what()), error.error_number());
  }
}

Document Document::parse(std::string bytes, Format format, const std::filesystem::path& folder) {
  const auto entry = static_cast<std::size_t>(format);
  if (entry >= formats.size()) throw std::invalid_argument("unknown format");
  const std::string_view start = std::string_view(bytes).substr(0, checked_start);
  refuse_foreign_format(start, {});
  refuse_other_content(start, format);
  std::unique_ptr<MeshFile> file = formats[entry].parse(std::move(bytes), folder);
  make_visible(file->notes);
  require_faces(file->surface);
  return Document(format, std::move(file));
}

Format Document::format() const {
  return format_;
}
const Surface& Document::surface() const {
  return file_->surface;
}
const std::vector<FaceLabels>& Document::face_labels() const {
  return file_->labels;
}
const std::optional<std::array<double, 3>>& Document::up() const {
  return file_->up;
}
Appearance Document::appearance(std::size_t image_bytes) const {
  Appearance result = file_->appearance(image_bytes);
  if (result.notes.size() > most_appearance_notes) {
    const std::size_t more = result.notes.size() - most_appearance_notes;
    result.notes.resize(most_appearance_notes);
    result.notes.push_back(fmt::format("So it is with {} more.", more));
  }
  make_visible(result.notes);
  return result;
}
const std::vector<std::string>& Document::notes() const {
  return file_->notes;
}
bool Document::stores_float32() const {
  return file_->stores_float32;
}

bool Document::recompute_normals() {
  file_->recompute_normals = true;
  return file_->has_vertex_normals();
}

std::vector<OutputFile> Document::patched(std::span<const double> positions, bool float32_digits,
                                          const std::filesystem::path& main_name, const std::string& infix) const {
  check_positions(file_->surface, positions);
  assert(infix.empty() || !main_name.empty());
  if (main_name.empty()) {
    std::vector<OutputFile> files = file_->patched(positions, float32_digits);
    files[0].replaces = read_from_;
    return files;
  }
  std::vector<OutputFile> files =
      file_->patched_as(with_infix(main_name.filename(), infix).string(), infix, positions, float32_digits);
  for (OutputFile& file : files) file.replaces.reset();
  return files;
}

std::vector<double> Document::as_written(std::span<const double> positions, bool float32_digits) const {
  check_positions(file_->surface, positions);
  return file_->as_written(positions, float32_digits);
}

}  // namespace unsnarl
