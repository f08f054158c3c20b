#pragma once

#include <string>
#include <vector>

#include "command_options.h"
#include "interruption.h"
#include "unsnarl/nesting.h"
#include "unsnarl/paper.h"
#include "unsnarl/parts.h"
#include "unsnarl/scene_document.h"

namespace unsnarl::app {

struct FixOptions : MeshOptions {
  std::string output;
  bool in_place = false;
  bool keep_partial = false;  ///< what is unfinished goes to the output itself
  bool no_partial = false;    ///< and not beside it
  std::string precision = "auto";
  double time_limit_s = 0, memory_limit_mb = 0;
  double min_dihedral_deg = 0;
  double max_displacement = 0, min_gap = 0;  ///< fractions of the diagonal, or lengths if `absolute`
  bool gap_near_conflicts = false;           ///< min_gap is asked for only there
  bool absolute = false;
  std::string fix_vertices;
  bool fix_boundary = false;
  std::vector<std::string> nested;  ///< names from the innermost out, with commas between them
  bool each = false, together = false;
  Parts fix, only;  ///< held still; worked on, all else held still (empty: everything is worked on)
  Parts rigid;      ///< each moves as one body
  bool recompute_normals = false;
  bool paper = false, no_recover = false;
  PaperOptions paper_options;
  bool sequence = false;  ///< the inputs are frames
  std::string frames;     ///< of a sequence: "first:last"
  std::string report, highlight, picture, view, record;
  int picture_width = 1600;  ///< pixels
  std::string progress = "auto";
};
void add_fix_options(CLI::App& command, FixOptions& options);

/// The options for this mesh. They refer to `scene`. Throws UsageError, FileError.
RepairOptions repair_options(const FixOptions& options, const SceneDocument& scene);

struct WantedNesting {
  Nesting nesting;                  ///< no chains: none
  std::vector<std::string> doubts;  ///< see check_nesting()
};

/// The nesting that --nested asks for. Throws UsageError.
WantedNesting nesting_wanted(const FixOptions& options, const SceneDocument& scene);

/// Reads, repairs, writes to a temporary file, reads it back, certifies what was read, renames. Returns the exit code.
/// Throws FileError, WriteError, UsageError.
int run_fix(const FixOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
