#include "platform/usage.h"

#include <emscripten.h>
#include <emscripten/heap.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

extern "C" void emscripten_notify_memory_growth(std::size_t memory);

namespace unsnarl::platform {
namespace {

constexpr double bytes_a_megabyte = 1e6;        ///< Bytes of a megabyte (fixed by SI units)
constexpr double milliseconds_a_second = 1000;  ///< Milliseconds of a second (fixed by SI units)
constexpr std::size_t bytes_a_page = 65536;     ///< Bytes of a page of memory (fixed by WebAssembly)
constexpr std::size_t most_pages = 65536;       ///< Pages of a memory, at most (fixed by WebAssembly)
constexpr std::size_t pages_ahead = 256;  ///< Memory grows by so much at a time, where that is allowed (unit: pages)

/// Memory grows no further than this (unit: pages).
std::atomic<std::size_t> limit_of_pages = most_pages;

/// Adds so many pages; false: there is no room for them.
bool grow(std::size_t pages) {
  if (__builtin_wasm_memory_grow(0, pages) == static_cast<std::size_t>(-1)) return false;
  emscripten_notify_memory_growth(0);
  return true;
}

double used_bytes() {
  return static_cast<double>(reinterpret_cast<std::uintptr_t>(::sbrk(0)));
}

}  // namespace

void release_free_memory() {}

double resident_memory_mb() {
  return used_bytes() / bytes_a_megabyte;
}

/// Memory never shrinks.
double peak_memory_mb() {
  return used_bytes() / bytes_a_megabyte;
}

/// The time that has passed since the module was loaded: there is no other clock.
double cpu_seconds() {
  static const double begin = ::emscripten_get_now();
  return (::emscripten_get_now() - begin) / milliseconds_a_second;
}

double usable_memory_mb() {
  return static_cast<double>(most_pages) * static_cast<double>(bytes_a_page) / bytes_a_megabyte;
}

MemoryLimit::MemoryLimit(double limit_mb) : previous_(limit_of_pages) {
  const double pages = bytes_a_megabyte * limit_mb / static_cast<double>(bytes_a_page);
  if (pages >= static_cast<double>(previous_)) return;
  limit_of_pages = static_cast<std::size_t>(pages);
  is_on_ = true;
}

MemoryLimit::~MemoryLimit() {
  if (is_on_) limit_of_pages = static_cast<std::size_t>(previous_);
}

}  // namespace unsnarl::platform

/// Makes room for `size` bytes in all; sbrk() calls it. It replaces emscripten's own function, which has no limit that
/// can be set at run time. Returns whether there are so many bytes now.
extern "C" int emscripten_resize_heap(std::size_t size) {
  using namespace unsnarl::platform;
  const std::size_t pages = __builtin_wasm_memory_size(0), wanted = (size - 1) / bytes_a_page + 1;
  if (wanted <= pages) return 1;
  const std::size_t limit = limit_of_pages;
  if (wanted > limit) return 0;
  return grow(std::min(wanted + pages_ahead, limit) - pages) || grow(wanted - pages) ? 1 : 0;
}
