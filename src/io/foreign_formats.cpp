#include "io/foreign_formats.h"

#include <fmt/format.h>

#include <array>

#include "unsnarl/document.h"

namespace unsnarl {
namespace {

struct ForeignFormat {
  std::string_view name;
  std::array<std::string_view, 4> extensions;
  std::array<std::string_view, 3> first_bytes;
  std::string_view conversion;
};
constexpr auto foreign_formats = std::to_array<ForeignFormat>({
    {"FBX",
     {".fbx"},
     {"Kaydara FBX Binary", "; FBX "},
     "import it into Blender and export it as glTF or OBJ (File > Export)"},
    {"USD",
     {".usd", ".usda", ".usdc", ".usdz"},
     {"PXR-USDC", "#usda "},
     "import it into Blender and export it as glTF or OBJ (File > Export)"},
    {"Blend", {".blend"}, {"BLENDER"}, "open it in Blender and export it as glTF or OBJ (File > Export)"},
});

bool has_extension(std::string_view path, std::string_view extension) {
  if (extension.empty() || path.size() < extension.size()) return false;
  path.remove_prefix(path.size() - extension.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const char c = path[i] >= 'A' && path[i] <= 'Z' ? static_cast<char>(path[i] - 'A' + 'a') : path[i];
    if (c != extension[i]) return false;
  }
  return true;
}

}  // namespace

void refuse_foreign_format(std::string_view bytes, const std::string& path) {
  for (const ForeignFormat& format : foreign_formats) {
    bool is_it = false;
    for (const std::string_view extension : format.extensions) is_it |= has_extension(path, extension);
    for (const std::string_view start : format.first_bytes) is_it |= !start.empty() && bytes.starts_with(start);
    if (is_it) throw FileError(fmt::format("{} files are not read; {}", format.name, format.conversion));
  }
}

}  // namespace unsnarl
