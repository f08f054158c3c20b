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
#include "unsnarl/staged_files.h"

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

/// What came of files.
struct RepairedFiles {
  RepairResult result;  ///< of repair(); outcome() says what becomes of its status where surfaces are nested
  /// The files that were written, one for each input: at their places, or beside them (OUT.partial.EXT), where the
  /// result is unfinished. Both empty: none was written.
  std::vector<std::filesystem::path> written, partial;
  std::string bytes;              ///< the file, certified, where it has no place (FilesToRepair::targets is empty)
  std::vector<double> positions;  ///< 3 n doubles, as read back; where nothing was written, those of `result`
  ReportFiles report;             ///< paths, notes, seconds, pairs by file: what report_json() takes

  bool is_written() const { return !written.empty() || !bytes.empty(); }
};

/// Repairs a mesh file. `out` is given the format of `in`; empty with RepairFileOptions::in_place.
///
/// An embedded result is written, and one that is obstructed, where it is not the input. Any other goes to
/// OUT.partial.EXT where it is better than the input, and `out` is not touched (see keep_partial, no_partial).
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

// The steps of these two, for programs that add files to those of the result or do something in between.

/// Mesh files of one scene, and where their results go.
struct FilesToRepair {
  std::vector<std::filesystem::path> inputs;
  std::shared_ptr<SceneDocument> scene;        ///< never null
  std::filesystem::path output;                ///< of several files their folder
  std::vector<std::filesystem::path> targets;  ///< one for each input; empty: the result of one file is handed back
  bool in_place = false;
  std::string partial_infix;       ///< of files beside the targets, set by check_places(); empty: none are kept
  std::vector<std::string> notes;  ///< worth telling the user; goes to reports

  bool is_scene() const { return inputs.size() > 1; }
  /// Place of the main file of result `file` when all is done: links of a single one are followed.
  std::filesystem::path main_place(std::size_t file) const;
  /// Names of the files beside it, relative to its folder. See external_files().
  std::vector<std::filesystem::path> names_beside(std::size_t file) const;
};

/// Reads mesh files as one scene. Throws std::invalid_argument where two have one name, FileError, SystemError.
SceneDocument read_scene(const std::vector<std::filesystem::path>& paths, std::optional<Format> format = {});

/// Decides where results go. `output`: the file, of several the folder; empty: nowhere, the result is handed back.
/// Throws std::invalid_argument for one that is missing, or given with RepairFileOptions::in_place.
FilesToRepair files_to_repair(std::shared_ptr<SceneDocument> scene, std::vector<std::filesystem::path> inputs,
                              std::filesystem::path output, const RepairFileOptions& options);

/// Repairs files that have been read. RepairFileOptions::when_read, recompute_normals, format and in_place have had
/// their effect and are not used.
RepairedFiles repair_files(FilesToRepair files, RepairFileOptions options, Context* context = nullptr);

/// Makes sure that the result can be at its place: the format is that of the input, and nothing that was read and no
/// file of another kind would be overwritten. Chooses FilesToRepair::partial_infix so that partial results replace no
/// file that was read.
/// is_taken: places that something else has, which no partial result gets. Throws std::invalid_argument.
void check_places(FilesToRepair& files, bool no_partial = false,
                  const std::function<bool(const std::filesystem::path&)>& is_taken = {});

/// Throws WriteError where files cannot be made at the places of the result.
void require_writable(const FilesToRepair& files);

/// Sets what a repair for these files depends on, see RepairFileOptions::repair. `scene` must outlive the options.
/// Throws std::invalid_argument where float64 is asked for and a file stores 32-bit numbers.
void fit_to_files(const SceneDocument& scene, RepairOptions& options);

/// Writes the result of a repair beside its places, or those of a partial result, or not at all, as its status asks;
/// reads it back and certifies it. put_in_place() is to follow. Throws WriteError; std::logic_error where the files do
/// not hold what the status promises.
RepairedFiles stage_result(const FilesToRepair& files, RepairResult result, const RepairFileOptions& options,
                           StagedFiles& staged);

/// The same whatever the status, to the targets with this infix (see with_infix; empty: the targets themselves).
/// Returns the positions read back. Throws likewise.
std::vector<double> stage_result_as(const std::string& infix, const FilesToRepair& files, const RepairResult& result,
                                    const RepairFileOptions& options, StagedFiles& staged);

/// Writes one document with other positions beside `target`, and returns what is read back. The caller compares.
/// Throws WriteError, and FileError where that cannot be read.
Document stage_document(const Document& document, std::span<const double> positions, bool float32_digits,
                        const std::filesystem::path& target, StagedFiles& staged);

/// StagedFiles::commit; where a file to be overwritten has changed since it was read, all stay as they are, the result
/// is written as a partial one, and the WriteError says so.
void put_in_place(const FilesToRepair& files, const RepairResult& result, const RepairFileOptions& options,
                  StagedFiles& staged);

/// Sets clearance_before and clearance_after of RepairedFiles::report: those of the input and of what was read back.
/// Takes about as long as searches for intersections.
void measure_clearances(const FilesToRepair& files, const RepairOptions& options, RepairedFiles& done);

}  // namespace unsnarl
