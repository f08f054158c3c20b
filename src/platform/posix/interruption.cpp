#include "platform/interruption.h"

#include <pthread.h>
#include <signal.h>

#include <thread>
#include <utility>

namespace unsnarl::platform {
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

void take_requests_to_end(std::function<void()> take) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  // Other threads inherit the mask.
  const sigset_t set = signals_to_wait_for();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // Detached: it waits until the process ends.
  std::thread([set, take = std::move(take)] {
    for (;;) {
      int signal = 0;
      if (sigwait(&set, &signal) != 0) return;
      take();
    }
  }).detach();
}

void look_for_requests_to_end() {}

}  // namespace unsnarl::platform
