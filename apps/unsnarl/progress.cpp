#include "progress.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "platform/interruption.h"
#include "platform/terminal.h"
#include "standard_streams.h"
#include "usage_error.h"

namespace unsnarl::app {
namespace {

using Json = nlohmann::ordered_json;

/// Progress that has not changed for so long is shown again.
constexpr std::chrono::milliseconds show_again_after{900};
constexpr std::chrono::seconds log_interval_of_progress{30};

}  // namespace

ProgressStyle progress_style(const std::string& name, bool quiet) {
  if (name == "json") return ProgressStyle::json;
  if (name == "none") return ProgressStyle::none;
  if (name != "auto") throw UsageError("--progress must be 'auto', 'json' or 'none', not '" + name + "'");
  if (quiet) return ProgressStyle::none;
  return platform::is_terminal_of_standard_error() ? ProgressStyle::line : ProgressStyle::log;
}

ProgressDisplay::ProgressDisplay(const std::string& style, bool quiet)
    : style_(progress_style(style, quiet)), is_quiet_(quiet) {
  if (style_ == ProgressStyle::none) return;
  try {
    thread_ = std::thread([this] { show_again(); });
  } catch (const std::system_error&) {
    // Without memory for a thread, progress is shown where there is some.
  }
}

ProgressDisplay::~ProgressDisplay() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    wipe();
  }
  ends_or_changes_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ProgressDisplay::show(const Context::Progress& progress) {
  platform::look_for_requests_to_end();  // all work that can be cancelled shows its progress
  if (style_ == ProgressStyle::none) return;
  {
    const std::lock_guard lock(mutex_);
    shown_ = progress;
    is_counted_ = true;
    ++changes_;
    redraw();
  }
  ends_or_changes_.notify_all();
}

void ProgressDisplay::count(std::string_view name, std::size_t total) {
  const std::lock_guard lock(mutex_);
  things_ = name;
  total_ = total;
}

void ProgressDisplay::begin(std::string_view phase) {
  if (style_ == ProgressStyle::none) return;
  {
    const std::lock_guard lock(mutex_);
    if (!shown_) shown_.emplace();
    shown_->phase = phase;
    ++changes_;
    wipe();
  }
  ends_or_changes_.notify_all();
}

void ProgressDisplay::clear() {
  const std::lock_guard lock(mutex_);
  shown_.reset();
  wipe();
}

void ProgressDisplay::say_line(const std::string& line) {
  const std::lock_guard lock(mutex_);
  wipe();
  tell(line);
}

void ProgressDisplay::show_again() {
  std::unique_lock lock(mutex_);
  while (!is_ending_) {
    const unsigned known = changes_;
    const bool has_news =
        ends_or_changes_.wait_for(lock, show_again_after, [&] { return is_ending_ || changes_ != known; });
    if (!has_news && shown_) redraw();
  }
}

std::string ProgressDisplay::words() const {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  std::string counted;
  if (!things_.empty())
    counted = fmt::format("{} of {} {}   ", things_done(), total_, things_);
  else if (is_counted_)
    counted = fmt::format("{} intersecting pairs left   moved up to {:.2g} % of the diagonal   ", shown_->pairs_left,
                          100 * shown_->displacement_rel);
  return fmt::format("{:<9} {:3.0f} %   {}{:.0f} s", shown_->phase, 100 * shown_->fraction, counted, seconds);
}

std::size_t ProgressDisplay::things_done() const {
  return static_cast<std::size_t>(std::lround(shown_->fraction * static_cast<double>(total_)));
}

std::string ProgressDisplay::json() const {
  Json json = {{"fraction", shown_->fraction},
               {"phase", shown_->phase},
               {"pairs_left", is_counted_ ? Json(shown_->pairs_left) : Json()},
               {"displacement_rel", shown_->displacement_rel},
               {"seconds", std::chrono::duration<double>(Clock::now() - begin_).count()}};
  if (!things_.empty()) json[std::string(things_)] = {{"done", things_done()}, {"total", total_}};
  return json.dump();
}

void ProgressDisplay::redraw() {
  if (style_ == ProgressStyle::json) return tell(json() + "\n");
  if (style_ == ProgressStyle::line) {
    line_shown_ = true;
    return draw("\r\x1b[K" + words());
  }
  if (Clock::now() - last_log_ < log_interval_of_progress) return;
  last_log_ = Clock::now();
  tell(words() + "\n");
}

void ProgressDisplay::wipe() {
  if (!line_shown_) return;
  draw("\r\x1b[K");
  line_shown_ = false;
}

}  // namespace unsnarl::app
