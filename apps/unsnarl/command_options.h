#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

// Checks of the values of options. They add nothing to the help. The fault that one finds follows the name of the
// option in a message: "must be 'all' or 'disjoint', not 'al'", "is in seconds, as in 3600; '1h' is not a number".

CLI::Validator one_of(std::vector<std::string> words);

/// Words that say what the number of an option means; a message puts them after the option's name.
struct Unit {
  const char* words;
};
namespace unit {
inline constexpr Unit seconds = {"is in seconds, as in 3600"};
inline constexpr Unit megabytes = {"is in MB, as in 4000"};
inline constexpr Unit degrees = {"is in degrees, as in 0.1"};
inline constexpr Unit units_of_file = {"is a length in the units of the file, as in 0.001"};
inline constexpr Unit share_of_diagonal = {"is a fraction of the bounding-box diagonal, as in 0.01"};
inline constexpr Unit share_or_length = {
    "is a number: a fraction of the bounding-box diagonal, as in 0.01, or, with --absolute, a length in the units of "
    "the file"};
inline constexpr Unit none = {"is a number, as in 0.5"};
}  // namespace unit

CLI::Validator number_within(double least, double most, Unit unit);
CLI::Validator number_below(double least, double bound, Unit unit);  ///< the bound itself is not allowed
CLI::Validator not_negative(Unit unit);
CLI::Validator whole_number_within(std::int64_t least, std::int64_t most);
/// The name of a file to be written has to end in one of these ("png"), unless it is a stream or device; what is
/// written there has no other format. Folders are allowed where `folders` says so. `advice`: what else to do.
CLI::Validator file_named(std::vector<std::string> extensions, bool folders = false, const std::string& advice = "");

/// Headings of the help that several commands have.
inline constexpr const char* usual_options = "Options";
inline constexpr const char* options_of_reading = "How the mesh is read";
inline constexpr const char* outputs_to_look_at = "Reports and pictures";
inline constexpr const char* research_options = "For research";

/// The list of exit codes in the help of a command: those that mean the same for all commands, and its own.
std::string exit_codes(std::map<int, std::string> own);

/// Options that commands share word for word. group: the heading that they stand under in the help.
void add_time_limit(CLI::App& command, double& limit, const std::string& group = usual_options);
void add_memory_limit(CLI::App& command, double& limit, const std::string& group = usual_options);
void add_progress(CLI::App& command, std::string& progress, const std::string& group = usual_options);
void add_quiet(CLI::App& command, bool& quiet, const std::string& group = usual_options);

/// Options that `fix`, `check` and `view` share.
struct MeshOptions {
  std::vector<std::string> inputs;  ///< one, or the files of a scene
  std::string format;
  std::string goal = "all", weld = "seams";
  double weld_tolerance = 0;
  bool both_diagonals = false;
  std::vector<std::string> allow;  ///< rules, see allowed_pairs()
  int threads = 0;
  bool quiet = false;

  bool is_scene() const { return inputs.size() > 1; }
  /// Refuses options that do nothing beside the others, as they do after parsing. Throws UsageError.
  void require_effect() const;
  /// All but what `allow` says.
  FindOptions find() const;
  /// With that too. Throws UsageError.
  FindOptions find_in(const SceneDocument& scene) const;
  Goal goal_wanted() const { return goal == "disjoint" ? Goal::disjoint : Goal::all; }
};
/// `input`: what the help says of IN, before the formats.
void add_inputs(CLI::App& command, MeshOptions& options,
                const std::string& input = "Mesh file, or several files that form one scene");
/// Pairs that may pass through each other.
void add_allow(CLI::App& command, std::vector<std::string>& allow, const std::string& group);
/// All but the inputs.
void add_mesh_options(CLI::App& command, MeshOptions& options);

}  // namespace unsnarl::app
