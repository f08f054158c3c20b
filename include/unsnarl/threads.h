#pragma once

#include <memory>

namespace unsnarl {

/// Returns how many calls of a loop of the library are made at a time, at most: the processors that this process may
/// use, or the least ThreadLimit.
int thread_count();

/// Holds the number of threads of the process down while it lives; the least of all that live counts.
class ThreadLimit {
 public:
  /// threads: 0: as many as the machine has. >= 0
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

/// Starts the threads that loops will take, as far as they start within a twentieth of a second.
void start_threads();

}  // namespace unsnarl
