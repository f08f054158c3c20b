#pragma once

#include <stdexcept>

#include "unsnarl/report.h"

namespace unsnarl {

/// A limit of time or memory was reached before there was any result: while the intersections of the input were looked
/// for.
class LimitReached : public std::runtime_error {
 public:
  /// status: Status::time_limit or Status::memory_limit
  explicit LimitReached(Status status);
  Status status() const { return status_; }

 private:
  Status status_;
};

}  // namespace unsnarl
