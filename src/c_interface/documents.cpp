#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

#include "arguments.h"
#include "results.h"
#include "unsnarl/staged_files.h"

namespace unsnarl::c_interface {
namespace {

namespace fs = std::filesystem;

std::optional<Format> format_of(const char* name) {
  if (name == nullptr) return std::nullopt;
  const std::optional<Format> format = format_from_extension(name);
  if (!format) throw std::invalid_argument("format is '" + std::string(name) + "'; choose one of " + format_names());
  return format;
}

std::unique_ptr<unsnarl_document> read(const fs::path& path, std::optional<Format> format) {
  Document document = Document::read(path, format);
  const SurfaceView surface = document.surface();
  const Json json = {{"format", to_string(document.format())},
                     {"vertices", surface.vertex_count()},
                     {"faces", surface.face_count()},
                     {"notes", document.notes()}};
  // Notes quote the file, whose bytes need not be UTF-8.
  std::string report = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return std::unique_ptr<unsnarl_document>(new unsnarl_document{path, std::move(document), std::move(report)});
}

/// The name that Document::patched() derives those of the files beside the main one from; empty where the input is
/// overwritten.
fs::path main_name(const unsnarl_document& input, const fs::path& target) {
  std::error_code ignored;
  return fs::equivalent(target, input.path, ignored) ? fs::path() : target.filename();
}

void require_target(const unsnarl_document& input, const fs::path& target) {
  const Document& document = input.document;
  if (const auto format = format_from_extension(target.string()); format && *format != document.format())
    throw std::invalid_argument(target.string() + ": the result keeps the format of the input, " +
                                std::string(to_string(document.format())));
  const StagedFiles can_be_replaced(target);
  const fs::path name = main_name(input, target);
  if (name.empty()) return;
  const std::span<const double> positions = document.surface().positions;
  const std::vector<OutputFile> files = document.patched(positions, true, name);
  if (files.size() == 1) return;
  for (const OutputFile& read : document.patched(positions, true))
    for (const OutputFile& file : files) {
      const fs::path place = file.name.empty() ? target : target.parent_path() / file.name;
      std::error_code ignored;
      if (!read.name.empty() && fs::equivalent(place, input.path.parent_path() / read.name, ignored))
        throw std::invalid_argument(place.string() +
                                    " holds part of the input and would be overwritten; write to another folder");
    }
}

void write(const unsnarl_document& input, std::span<const double> positions, bool float32, const fs::path& target) {
  require_target(input, target);
  const Document& document = input.document;
  StagedFiles staged(target);
  staged.write(document.patched(positions, float32, main_name(input, target)));
  if (Document::read(staged.main_file(), document.format()).surface().positions !=
      document.as_written(positions, float32))
    throw std::logic_error(target.string() + " would not give back the positions that were to be written to it");
  staged.commit();
}

}  // namespace
}  // namespace unsnarl::c_interface

using namespace unsnarl;
using namespace unsnarl::c_interface;

int unsnarl_document_read(const char* path, const char* format, unsnarl_document** document) {
  return guarded([&] {
    require(path, "path");
    require(document, "document");
    *document = read(path, format_of(format)).release();
  });
}

int unsnarl_document_surface(const unsnarl_document* document, unsnarl_surface* surface) {
  return guarded([&] {
    require(document, "document");
    require(surface, "surface");
    check_size(surface->size, sizeof(unsnarl_surface), "surface");
    const Surface& stored = document->document.surface();
    unsnarl_surface all = {};
    all.size = surface->size;
    all.positions = stored.positions.data();
    all.vertex_count = stored.positions.size() / 3;
    all.corners = stored.corners.data();
    all.corner_count = stored.corners.size();
    if (!stored.offsets.empty()) {
      all.offsets = stored.offsets.data();
      all.offset_count = stored.offsets.size();
    }
    all.document = document;
    std::memcpy(surface, &all, surface->size);
  });
}

const char* unsnarl_document_report(const unsnarl_document* document) {
  return document->report.c_str();
}

int unsnarl_document_check_output(const unsnarl_document* document, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(path, "path");
    require_target(*document, path);
  });
}

int unsnarl_document_write(const unsnarl_document* document, const unsnarl_result* repaired, const char* path) {
  return guarded([&] {
    require(document, "document");
    require(repaired, "repaired");
    require(path, "path");
    if (!repaired->precision) throw std::invalid_argument("repaired is no result of unsnarl_repair");
    const auto& positions = std::get<std::vector<double>>(repaired->arrays.at("positions").values);
    if (positions.size() != document->document.surface().positions.size())
      throw std::invalid_argument("repaired is of another mesh: " + std::to_string(positions.size() / 3) +
                                  " vertices, where the file has " +
                                  std::to_string(document->document.surface().view().vertex_count()));
    write(*document, positions, *repaired->precision == Precision::float32, path);
  });
}

void unsnarl_document_free(unsnarl_document* document) {
  delete document;
}
