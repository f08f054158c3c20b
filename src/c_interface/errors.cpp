#include "errors.h"

#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include "unsnarl/errors.h"
#include "unsnarl/limit_reached.h"
#include "unsnarl/version.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::c_interface {
namespace {

thread_local std::string last_message;
thread_local int last_number = 0;

int keep(unsnarl_error code, const char* message, int error_number = 0) noexcept {
  last_number = error_number;
  try {
    last_message = visible_text(message);
  } catch (...) {
    last_message.clear();  // not even enough memory for the message
  }
  return code;
}

}  // namespace

int code_of_current_exception() noexcept {
  try {
    throw;
  } catch (const std::logic_error& e) {
    // Other kinds of std::logic_error are broken promises of the library's own.
    const bool about_arguments = dynamic_cast<const std::invalid_argument*>(&e) != nullptr;
    return keep(about_arguments ? UNSNARL_INVALID_ARGUMENT : UNSNARL_INTERNAL_ERROR, e.what());
  } catch (const FileError& e) {
    return keep(UNSNARL_CANNOT_READ, e.what(), e.error_number());
  } catch (const WriteError& e) {
    return keep(UNSNARL_CANNOT_WRITE, e.what(), e.error_number());
  } catch (const SystemError& e) {
    return keep(UNSNARL_SYSTEM_ERROR, e.what(), e.error_number());
  } catch (const LimitReached& e) {
    return keep(UNSNARL_LIMIT_REACHED, e.what());
  } catch (const std::bad_alloc&) {
    return keep(UNSNARL_OUT_OF_MEMORY, "there is not enough memory", ENOMEM);
  } catch (const std::system_error& e) {  // no thread can be started
    return keep(UNSNARL_SYSTEM_ERROR, e.what(), e.code().value());
  } catch (const std::exception& e) {
    return keep(UNSNARL_INTERNAL_ERROR, e.what());
  } catch (...) {
    return keep(UNSNARL_INTERNAL_ERROR, "an unknown exception");
  }
}

void require(const void* argument, const char* name) {
  if (argument == nullptr) throw std::invalid_argument(std::string(name) + " is NULL");
}

}  // namespace unsnarl::c_interface

const char* unsnarl_error_message(void) {
  return unsnarl::c_interface::last_message.c_str();
}
int unsnarl_error_number(void) {
  return unsnarl::c_interface::last_number;
}
const char* unsnarl_version(void) {
  return unsnarl::version;
}
