#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/appearance.h"
#include "unsnarl/errors.h"
#include "unsnarl/file_stamp.h"
#include "unsnarl/surface.h"

namespace unsnarl {

enum class Format : std::uint8_t { obj, off, ply, stl, glb, gltf, surf, gii, vtk, vtp, msh, inp, threemf };
std::string_view to_string(Format format);
/// By the extension of a path ("a/b.OBJ", "lh.pial"), or by the bare name of a format ("obj"). Case does not matter.
std::optional<Format> format_from_extension(std::string_view path);
/// The names of all formats: "obj, off, ply, stl, ...". before_last stands between the last two.
std::string format_names(std::string_view before_last = ", ");

/// Names that a file gives to its faces, of one kind.
struct FaceLabels {
  /// OBJ: "object", "group", "material"; STL, 3MF: "object"; glTF: "node", "mesh", "material"; Gmsh: "group"
  /// (physical), "object" (entity); Abaqus: "group" (ELSET), "object" (part)
  std::string kind;
  std::vector<std::string> names;     ///< each name once, in the order of the file
  std::vector<std::int32_t> of_face;  ///< one entry a face: index into names, or -1
};

/// One file to write. An empty name stands for the main file; other names are relative to its folder.
struct OutputFile {
  std::filesystem::path name;
  std::string bytes;
  /// The file that this one replaces, as it was when it was read; empty: it replaces none that was read.
  std::optional<FileStamp> replaces = {};
};

/// "a/out.obj" with the infix ".partial" is "a/out.partial.obj".
std::filesystem::path with_infix(const std::filesystem::path& path, std::string_view infix);

/// The infix of files that hold what an unfinished repair has reached.
inline constexpr const char* partial_infix = ".partial";

/// A mesh file with its bytes: positions out, positions patched back in, every other token as it was.
///
/// A coordinate that did not change keeps its token; without any motion the file comes back byte for byte. What
/// follows from the positions is updated for the parts that moved: STL facet normals (unless stored as 0 0 0), glTF
/// accessor bounds, GLB chunk lengths. Compressed numbers are compressed anew where one of them changed.
class Document {
 public:
  /// Format by extension unless given; FreeSurfer surfaces without a known one are recognised by their first bytes.
  /// Throws FileError, also where there is no face: what is cut short after its points would pass for repaired; and
  /// SystemError.
  static Document read(const std::filesystem::path& path, std::optional<Format> format = {});
  /// `folder` is where the external buffers of a glTF and the external files of a GIFTI lie. Throws FileError,
  /// SystemError.
  static Document parse(std::string bytes, Format format, const std::filesystem::path& folder = {});

  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  Format format() const;
  /// Positions as a reader sees them, all finite; faces of any size >= 3, all corners in range. glTF: world space of
  /// the default scene. STL: three vertices a facet. Faces with fewer than 3 corners stay in the file but are left out
  /// here (noted). FreeSurfer, GIFTI: vertices that are missing (NaN) stay so; here they have the position of another
  /// vertex, and the faces that use them are left out (noted).
  const Surface& surface() const;
  const std::vector<FaceLabels>& face_labels() const;
  /// The axis of the positions that points up, of length 1, where the format says so: y in glTF (of a skinned mesh the
  /// axis that its joints turn there), z in 3MF.
  const std::optional<std::array<double, 3>>& up() const;
  /// How its faces look, with the images that it holds or that lie in its folder: glTF, and OBJ with its MTL files; of
  /// other formats nothing. Read anew at each call; never fails: what cannot be shown is in its notes.
  /// image_bytes: the most that all images together may have; what would be more is left out.
  Appearance appearance(std::size_t image_bytes = most_image_bytes) const;
  /// Things worth telling the user, one sentence each.
  const std::vector<std::string>& notes() const;
  /// The file holds 32-bit floats (STL, glTF, FreeSurfer; PLY and others with float positions), so `float32_digits`
  /// makes no difference.
  bool stores_float32() const;

  /// From now on patched() also turns the stored vertex normals of what moved (OBJ vn, PLY nx ny nz, glTF NORMAL) as
  /// the faces around them turn, and rounds them to float32. False: this format, or this file, stores none that could
  /// be updated.
  bool recompute_normals();

  /// The files to write, the main file first; then the external buffers of a glTF, the external files of a GIFTI.
  /// positions: as many as in surface(), finite. float32_digits: in text, moved coordinates are rounded to float32 and
  /// written with the fewest digits that give that float back; otherwise with the fewest that give the double back.
  /// main_name: what the main file will be called, unless it replaces the one read. The external files of a GIFTI are
  /// then called after it (lh.gii.data, lh.gii.2.data), so that those read can stay beside it; where it is empty, and
  /// in a glTF, they keep their names.
  /// infix: all names get it, see with_infix(), so that a file called main_name and those beside it stay. \pre a
  /// main_name Throws FileError where the format cannot hold the change (integer positions), WriteError for coordinates
  /// beyond float32, std::invalid_argument for a wrong count or a coordinate that is not finite.
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits,
                                  const std::filesystem::path& main_name = {}, const std::string& infix = {}) const;
  /// The positions that reading patched(...) back gives, bit for bit.
  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const;

 private:
  explicit Document(Format format, std::unique_ptr<class MeshFile> file);
  Format format_;
  std::unique_ptr<class MeshFile> file_;
  std::optional<FileStamp> read_from_;  // empty: it was parsed from bytes
};

/// Names of the files beside a glTF or a GIFTI in which its numbers are, relative to its folder. With `main_name`,
/// those of a result of this name, with this infix, see Document::patched.
std::vector<std::filesystem::path> external_files(const Document& document, const std::filesystem::path& main_name = {},
                                                  const std::string& infix = {});
/// The same of what is at `path`; empty where that is no mesh.
std::vector<std::filesystem::path> external_files(const std::filesystem::path& path, Format format);

/// Writes to a temporary file in the folder of `path`, flushes it to the disk, renames it: either the old file or the
/// whole new one is there, never a part. Keeps the permissions of an existing target and respects its write protection;
/// follows a symbolic link; writes straight into devices and pipes. Throws WriteError, SystemError, and then
/// leaves no temporary file behind.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace unsnarl
