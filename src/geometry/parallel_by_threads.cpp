#if !UNSNARL_TBB
#include "geometry/parallel_by_threads.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

namespace unsnarl::loops {
namespace {

std::mutex limits_mutex;
std::multiset<int> limits;        // of all that live
std::atomic<int> least_limit{0};  // 0: there is none
thread_local std::size_t own_number = 0;
thread_local bool is_in_loop = false;

void update_limit() {
  least_limit = limits.empty() ? 0 : *limits.begin();
}

/// Keeps threads that wait for loops. The thread of a loop within a loop, or beside another, runs it alone: nobody
/// waits for a thread that works elsewhere. It never goes: where a library of Windows ends, its threads have been
/// stopped, and waiting for them would take for ever.
class Pool {
 public:
  /// Returns false where another loop is under way.
  bool run(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t threads) {
    const std::unique_lock turn(turn_, std::try_to_lock);
    if (!turn) return false;
    {
      const std::lock_guard lock(mutex_);
      grow(threads - 1);
      work_ = &work;
      count_ = count;
      next_ = 0;
      failure_ = nullptr;
      wanted_ = working_ = std::min(threads - 1, threads_.size());
      ++loop_;
    }
    wake_.notify_all();
    take_part();
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return working_ == 0; });
    work_ = nullptr;
    if (failure_) std::rethrow_exception(failure_);
    return true;
  }

 private:
  /// Starts threads until there are so many. If the system gives no more, those that there are do the work.
  void grow(std::size_t count) {
    try {
      while (threads_.size() < count) threads_.emplace_back([this, number = threads_.size() + 1] { serve(number); });
    } catch (const std::system_error&) {
    }
  }

  void serve(std::size_t number) {
    own_number = number;
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [&] { return loop_ != seen && number <= wanted_; });
      seen = loop_;
      lock.unlock();
      take_part();
      lock.lock();
      if (--working_ == 0) done_.notify_all();
    }
  }

  void take_part() {
    is_in_loop = true;
    for (std::size_t k = next_++; k < count_; k = next_++) {
      try {
        (*work_)(k);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        next_ = count_;
      }
    }
    is_in_loop = false;
  }

  std::mutex turn_;  // of the loop that is under way
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  std::vector<std::thread> threads_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0, wanted_ = 0, working_ = 0;  // threads that are to take part; that do
  std::atomic<std::size_t> next_{0};
  std::uint64_t loop_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

ThreadLimit::ThreadLimit(int threads) : threads_(threads) {
  if (threads_ <= 0) return;
  const std::lock_guard lock(limits_mutex);
  limits.insert(threads_);
  update_limit();
}

ThreadLimit::~ThreadLimit() {
  if (threads_ <= 0) return;
  const std::lock_guard lock(limits_mutex);
  limits.erase(limits.find(threads_));
  update_limit();
}

int thread_count() {
  const int limit = least_limit;
  return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::size_t number_of_thread() {
  return own_number;
}

void run_calls(std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto threads = std::min(count, static_cast<std::size_t>(thread_count()));
  if (threads > 1 && !is_in_loop) {
    static Pool& pool = *new Pool;
    if (pool.run(count, work, threads)) return;
  }
  for (std::size_t k = 0; k < count; ++k) work(k);
}

}  // namespace unsnarl::loops

#endif
