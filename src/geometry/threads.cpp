#include "unsnarl/threads.h"

#include <atomic>
#include <chrono>
#include <thread>

#include "geometry/parallel.h"

namespace unsnarl {

struct ThreadLimit::Held {
  loops::ThreadLimit limit;
};

ThreadLimit::ThreadLimit(int threads) : held_(threads > 0 ? new Held{loops::ThreadLimit(threads)} : nullptr) {}

ThreadLimit::~ThreadLimit() = default;

int thread_count() {
  return loops::thread_count();
}

void start_threads() {
  constexpr std::chrono::milliseconds patience(50);  ///< Threads are waited for so long (unit: milliseconds)
  const int threads = thread_count();
  std::atomic<int> started = 0;
  const auto end = std::chrono::steady_clock::now() + patience;
  run_on_threads(threads, [&](int) {
    ++started;
    while (started < threads && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  });
}

}  // namespace unsnarl
