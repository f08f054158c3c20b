#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/nesting.h"
#include "unsnarl/repair.h"
#include "unsnarl/report_json.h"
#include "unsnarl/scene_document.h"

namespace unsnarl {

/// From mesh files to certified mesh files.
///
/// The input is read and repaired; the result is written to a temporary folder beside its place, read back, and
/// certified as it was read back; then it is put in place. Status::embedded is therefore about the file that is there.
/// Until the last step, and whatever fails, every old file is as it was. Of several files all are new or all are old.
struct RepairFileOptions {
  /// How the mesh is repaired, limits among it. RepairOptions::as_written is set to what the files can hold, and
  /// `precision` to float32 where one of them stores such numbers.
  RepairOptions repair;
  Nesting nesting;  ///< which surfaces are to lie inside which, see repair_nested(); no chains: it does not matter
  /// Completes these options once the files are read, where they depend on them: vertices of named parts that must not
  /// move, a nesting. Unset: nothing depends on them.
  std::function<void(const SceneDocument& scene, RepairFileOptions& options)> when_read;
  std::optional<Format> format;    ///< of the input; unset: by extension or content
  bool in_place = false;           ///< one file alone: overwrite the input, and give no output
  bool keep_partial = false;       ///< write an unfinished result (reduced, a limit, ...) to its place
  bool no_partial = false;         ///< do not keep an unfinished result in OUT.partial.EXT beside its place
  bool recompute_normals = false;  ///< Document::recompute_normals
};

/// The result of a repair of files.
struct RepairedFiles {
  RepairResult result;  ///< of repair(); outcome() says what becomes of its status where surfaces are nested
  /// The files that were written, one for each input: at their places, or beside them (OUT.partial.EXT), where the
  /// result is unfinished. Both empty: none was written.
  std::vector<std::filesystem::path> written, partial;
  std::string
      bytes;  ///< the file, certified, where it has no place (FilesToRepair::targets in repair_file_steps.h is empty)
  std::vector<double> positions;  ///< 3 n doubles, as read back; where nothing was written, those of `result`
  ReportFiles report;             ///< paths, notes, seconds, pairs by file: what report_json() takes

  bool is_written() const { return !written.empty() || !bytes.empty(); }
};

/// Repairs a mesh file. `out` is given the format of `in`; empty with RepairFileOptions::in_place.
///
/// An embedded result is written (also where a gap is not met), an allowed one, and one that is obstructed, where it is
/// not the input. Any other goes to OUT.partial.EXT where it is better than the input, and `out` is not touched (see
/// keep_partial, no_partial).
///
/// Throws before the work: std::invalid_argument for options and places that make no sense (another format, an output
/// that would overwrite an input), FileError for an input that cannot be read, WriteError for a place that cannot be
/// written to; LimitReached as repair() does. After it: WriteError, and where somebody has changed the file to be
/// overwritten meanwhile, it stays, and the result is kept beside it, as the message says. SystemError at any time.
RepairedFiles repair_file(const std::filesystem::path& in, const std::filesystem::path& out,
                          const RepairFileOptions& options = {}, Context* context = nullptr);

/// Repairs several files as one scene: their meshes are also separated from each other. They go to `folder` under
/// their names, which must differ; it is made where it is missing. As repair_file(); all are written or none.
RepairedFiles repair_files(const std::vector<std::filesystem::path>& in, const std::filesystem::path& folder,
                           const RepairFileOptions& options = {}, Context* context = nullptr);

}  // namespace unsnarl
