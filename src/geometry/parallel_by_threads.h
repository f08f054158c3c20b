#pragma once

// Loops in parallel by threads of the standard library: geometry/parallel.h says what each of these does.

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace unsnarl::loops {

/// Calls work(k) for each k in [0, count).
void run_calls(std::size_t count, const std::function<void(std::size_t)>& work);
int thread_count();
/// Returns the number of this thread among those that work on loops.
std::size_t number_of_thread();

template <class Count, class Work>
void run(Count count, Work&& work) {
  if (count > 0) run_calls(static_cast<std::size_t>(count), [&](std::size_t k) { work(static_cast<Count>(k)); });
}

template <class Work>
void run_on_threads(int count, Work&& work) {
  run(count, std::forward<Work>(work));
}

/// A thread that works on a loop works on no other.
template <class Work>
void run_isolated(Work&& work) {
  work();
}

template <class Value>
class PerThread {
 public:
  explicit PerThread(std::function<Value()> make)
      : make_(std::move(make)), values_(std::max(static_cast<std::size_t>(thread_count()), number_of_thread() + 1)) {}
  Value& local() {
    std::optional<Value>& value = values_[number_of_thread()];
    return value ? *value : value.emplace(make_());
  }

 private:
  std::function<Value()> make_;
  std::vector<std::optional<Value>> values_;
};

class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int threads_;
};

inline std::string version_of_tbb() {
  return {};
}

}  // namespace unsnarl::loops
