#pragma once

#include <string>

#include "unsnarl/unsnarl.h"

namespace unsnarl::c_interface {

/// Keeps what the current exception says for unsnarl_error_message(). \returns its unsnarl_error
int code_of_current_exception() noexcept;

/// Runs the work of a function of the C interface; no exception leaves it.
template <class Work>
int guarded(const Work& work) noexcept {
  try {
    work();
    return UNSNARL_OK;
  } catch (...) {
    return code_of_current_exception();
  }
}

/// Throws std::invalid_argument where an argument that is needed is NULL.
void require(const void* argument, const char* name);

}  // namespace unsnarl::c_interface
