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
#include "unsnarl/visible_text.h"

namespace unsnarl::app {

/// How progress is shown on standard error: in one line that changes, or a line now and then.
enum class ProgressStyle { none, line, log, json };

/// "auto", "json" or "none" as users give it; auto: `line` on a terminal, else `log`. Throws UsageError.
ProgressStyle progress_style(const std::string& name, bool quiet);

/// Progress and notes of a command on standard error. A line on a terminal is wiped when it goes. The last state is
/// shown again each second with the seconds that have passed, so that a long step is not taken for the end; in a log
/// each half minute. Safe from any thread.
class ProgressDisplay {
 public:
  ProgressDisplay(const std::string& style, bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const Context::Progress& progress);
  /// From now on progress is a share of so many things of this name ("frames"), of which none intersects.
  void count(std::string_view name, std::size_t total);
  /// Begins a step that tells nothing of itself. It is shown where it takes a second or more. `phase` must be a
  /// literal.
  void begin(std::string_view phase);
  /// Wipes the line, before other text; nothing is shown again until show().
  void clear();
  /// A line of its own, unless quiet.
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (!is_quiet_) say_line(visible_text(fmt::format(text, std::forward<Args>(args)...)) + "\n");
  }

 private:
  using Clock = std::chrono::steady_clock;

  void say_line(const std::string& line);
  void show_again();  // the thread's work
  std::size_t things_done() const;
  std::string words() const;
  std::string json() const;
  void redraw();  // the caller holds the mutex
  void wipe();    // likewise

  const ProgressStyle style_;
  const bool is_quiet_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point last_log_ = begin_;
  std::mutex mutex_;
  std::condition_variable ends_or_changes_;
  std::optional<Context::Progress> shown_;
  std::string_view things_;  // what is counted; empty: the pairs that are left
  std::size_t total_ = 0;
  bool is_counted_ = false;  // not before the first show()
  bool line_shown_ = false, is_ending_ = false;
  unsigned changes_ = 0;
  std::thread thread_;
};

}  // namespace unsnarl::app
