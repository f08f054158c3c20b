// Loops in parallel. Built twice: with oneTBB, and with threads of the standard library.
#include "geometry/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>

namespace unsnarl {
namespace {

TEST(Parallel, every_index_is_worked_on_once) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    for (const int count : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      parallel_for(count, [&](int k) { ++calls[static_cast<std::size_t>(k)]; });
      for (const auto& of_index : calls) EXPECT_EQ(of_index, 1) << threads << " threads, " << count << " indices";
    }
  }
}

TEST(Parallel, loops_in_loops_are_worked_on_too) {
  const ThreadLimit limit(3);
  std::atomic<int> calls{0};
  parallel_for(20, [&](int) { parallel_for(30, [&](int) { ++calls; }); });
  EXPECT_EQ(calls, 600);
}

TEST(Parallel, several_threads_work_at_a_time) {
  const ThreadLimit limit(2);
  if (thread_count() < 2) GTEST_SKIP() << "this machine has one thread";
  std::atomic<int> arrived{0};
  std::atomic<bool> has_met{false};
  run_on_threads(2, [&](int) {
    ++arrived;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (arrived < 2 && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    if (arrived == 2) has_met = true;
  });
  EXPECT_TRUE(has_met);
}

TEST(Parallel, what_a_call_throws_is_thrown_by_the_loop) {
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const auto fail = [](int k) {
      if (k == 17) throw std::runtime_error("seventeen");
    };
    EXPECT_THROW(parallel_for(100, fail), std::runtime_error);
    std::atomic<int> calls{0};
    parallel_for(100, [&](int) { ++calls; });
    EXPECT_EQ(calls, 100) << "loops after it work as before";
  }
}

TEST(Parallel, a_limit_ends_with_its_scope) {
  const int before = thread_count();
  {
    const ThreadLimit one(1);
    std::set<std::thread::id> threads;
    parallel_for(100, [&](int) { threads.insert(std::this_thread::get_id()); });  // one thread: no race
    EXPECT_EQ(threads.size(), 1u);
    const ThreadLimit none(0);
  }
  EXPECT_EQ(thread_count(), before);
}

TEST(Parallel, limits_may_end_in_any_order) {
  const int before = thread_count();
  auto first = std::make_unique<ThreadLimit>(1);
  auto second = std::make_unique<ThreadLimit>(2);
  first.reset();
  second.reset();
  EXPECT_EQ(thread_count(), before);
}

TEST(Parallel, each_thread_has_its_own_value) {
  const ThreadLimit limit(4);
  std::atomic<int> made{0}, sum{0};
  struct Counter {
    std::atomic<bool> is_in_use{false};
    explicit Counter(std::atomic<int>& made) { ++made; }
    Counter(const Counter& other) : is_in_use(other.is_in_use.load()) {}
  };
  PerThread<Counter> counters([&] { return Counter(made); });
  parallel_for(1000, [&](int k) {
    Counter& own = counters.local();
    EXPECT_FALSE(own.is_in_use.exchange(true)) << "another thread uses it";
    sum += k;
    own.is_in_use = false;
  });
  EXPECT_EQ(sum, 499'500);
  EXPECT_GE(made, 1);
  EXPECT_LE(made, 1000);
}

TEST(Parallel, threads_of_a_caller_may_loop_at_the_same_time) {
  std::atomic<int> calls{0};
  std::vector<std::thread> callers;
  for (int c = 0; c < 4; ++c)
    callers.emplace_back([&] {
      for (int round = 0; round < 50; ++round) parallel_for(40, [&](int) { ++calls; });
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(calls, 4 * 50 * 40);
}

}  // namespace
}  // namespace unsnarl
