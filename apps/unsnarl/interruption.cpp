#include "interruption.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <thread>

#include "exit_code.h"

namespace unsnarl::app {

struct Interruption::State {
  std::mutex mutex;
  std::function<void()> on_first;
  std::filesystem::path temporary_folder;
};

namespace {

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

}  // namespace

Interruption::Interruption() : state_(std::make_shared<State>()) {
  // A reader of our output that goes away is a failed write, with a message and an exit code, not a silent death.
  signal(SIGPIPE, SIG_IGN);
  const sigset_t set = signals_to_wait_for();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // Detached: it waits until the process ends.
  std::thread([set, state = state_] {
    for (;;) {
      int signal = 0;
      if (sigwait(&set, &signal) != 0) return;
      std::unique_lock lock(state->mutex);
      if (state->on_first) {
        const std::function<void()> on_first = std::move(state->on_first);
        state->on_first = nullptr;
        on_first();
        continue;
      }
      if (!state->temporary_folder.empty()) {
        std::error_code ignored;
        std::filesystem::remove_all(state->temporary_folder, ignored);
      }
      std::_Exit(exit_cancelled);  // no destructors: the other threads are still at work
    }
  }).detach();
}

Interruption::~Interruption() { set_handler(nullptr); }

void Interruption::set_handler(std::function<void()> on_first) {
  const std::lock_guard lock(state_->mutex);
  state_->on_first = std::move(on_first);
}

void Interruption::set_temporary_folder(std::filesystem::path folder) {
  const std::lock_guard lock(state_->mutex);
  state_->temporary_folder = std::move(folder);
}

}  // namespace unsnarl::app
