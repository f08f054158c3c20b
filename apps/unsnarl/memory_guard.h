#pragma once

namespace unsnarl::app {

/// While it lives, allocations fail (std::bad_alloc) that would take the process beyond `limit_mb` (10^6 bytes) of
/// resident memory, the program itself included (some 30 MB); 0: no limit. Linux only; elsewhere it does nothing.
class MemoryGuard {
 public:
  explicit MemoryGuard(double limit_mb);
  ~MemoryGuard();
  MemoryGuard(const MemoryGuard&) = delete;
  MemoryGuard& operator=(const MemoryGuard&) = delete;

  /// The limit in MB that allocations of this process have failed for, if any has; 0: there was none.
  static double limit_mb();

 private:
  unsigned long previous_ = 0;
  bool is_on_ = false;
};

}  // namespace unsnarl::app
