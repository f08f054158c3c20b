#include <system_error>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

namespace fs = std::filesystem;

/// Formats whose files may name others that hold numbers.
bool may_have_external_files(Format format) {
  return format == Format::gltf || format == Format::glb || format == Format::gii;
}

}  // namespace

std::vector<fs::path> external_files(const Document& document, const fs::path& main_name, const std::string& infix) {
  std::vector<fs::path> names;
  if (!may_have_external_files(document.format())) return names;
  const std::vector<OutputFile> files = document.patched(document.surface().positions, true, main_name, infix);
  for (std::size_t i = 1; i < files.size(); ++i) names.push_back(files[i].name);
  return names;
}

std::vector<fs::path> external_files(const fs::path& path, Format format) {
  std::error_code ignored;
  if (!may_have_external_files(format) || !fs::is_regular_file(path, ignored)) return {};
  try {
    return external_files(Document::read(path, format));
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace unsnarl
