#include "interruption.h"

#include <cstdlib>
#include <mutex>

#include "platform/interruption.h"
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
  platform::take_requests_to_end([] {
    std::unique_lock lock(state().mutex);
    if (!state().on_first) end_locked(exit_cancelled);
    const std::function<void()> on_first = std::move(state().on_first);
    state().on_first = nullptr;
    on_first();
  });
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
