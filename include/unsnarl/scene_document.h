#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// Which vertices and faces of a scene are those of one of its files.
struct SceneFile {
  std::string name;
  std::size_t first_vertex = 0, vertices = 0;
  std::size_t first_face = 0, faces = 0;
  std::optional<std::array<double, 3>> up = {};  ///< Document::up
};

/// Mesh files in one coordinate system, seen as one surface: vertices and faces file after file, in the order given.
/// Whatever holds of a surface holds of it; seams between files are welded like any other (Weld).
class SceneDocument {
 public:
  /// One name a document. Throws std::invalid_argument for none, or where their numbers differ, FileError for more
  /// vertices, faces or corners than can be counted.
  SceneDocument(std::vector<Document> documents, std::vector<std::string> names);

  const std::vector<SceneFile>& files() const { return files_; }
  const Document& document(std::size_t file) const { return documents_[file]; }
  const Surface& surface() const { return documents_.size() == 1 ? documents_[0].surface() : surface_; }
  /// Those of all files, those of one kind together; of several files also kind "file", with their names.
  const std::vector<FaceLabels>& face_labels() const {
    return documents_.size() == 1 ? documents_[0].face_labels() : labels_;
  }
  /// Document::appearance of all files, of several with their names in front of notes; image_bytes is shared by them.
  Appearance appearance(std::size_t image_bytes = most_image_bytes) const;
  /// Those of all files; of several with their names in front, and one where extents differ so much that their units
  /// may; and one where 32-bit numbers are too coarse for where it lies.
  const std::vector<std::string>& notes() const { return notes_; }
  /// The first file that stores 32-bit floats, where one does: then the whole scene has to hold in them.
  std::optional<std::size_t> float32_file() const;
  /// Document::recompute_normals of all. False: of none of them.
  bool recompute_normals();

  /// The part of `positions` (of the whole scene) that belongs to a file.
  std::span<const double> positions_of(std::size_t file, std::span<const double> positions) const;
  /// The files to write for one of the files of the scene, see Document::patched. `positions`: of the whole scene.
  std::vector<OutputFile> patched(std::size_t file, std::span<const double> positions, bool float32_digits,
                                  const std::filesystem::path& main_name = {}, const std::string& infix = {}) const;
  /// The positions that reading all of them back gives, bit for bit.
  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const;

 private:
  void join();

  std::vector<Document> documents_;
  std::vector<SceneFile> files_;
  Surface surface_;                 // of several files
  std::vector<FaceLabels> labels_;  // of several files
  std::vector<std::string> notes_;
};

/// The file of each face.
std::vector<std::int32_t> file_of_faces(std::span<const SceneFile> files);

/// Pairs of faces of two files, a < b, or within one, a == b.
struct ScenePairs {
  std::size_t a = 0, b = 0;
  PairCounts before, after;
  PairCounts allowed_before, allowed_after;  ///< see RepairReport
};

/// How a file of a scene came off. Lengths are relative to the diagonal of the whole scene.
struct SceneFileReport {
  SceneFile file;
  std::string input, output, format;  ///< as in ReportFiles; empty unless the caller says so
  double displacement_mean_rel = 0, displacement_max_rel = 0;
  double untouched_share = 1;  ///< share of its vertices that are bit-identical to the input
};

/// What a report says by file.
struct SceneReport {
  std::vector<SceneFileReport> files;
  std::vector<ScenePairs> pairs;  ///< those within each file, in their order; then those between any two, if any
};

/// Counts pairs by file and, where `after` is given (3 n doubles), measures how far each file moved.
/// `pairs_before`, `pairs_after`: of the faces of the scene.
SceneReport scene_report(const SurfaceView& before, std::span<const SceneFile> files,
                         std::span<const IntersectingPair> pairs_before, std::span<const double> after = {},
                         std::span<const IntersectingPair> pairs_after = {});

/// Counts pairs that are allowed by file, beside those that the report counts. `after`: empty: it was nothing repaired.
void count_allowed_pairs(std::span<const IntersectingPair> before, std::span<const IntersectingPair> after,
                         SceneReport& report);

}  // namespace unsnarl
