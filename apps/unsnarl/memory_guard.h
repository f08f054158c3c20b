#pragma once

#include <optional>

#include "platform/usage.h"

namespace unsnarl::app {

/// While it lives, allocations fail (std::bad_alloc) that would take the process beyond `limit_mb` (10^6 bytes) of
/// resident memory, the program itself included (some 30 MB); 0: no limit. What platform::MemoryLimit can do.
class MemoryGuard {
 public:
  explicit MemoryGuard(double limit_mb);

  /// The limit in MB that allocations of this process have failed for, if any has; 0: there was none.
  static double limit_mb();

 private:
  std::optional<platform::MemoryLimit> limit_;
};

}  // namespace unsnarl::app
