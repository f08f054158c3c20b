#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/document.h"

namespace unsnarl {

/// One parsed file of one format. What Document promises, each format keeps here; the arguments are checked already.
class MeshFile {
 public:
  MeshFile() = default;
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;
  virtual ~MeshFile() = default;

  virtual std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const = 0;
  virtual std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const = 0;
  /// patched() for a main file that is to have this name: the files beside it are named after it where the format says
  /// in the main file what they are called and other files may refer to the old ones. Else their names get the infix.
  virtual std::vector<OutputFile> patched_as(const std::string& main_name, const std::string& infix,
                                             std::span<const double> positions, bool float32_digits) const {
    static_cast<void>(main_name);
    static_cast<void>(infix);
    return patched(positions, float32_digits);
  }

  /// Does the file store vertex normals that patched() can update?
  virtual bool has_vertex_normals() const { return false; }

  /// Document::appearance.
  virtual Appearance appearance(std::size_t) const { return {}; }

  std::string bytes;  ///< the main file as it was read
  Surface surface;
  std::vector<FaceLabels> labels;
  std::vector<std::string> notes;
  std::optional<std::array<double, 3>> up;  ///< Document::up
  bool stores_float32 = false;
  bool recompute_normals = false;  ///< patched() updates stored vertex normals too
};

/// The first bytes of a file, by which its format is told, are at least this many, or all (unit: bytes)
inline constexpr std::size_t checked_start = 4096;
struct FileRead {
  std::string bytes;
  FileStamp stamp;  ///< as the file was before its first byte was read
};
FileRead read_stamped_file(const std::filesystem::path& path,
                           const std::function<void(std::string_view start)>& check_start = {});
std::string read_file(const std::filesystem::path& path);

/// Is this, as a mesh file may refer to it, a name of a file in or below its own folder? Only these are read and, at
/// the output, written.
bool is_inside_folder(const std::filesystem::path& name);

}  // namespace unsnarl
