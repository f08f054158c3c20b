#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace unsnarl::app {

/// Ctrl-C and polite requests to end (SIGINT, SIGTERM, SIGHUP). The first calls `on_first`; the second removes the
/// temporary folders in use and ends the process at once. Without `on_first` the first one ends it.
///
/// Construct it before any other thread starts: they inherit the signal mask, so that a thread of its own may wait for
/// signals and is free to do what a signal handler must not. Signals ignored at the start (nohup) stay ignored.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Empty: the next signal ends the process.
  void set_handler(std::function<void()> on_first);
  /// Runs an action that must not be torn apart; a signal waits until it is done. The action may change the folders
  /// that are removed when the process ends in the middle.
  void hold_off(const std::function<void(std::vector<std::filesystem::path>& temporary_folders)>& action);
  /// Removes the temporary folders and ends the process at once.
  [[noreturn]] static void end_process(int exit_code);
};

}  // namespace unsnarl::app
