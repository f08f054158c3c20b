#include "platform/interruption.h"

#include <utility>

#include "platform/windows/system.h"

namespace unsnarl::platform {
namespace {

std::function<void()>& taker() {
  static auto* const take = new std::function<void()>;  // never destroyed: requests come until the process ends
  return *take;
}

/// Called in a thread of its own. When it returns from what closes the window, the process ends at once.
BOOL WINAPI take_request(DWORD kind) {
  taker()();
  if (kind != CTRL_C_EVENT && kind != CTRL_BREAK_EVENT) ::Sleep(INFINITE);
  return TRUE;
}

}  // namespace

void take_requests_to_end(std::function<void()> take) {
  taker() = std::move(take);
  ::SetConsoleCtrlHandler(take_request, TRUE);
}

void look_for_requests_to_end() {}

}  // namespace unsnarl::platform
