#pragma once

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "unsnarl/repair.h"

namespace unsnarl::app {

/// How progress is shown on standard error.
enum class ProgressStyle { none, line, json };

/// "auto", "json" or "none" as users give it; auto: a line on a terminal, else nothing. Throws UsageError.
ProgressStyle progress_style(const std::string& name, bool quiet);

/// Progress and notes of a command on standard error. A line on a terminal is wiped when it goes. The last state is
/// shown again each second with the seconds that have passed, so that a long step is not taken for the end. Safe from
/// any thread.
class ProgressDisplay {
 public:
  ProgressDisplay(const std::string& style, bool quiet) : style_(progress_style(style, quiet)), is_quiet_(quiet) {}
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const Context::Progress& progress);
  /// Begins a step that tells nothing of itself. It is shown where it takes a second or more. `phase` must be a
  /// literal.
  void begin(std::string_view phase);
  /// Wipes the line, before other text; nothing is shown again until show().
  void clear();
  /// A line of its own, unless quiet.
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (!is_quiet_) say_line(fmt::format(text, std::forward<Args>(args)...) + "\n");
  }

 private:
  using Clock = std::chrono::steady_clock;

  void start_thread();
  void say_line(const std::string& line);
  void show_again();  // the thread's work
  void draw();        // the caller holds the mutex
  void wipe();        // likewise

  const ProgressStyle style_;
  const bool is_quiet_;
  const Clock::time_point begin_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable ends_or_changes_;
  std::optional<Context::Progress> shown_;
  bool is_counted_ = false;  // the pairs that are left: not before the first show()
  bool line_shown_ = false, is_ending_ = false;
  unsigned changes_ = 0;
  std::thread thread_;  // started by the first show() or begin()
};

}  // namespace unsnarl::app
