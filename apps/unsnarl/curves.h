#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "interruption.h"

namespace unsnarl::app {

struct CurvesOptions {
  std::string input, output, format;
  double flatten = 1e-4, gap = 4e-3, junction = 1e-9;  ///< fractions of the diagonal
  std::vector<std::string> fix;                        ///< ids of elements, names or numbers of curves
  bool fix_ends = false;
  bool move_strands = false;
  bool keep_partial = false, no_recover = false;
  double time_limit_s = 0;
  std::string report, picture, integrand;
  double bandwidth = 0.05;
  int integrand_curve = 0;
  std::string progress = "auto";
  bool quiet = false;
};
void add_curves_options(CLI::App& command, CurvesOptions& options);

/// Reads curves, untangles them, writes to a temporary file, reads it back, certifies what was read, renames. Returns
/// the exit code. Throws FileError, WriteError, UsageError.
int run_curves(const CurvesOptions& options, Interruption& interruption);

}  // namespace unsnarl::app
