#include "memory_guard.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace unsnarl::app {
namespace {

std::atomic<double> limit_of_process_mb = 0;

struct Memory {
  double anonymous = 0;  // bytes that are resident and no file's
  double data = 0;       // bytes mapped private and writable, resident or not: what RLIMIT_DATA counts
  double files = 0;      // bytes of the program and its libraries, all of which may become resident
};

Memory memory_now() {
  Memory memory;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("RssAnon:")) memory.anonymous = 1024 * std::stod(line.substr(8));
    if (line.starts_with("VmData:")) memory.data = 1024 * std::stod(line.substr(7));
  }
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::string range, mode, offset, device;
    unsigned long inode = 0;
    words >> range >> mode >> offset >> device >> inode;
    const std::size_t dash = range.find('-');
    if (inode == 0 || mode == "---p") continue;
    memory.files += static_cast<double>(std::stoull(range.substr(dash + 1), nullptr, 16) -
                                        std::stoull(range.substr(0, dash), nullptr, 16));
  }
  return memory;
}

/// Lets all worker threads start, whose stacks would count otherwise.
void start_threads() {
  const int threads = oneapi::tbb::this_task_arena::max_concurrency();
  std::atomic<int> started = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  oneapi::tbb::parallel_for(
      0, threads,
      [&](int) {
        ++started;
        while (started < threads && std::chrono::steady_clock::now() < end) std::this_thread::yield();
      },
      oneapi::tbb::simple_partitioner());
}

}  // namespace

MemoryGuard::MemoryGuard(double limit_mb) {
  if (limit_mb <= 0) return;
  start_threads();
  rlimit limit{};
  const Memory now = memory_now();
  if (now.data == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  previous_ = limit.rlim_cur;
  // Every byte that is mapped from now on may become resident.
  const double allowed = now.data + std::max(0.0, 1e6 * limit_mb - now.anonymous - now.files);
  if (allowed >= static_cast<double>(limit.rlim_cur)) return;
  limit.rlim_cur = static_cast<rlim_t>(allowed);
  is_on_ = setrlimit(RLIMIT_DATA, &limit) == 0;
  if (is_on_) limit_of_process_mb = limit_mb;
}

MemoryGuard::~MemoryGuard() {
  rlimit limit{};
  if (!is_on_ || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = previous_;
  setrlimit(RLIMIT_DATA, &limit);
}

double MemoryGuard::limit_mb() {
  return limit_of_process_mb;
}

}  // namespace unsnarl::app
