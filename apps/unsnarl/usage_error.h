#pragma once

#include <stdexcept>

namespace unsnarl::app {

/// Two options that contradict each other, or an invalid value: exit_usage.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace unsnarl::app
