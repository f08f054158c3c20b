#include "interruption.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <thread>

#include "unsnarl/exit_code.h"

namespace unsnarl::app {
namespace {

/// One a process, as signals are. Never destroyed: the thread that waits for signals outlives main().
struct State {
  std::mutex mutex;
  std::function<void()> on_first;
  std::vector<std::filesystem::path> temporary_folders;
};
State& state() {
  static State* const state = new State;
  return *state;
}

sigset_t signals_to_wait_for() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler != SIG_IGN) sigaddset(&set, signal);
  }
  return set;
}

/// No destructors run: the other threads are still at work. Precondition: the state is locked.
[[noreturn]] void end_locked(int exit_code) {
  // Again and again, since the other threads may be writing into them.
  std::error_code ignored;
  for (const std::filesystem::path& folder : state().temporary_folders)
    for (int attempt = 0; attempt < 100 && std::filesystem::exists(folder, ignored); ++attempt)
      std::filesystem::remove_all(folder, ignored);
  std::_Exit(exit_code);
}

}  // namespace

Interruption::Interruption() {
  state();  // made while there is memory: it is needed where there is none
  // A reader of our output that goes away is a failed write, with a message and an exit code, not a silent death.
  signal(SIGPIPE, SIG_IGN);
  // So is a file beyond the limit that the shell sets (ulimit -f).
  signal(SIGXFSZ, SIG_IGN);
  const sigset_t set = signals_to_wait_for();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // Detached: it waits until the process ends.
  std::thread([set] {
    for (;;) {
      int signal = 0;
      if (sigwait(&set, &signal) != 0) return;
      std::unique_lock lock(state().mutex);
      if (!state().on_first) end_locked(exit_cancelled);
      const std::function<void()> on_first = std::move(state().on_first);
      state().on_first = nullptr;
      on_first();
    }
  }).detach();
}

Interruption::~Interruption() {
  set_handler(nullptr);
}

void Interruption::set_handler(std::function<void()> on_first) {
  const std::lock_guard lock(state().mutex);
  state().on_first = std::move(on_first);
}

void Interruption::hold_off(const std::function<void(std::vector<std::filesystem::path>&)>& action) {
  const std::lock_guard lock(state().mutex);
  action(state().temporary_folders);
}

void Interruption::end_process(int exit_code) {
  const std::unique_lock lock(state().mutex, std::try_to_lock);  // in an emergency it does not matter who else is in
  end_locked(exit_code);
}

}  // namespace unsnarl::app
