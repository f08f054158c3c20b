#include "memory_guard.h"

#include <atomic>

#include "unsnarl/threads.h"

namespace unsnarl::app {
namespace {

std::atomic<double> limit_of_process_mb = 0;

}  // namespace

MemoryGuard::MemoryGuard(double limit_mb) {
  if (limit_mb <= 0) return;
  start_threads();
  limit_.emplace(limit_mb);
  if (limit_->is_on()) limit_of_process_mb = limit_mb;
}

double MemoryGuard::limit_mb() {
  return limit_of_process_mb;
}

}  // namespace unsnarl::app
