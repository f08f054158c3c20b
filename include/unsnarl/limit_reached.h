#pragma once

#include <stdexcept>
#include <string>

#include "unsnarl/report.h"

namespace unsnarl {

/// A limit of time or memory was reached before there was any result: while the intersections of the input were looked
/// for.
class LimitReached : public std::runtime_error {
 public:
  /// status: Status::time_limit or Status::memory_limit
  explicit LimitReached(Status status)
      : std::runtime_error(std::string(status == Status::memory_limit ? "the memory limit" : "the time limit") +
                           " was reached before all self-intersections of the input were found"),
        status_(status) {}
  Status status() const { return status_; }

 private:
  Status status_;
};

}  // namespace unsnarl
