#pragma once

#include <string>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// How progress is shown on standard error.
enum class ProgressStyle { none, line, json };

/// "auto", "json" or "none" as users give it; auto: a line on a terminal, else nothing. Throws UsageError.
ProgressStyle progress_style(const std::string& name, bool quiet);

/// Shows progress; a line on a terminal is wiped when it goes.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressStyle style) : style_(style) {}
  ~ProgressDisplay() { clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const Context::Progress& progress);
  /// Wipes the line, before other text.
  void clear();

 private:
  ProgressStyle style_;
  bool line_shown_ = false;
};

}  // namespace unsnarl::app
