#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "standard_streams.h"
#include "usage_error.h"

namespace unsnarl::app {

ProgressStyle progress_style(const std::string& name, bool quiet) {
  if (name == "json") return ProgressStyle::json;
  if (name == "none") return ProgressStyle::none;
  if (name != "auto") throw UsageError("--progress " + name + ": choose auto, json or none");
  return !quiet && ::isatty(STDERR_FILENO) ? ProgressStyle::line : ProgressStyle::none;
}

void ProgressDisplay::show(const Context::Progress& progress) {
  switch (style_) {
    case ProgressStyle::none: return;
    case ProgressStyle::json: {
      const nlohmann::ordered_json json = {{"fraction", progress.fraction},
                                           {"phase", progress.phase},
                                           {"pairs_left", progress.pairs_left},
                                           {"displacement_rel", progress.displacement_rel}};
      tell(json.dump() + "\n");
      break;
    }
    case ProgressStyle::line:
      tell(fmt::format("\r\x1b[K{:<9} {:3.0f} %   {} intersecting pairs left   moved up to {:.2g} % of the diagonal",
                       progress.phase, 100 * progress.fraction, progress.pairs_left, 100 * progress.displacement_rel));
      line_shown_ = true;
      break;
  }
}

void ProgressDisplay::clear() {
  if (!line_shown_) return;
  tell("\r\x1b[K");
  line_shown_ = false;
}

}  // namespace unsnarl::app
