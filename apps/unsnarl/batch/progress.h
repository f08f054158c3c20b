#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "batch/inputs.h"

namespace unsnarl::app {

/// How far a batch is: meshes done, rate and time left, on standard error. A line that changes on a terminal; elsewhere
/// (the log of a job) a line now and then.
class BatchProgress {
 public:
  BatchProgress(const std::vector<BatchMesh>& meshes, bool quiet);

  // By any thread.
  void skipped(const BatchMesh& mesh);
  void done(const BatchMesh& mesh, const std::string& status);
  void end();

  /// Shows progress until end(), and calls `tick` about once a second.
  void watch(const std::function<void()>& tick);

 private:
  using Clock = std::chrono::steady_clock;
  std::string text() const;

  const bool quiet_, on_terminal_;
  const std::size_t total_;
  std::uintmax_t bytes_to_do_ = 0, bytes_done_ = 0;
  std::size_t skipped_ = 0, done_ = 0, embedded_ = 0;
  const Clock::time_point start_ = Clock::now();
  bool ended_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace unsnarl::app
