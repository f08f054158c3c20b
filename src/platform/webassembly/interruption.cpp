#include "platform/interruption.h"

#include <emscripten.h>

#include <utility>

// JavaScript that calls the program sets Module.isAskedToEnd.
EM_JS(int, unsnarl_is_asked_to_end, (), { return Module["isAskedToEnd"] && Module["isAskedToEnd"]() ? 1 : 0; });

namespace unsnarl::platform {
namespace {

std::function<void()>& taker() {
  static auto* const take = new std::function<void()>;
  return *take;
}

}  // namespace

void take_requests_to_end(std::function<void()> take) {
  taker() = std::move(take);
}

void look_for_requests_to_end() {
  // One request is taken once.
  if (taker() && unsnarl_is_asked_to_end() != 0) std::exchange(taker(), nullptr)();
}

}  // namespace unsnarl::platform
