#include "io/content.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <utility>

#include "io/mesh_file.h"
#include "io/surf.h"

namespace unsnarl {
namespace {

constexpr auto first_bytes = std::to_array<std::pair<std::string_view, Format>>({
    {"ply\n", Format::ply},
    {"ply\r", Format::ply},
    {"glTF", Format::glb},
    {"OFF\n", Format::off},
    {"OFF\r", Format::off},
    {"COFF\n", Format::off},
    {"NOFF\n", Format::off},
    {"# vtk DataFile Version", Format::vtk},
    {"$MeshFormat", Format::msh},
    {"*HEADING", Format::inp},
    {"*Heading", Format::inp},
    {"PK\x03\x04", Format::threemf},
});

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  return text;
}

}  // namespace

std::optional<Format> format_of_content(std::string_view start) {
  for (const auto& [bytes, format] : first_bytes)
    if (start.starts_with(bytes)) return format;
  if (is_freesurfer_surface(start)) return Format::surf;
  const std::string_view text = without_blanks(start);
  const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
  if (text.starts_with('<') && has("<VTKFile")) return Format::vtp;
  if (text.starts_with('<') && has("<GIFTI")) return Format::gii;
  if (text.starts_with('{') && has("\"asset\"")) return Format::gltf;
  // Binary STL may begin with the word too, as may comments of other formats.
  if (start.starts_with("solid ") && has("facet normal")) return Format::stl;
  return {};
}

void refuse_other_content(std::string_view start, Format format) {
  if (start.size() >= checked_start && start.find_first_not_of('\0') == std::string_view::npos)
    throw FileError(
        fmt::format("the first {} bytes are zero; the file was never written, or is damaged", start.size()));
  const std::optional<Format> content = format_of_content(start);
  if (!content || *content == format) return;
  const std::string_view name = to_string(*content);
  throw FileError(fmt::format("by its content this is {}, not {}; name it *.{}, or give --format {}", name,
                              to_string(format), name, name));
}

}  // namespace unsnarl
