#pragma once

#include <filesystem>
#include <functional>
#include <memory>

namespace unsnarl::app {

/// Ctrl-C and polite requests to end (SIGINT, SIGTERM, SIGHUP). The first calls `on_first`; the second removes the
/// temporary folder in use and ends the process at once. Without `on_first` the first one ends it.
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
  /// The folder to remove when the process ends in the middle; empty: none.
  void set_temporary_folder(std::filesystem::path folder);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace unsnarl::app
