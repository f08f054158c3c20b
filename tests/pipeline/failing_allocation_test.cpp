// Memory that runs out anywhere: the status stays true; and how much is needed. Replaces operator new of this test
// program, never inlined, so that compilers see a new with each delete.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <memory>
#include <new>
#include <numbers>

#include "contact/intersection_finder.h"
#include "geometry/parallel.h"
#include "pipeline/judged.h"
#include "recover/recover.h"
#include "scene/shapes.h"
#include "unsnarl/repair.h"
#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

std::atomic<long> allocations_left{-1};                // until one fails; negative: none does
std::atomic<std::size_t> bytes_now{0}, most_bytes{0};  // what is allocated; the most since it was set

/// It lies before each block that operator new hands out.
struct Header {
  void* memory;  // of malloc
  std::size_t size;
};

void* allocate(std::size_t size, std::size_t alignment) {
  if (allocations_left.load(std::memory_order_relaxed) >= 0 && allocations_left.fetch_sub(1) == 0)
    throw std::bad_alloc();
  void* const memory = std::malloc(sizeof(Header) + alignment + size);
  if (!memory) throw std::bad_alloc();
  const std::size_t now = bytes_now += size;
  for (std::size_t most = most_bytes; now > most && !most_bytes.compare_exchange_weak(most, now);) {
  }
  void* block = static_cast<Header*>(memory) + 1;
  std::size_t space = alignment + size;
  std::align(alignment, size, block, space);
  new (static_cast<Header*>(block) - 1) Header{memory, size};
  return block;
}

