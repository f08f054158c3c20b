#include "batch/progress.h"

#include <fmt/format.h>

#include "platform/terminal.h"
#include "standard_streams.h"
#include "unsnarl/report.h"

namespace unsnarl::app {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds tick_length(1), log_interval(30);

std::string duration(double seconds) {
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// Every mesh costs something besides its size: that of so many bytes.
constexpr std::uintmax_t bytes_of_a_start = 10'000;

}  // namespace

BatchProgress::BatchProgress(const std::vector<BatchMesh>& meshes, bool quiet)
    : quiet_(quiet), on_terminal_(platform::is_terminal_of_standard_error()), total_(meshes.size()) {
  for (const BatchMesh& mesh : meshes) bytes_to_do_ += mesh.bytes + bytes_of_a_start;
}

void BatchProgress::skipped(const BatchMesh& mesh) {
  const std::lock_guard lock(mutex_);
  ++skipped_;
  bytes_to_do_ -= mesh.bytes + bytes_of_a_start;
}

void BatchProgress::done(const BatchMesh& mesh, const std::string& status) {
  const std::lock_guard lock(mutex_);
  ++done_;
  if (status == to_string(Status::embedded)) ++embedded_;
  bytes_done_ += mesh.bytes + bytes_of_a_start;
}

void BatchProgress::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void BatchProgress::watch(const std::function<void()>& tick) {
  Clock::time_point next_log = start_;
  for (std::unique_lock lock(mutex_);;) {
    const bool ended = changed_.wait_for(lock, tick_length, [this] { return ended_; });
    const std::string line = text();
    lock.unlock();
    if (!ended) tick();
    if (!quiet_ && on_terminal_) {
      draw("\r\x1b[K" + line + (ended ? "\n" : ""));
    } else if (!quiet_ && (ended || Clock::now() >= next_log)) {
      tell(line + "\n");
      next_log = Clock::now() + std::chrono::duration_cast<Clock::duration>(log_interval);
    }
    if (ended) return;
    lock.lock();
  }
}

std::string BatchProgress::text() const {
  const double elapsed_s = Seconds(Clock::now() - start_).count();
  std::string text = fmt::format("{} of {} meshes", skipped_ + done_, total_);
  if (skipped_ > 0) text += fmt::format(", {} done before", skipped_);
  if (done_ > embedded_) text += fmt::format(", {} not embedded", done_ - embedded_);
  text += fmt::format("; {}", duration(elapsed_s));
  if (done_ > 0) text += fmt::format(", {:.3g} a second", static_cast<double>(done_) / elapsed_s);
  if (done_ > 0 && bytes_to_do_ > bytes_done_)
    text += fmt::format(", about {} left", duration(elapsed_s * static_cast<double>(bytes_to_do_ - bytes_done_) /
                                                    static_cast<double>(bytes_done_)));
  return text;
}

}  // namespace unsnarl::app
