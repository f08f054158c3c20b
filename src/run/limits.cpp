#include "run/limits.h"

#include "platform/usage.h"

namespace unsnarl {

bool Limits::reached() {
  if (reason_ == none) {
    if (context_.is_cancelled())
      reason_ = static_cast<int>(Status::cancelled);
    else if (limits_.time_s > 0 && std::chrono::duration<double>(Clock::now() - begin_).count() > limits_.time_s)
      reason_ = static_cast<int>(Status::time_limit);
    else if (limits_.memory_mb > 0 && platform::resident_memory_mb() > limits_.memory_mb)
      reason_ = static_cast<int>(Status::memory_limit);
  }
  return reason_ != none;
}

bool Limits::has_passed(double share_of_time) {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const bool has = limits_.time_s > 0 && seconds > share_of_time * limits_.time_s;
  if (has) cut_short_ = true;
  return has;
}

void Limits::run_out_of_memory() {
  reason_ = static_cast<int>(Status::memory_limit);
  platform::release_free_memory();
}

Status Limits::status_or(Status status) const {
  const int reason = reason_;
  if (reason == none) return cut_short_ ? Status::time_limit : status;
  return static_cast<Status>(reason);
}

Status Limits::status_of_result(Status status) const {
  const Status limit = status_or(status);
  return limit == Status::cancelled || limit == Status::memory_limit ? limit : status;
}

}  // namespace unsnarl
