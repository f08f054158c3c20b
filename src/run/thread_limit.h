#pragma once

#include <oneapi/tbb/global_control.h>

#include <optional>

namespace unsnarl {

/// Holds the number of threads down while it lives; 0: as many as the machine has.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0) control_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, threads);
  }

 private:
  std::optional<oneapi::tbb::global_control> control_;
};

}  // namespace unsnarl
