#pragma once

// Loops in parallel by oneTBB: geometry/parallel.h says what each of these does.

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/version.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace unsnarl::loops {

template <class Count, class Work>
void run(Count count, Work&& work) {
  oneapi::tbb::parallel_for(Count{0}, count, std::forward<Work>(work));
}

template <class Work>
void run_on_threads(int count, Work&& work) {
  oneapi::tbb::parallel_for(0, count, std::forward<Work>(work), oneapi::tbb::simple_partitioner());
}

template <class Work>
void run_isolated(Work&& work) {
  oneapi::tbb::this_task_arena::isolate(std::forward<Work>(work));
}

inline int thread_count() {
  return oneapi::tbb::this_task_arena::max_concurrency();
}

template <class Value>
using PerThread = oneapi::tbb::enumerable_thread_specific<Value>;

class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0)
      control_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }

 private:
  std::optional<oneapi::tbb::global_control> control_;
};

inline std::string version_of_tbb() {
  return TBB_runtime_version();
}

}  // namespace unsnarl::loops
