#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/document.h"
#include "unsnarl/repair_file.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/staged_files.h"

// The steps of repair_file() and repair_files(), for programs that add files to those of the result or do something in
// between.

namespace unsnarl {

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
