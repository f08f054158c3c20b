// Memory that runs out anywhere: the status stays true. Replaces operator new of this test program, never inlined, so
// that compilers see a new with each delete.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "pipeline/judged.h"
#include "scene/shapes.h"
#include "unsnarl/repair.h"

namespace unsnarl {
namespace {

std::atomic<long> allocations_left{-1};  // until one fails; negative: none does

void* allocate(std::size_t size, std::size_t alignment) {
  if (allocations_left.load(std::memory_order_relaxed) >= 0 && allocations_left.fetch_sub(1) == 0)
    throw std::bad_alloc();
  size = (std::max(size, std::size_t{1}) + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, size);
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace
}  // namespace unsnarl

[[gnu::noinline]] void* operator new(std::size_t size) {
  return unsnarl::allocate(size, alignof(std::max_align_t));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return unsnarl::allocate(size, static_cast<std::size_t>(alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace unsnarl {
namespace {

TEST(FailingAllocation, leaves_the_status_true) {
  const Surface surface = shapes::crossing_bumps(4, 0.3).surface();
  const std::size_t before = judged(surface, surface.positions).size();
  RepairOptions options;
  options.find.threads = 1;
  constexpr long many = 1'000'000'000;
  allocations_left = many;
  ASSERT_EQ(repair(surface, options).status, Status::embedded);
  const long count = many - allocations_left;
  constexpr int tries = 60;
  int ended = 0;
  for (int k = 0; k < tries; ++k) {
    SCOPED_TRACE(k);
    RepairResult result;
    allocations_left = count * k / tries;
    try {
      result = repair(surface, options);
    } catch (const std::bad_alloc&) {
      allocations_left = -1;
      continue;
    }
    allocations_left = -1;
    ++ended;
    const std::size_t left = judged(surface, result.positions).size();
    EXPECT_EQ(result.status == Status::embedded, left == 0) << to_string(result.status);
    EXPECT_EQ(result.report.after.total(), left);
    EXPECT_LE(left, before);
  }
  EXPECT_GT(ended, tries / 2);
}

}  // namespace
}  // namespace unsnarl