void give_back(void* block) {
  if (!block) return;
  const Header header = static_cast<Header*>(block)[-1];
  bytes_now -= header.size;
  std::free(header.memory);
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
  unsnarl::give_back(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  unsnarl::give_back(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  unsnarl::give_back(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  unsnarl::give_back(memory);
}

namespace unsnarl {
namespace {

constexpr long many = 1'000'000'000;

/// The most bytes that `work` has allocated at any time.
template <class Work>
std::size_t bytes_of(Work&& work) {
  const std::size_t before = bytes_now;
  most_bytes = before;
  work();
  return most_bytes - before;
}

/// A fine tube above a face of the mean edge length of both; the tube is shrunk to a fifth.
Patch shrunk_beside_a_large_face(Index cells) {
  shapes::Shape shape = shapes::tube(cells, cells, 1);
  for (Vec3& p : shape.points) p = Vec3(2 * p[0] / cells, p[1], p[2] + 2);
  const Index fine = static_cast<Index>(shape.points.size());
  shape.add({{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}});
  Patch patch = shapes::patch_of(shape, fine, static_cast<Index>(shape.triangles.size()) - 1);
  patch.edge_length = 2;
  for (Index v = 0; v < fine; ++v) patch.x.col(v) = 0.2 * (patch.rest.col(v) - Vec3(0, 0, 2)) + Vec3(0, 0, 2);
  return patch;
}

TEST(Memory, of_a_recovery_follows_the_number_of_vertices_even_where_all_are_near) {
  constexpr std::size_t most_bytes_a_vertex = 100'000;
  for (const Index cells : {16, 32}) {
    Patch patch = shrunk_beside_a_large_face(cells);
    const Positions start = patch.x;
    EXPECT_LT(bytes_of([&] { recover(patch, {}, {}); }), most_bytes_a_vertex * static_cast<std::size_t>(start.cols()));
    EXPECT_LT((patch.x - patch.rest).norm(), 0.1 * (start - patch.rest).norm());
  }
}

/// A tube and a wider one around it, half an edge apart.
shapes::Shape nested_tubes(Index cells) {
  const double radius = cells / (2 * std::numbers::pi);
  return shapes::tube(cells, cells, radius).add(shapes::tube(cells, cells, radius - 0.5));
}

TEST(Memory, of_gaps_opened_everywhere_follows_the_number_of_vertices) {
  constexpr std::size_t most_bytes_a_vertex = 40'000;
  for (const Index cells : {16, 32}) {
    const shapes::Shape shape = nested_tubes(cells);
    const Surface surface = shape.surface();
    RepairOptions options;
    const double diagonal = std::hypot(cells, cells / std::numbers::pi, cells / std::numbers::pi);
    options.min_gap_rel = 1.5 / diagonal;
    RepairResult result;
    EXPECT_LT(bytes_of([&] { result = repair(surface, options); }), most_bytes_a_vertex * shape.points.size());
    ASSERT_TRUE(result.report.gap);
    EXPECT_TRUE(result.report.gap->is_met());
  }
}

/// The number of allocations that `work` makes.
template <class Work>
long allocations_of(Work&& work) {
  allocations_left = many;
  work();
  return many - allocations_left.exchange(-1);
}
/// Runs `work` with the allocation of this number failing. False: std::bad_alloc came out.
template <class Work>
bool ends_without(long allocation, Work&& work) {
  allocations_left = allocation;
  try {
    work();
  } catch (const std::bad_alloc&) {
    allocations_left = -1;
    return false;
  }
  allocations_left = -1;
  return true;
}

TEST(FailingAllocation, a_finder_finds_all_when_it_is_asked_again) {
  const ThreadLimit one_thread(1);
  const shapes::Shape shape = shapes::crossing_bumps(8, 0.3);
  ASSERT_FALSE(shapes::pairs_of(shape).empty());
  std::vector<Index> sheet_of(shape.points.size(), 0);
  std::fill(sheet_of.begin() + static_cast<std::ptrdiff_t>(sheet_of.size() / 2), sheet_of.end(), 1);
  for (const bool passes_through : {false, true}) {  // one sheet through the other
    const Passing groups = passes_through ? Passing(sheet_of) : Passing();
    const std::vector<IntersectingPair> pairs =
        passes_through ? std::vector<IntersectingPair>() : shapes::pairs_of(shape);
    // The whole comes from afar, a step at a time: from the third on the finder follows what moves.
    for (int step = 0; step < 5; ++step) {
      const auto at = [&](int k) { return Positions(shape.positions().array() + 0.37 * (step - k)); };
      const auto arrived = [&] {
        IntersectionFinder finder(shape.triangles, groups);
        for (int k = 0; k < step; ++k) finder.find(at(k));
        return finder;
      };
      IntersectionFinder finder = arrived();
      const long count = allocations_of([&] { finder.find(shape.positions()); });
      int failed = 0;
      for (long k = 0; k < count; ++k) {
        finder = arrived();
        failed += !ends_without(k, [&] { finder.find(shape.positions()); });
        EXPECT_EQ(finder.find(shape.positions()), pairs) << "allocation " << k << " of step " << step;
      }
      EXPECT_EQ(failed, count);
    }
  }
}

/// What an allocation that fails may make of a result: nothing, or one that says so.
void expect_same_or_said(const RepairResult& result, const RepairResult& reference, const Surface& surface) {
  const std::size_t left = judged(surface, result.positions).size();
  EXPECT_EQ(result.report.after.total(), left);
  EXPECT_LE(left, judged(surface, surface.positions).size());
  if (result.status == Status::memory_limit) return;
  EXPECT_EQ(result.status, reference.status);
  EXPECT_TRUE(result.positions == reference.positions) << to_string(result.status) << " with other positions";
}

TEST(FailingAllocation, the_result_is_the_same_or_says_that_memory_ran_out) {
  const shapes::Shape shape = shapes::crossing_bumps(4, 0.3);
  const Surface surface = shape.surface();
  for (const bool is_rigid : {false, true}) {
    SCOPED_TRACE(is_rigid);
    RepairOptions options;
    options.find.threads = 1;
    if (is_rigid)
      for (std::size_t v = 0; v < shape.points.size(); ++v)
        options.rigid.push_back(v < shape.points.size() / 2 ? 0 : -1);
    RepairResult reference;
    const long count = allocations_of([&] { reference = repair(surface, options); });
    ASSERT_EQ(reference.status, Status::embedded);
    constexpr int tries = 200;
    int said = 0;
    for (int k = 0; k < tries; ++k) {
      SCOPED_TRACE(k);
      RepairResult result;
      if (!ends_without(count * k / tries, [&] { result = repair(surface, options); })) {
        EXPECT_LT(k, tries / 2) << "what was prepared can be given back as it was";
        continue;
      }
      expect_same_or_said(result, reference, surface);
      said += result.status == Status::memory_limit;
    }
    EXPECT_GT(said, tries / 2);
  }
}

/// A sequence of two sheets that pass through each other, and what becomes of it.
std::map<std::size_t, FrameResult> repaired_frames() {
  const shapes::Shape shape = shapes::crossing_bumps(3, 0.3);
  const Surface surface = shape.surface();
  SequenceSource source;
  source.corners = surface.corners;
  source.frames = 3;
  source.positions = [&](std::size_t t) {
    std::vector<double> positions = surface.positions;
    for (std::size_t v = 0; v < positions.size() / 6; ++v) positions[3 * v + 2] += 0.02 * static_cast<double>(t);
    return positions;
  };
  SequenceOptions options;
  options.repair.find.threads = 1;
  std::map<std::size_t, FrameResult> results;
  repair_sequence(source, options, [&](FrameResult&& result) { results[result.report.frame] = std::move(result); });
  return results;
}

TEST(FailingAllocation, frames_are_the_same_or_say_that_memory_ran_out) {
  std::map<std::size_t, FrameResult> reference;
  const long count = allocations_of([&] { reference = repaired_frames(); });
  ASSERT_EQ(reference.size(), 3u);
  bool is_any_smoothed = false;
  for (const auto& [t, frame] : reference) is_any_smoothed |= frame.report.is_smoothed;
  EXPECT_TRUE(is_any_smoothed);
  constexpr int tries = 150;
  int said = 0;
  for (int k = 0; k < tries; ++k) {
    SCOPED_TRACE(k);
    std::map<std::size_t, FrameResult> results;
    if (!ends_without(count * k / tries, [&] { results = repaired_frames(); })) continue;
    for (const auto& [t, frame] : results) {
      said += frame.report.status == Status::memory_limit;
      if (frame.report.status == Status::memory_limit) continue;
      EXPECT_EQ(frame.report.status, reference[t].report.status);
      EXPECT_TRUE(frame.positions == reference[t].positions) << "frame " << t;
    }
  }
  EXPECT_GT(said, 0);
}

}  // namespace
}  // namespace unsnarl
