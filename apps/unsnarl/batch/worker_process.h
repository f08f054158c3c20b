#pragma once

#include <chrono>
#include <filesystem>
#include <list>
#include <mutex>
#include <string>
#include <vector>

namespace unsnarl::platform {
class ChildProcess;
}  // namespace unsnarl::platform

namespace unsnarl::app {

/// How a worker ended.
struct WorkerEnd {
  int exit_code = 0;  ///< negative: it was killed, see platform::reason_of_death()
  bool timed_out = false;
  double seconds = 0, cpu_s = 0, peak_memory_mb = 0;
};

/// Processes of their own, see platform::ChildProcess. Any number of threads may call run().
class WorkerProcesses {
 public:
  /// Runs a program to its end, its standard error going to a file. time_limit_s: beyond it the worker is killed by
  /// stop_late_ones(); 0: none. Throws SystemError where no process can be started,
  /// FileError where this program cannot.
  WorkerEnd run(const std::string& program, const std::vector<std::string>& arguments,
                const std::filesystem::path& standard_error, double time_limit_s);
  /// Kills those beyond their limits; to be called now and then.
  void stop_late_ones();
  /// Kills all; those to come are killed at once.
  void stop_all();
  bool is_stopped() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    platform::ChildProcess* process;
    Clock::time_point deadline;
    bool timed_out = false;
  };
  mutable std::mutex mutex_;
  std::list<Running> running_;
  bool stopped_ = false;
};

}  // namespace unsnarl::app
