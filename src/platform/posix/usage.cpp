#include "platform/usage.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "platform/posix/system.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace unsnarl::platform {
namespace {

struct MappedMemory {
  double anonymous = 0;  // bytes that are resident and no file's
  double data = 0;       // bytes mapped private and writable, resident or not: what RLIMIT_DATA counts
  double files = 0;      // bytes of the program and its libraries, all of which may become resident
};

MappedMemory mapped_memory() {
  MappedMemory memory;
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

}  // namespace

void release_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

double resident_memory_mb() {
  long total = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &total, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / bytes_a_megabyte;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / bytes_a_megabyte;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

double usable_memory_mb() {
  double bytes = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  // Control groups, version 2: a limit of any group above binds too. "max" is no number and stays.
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::/")) continue;
    const std::filesystem::path top = "/sys/fs/cgroup";
    for (auto group = top / line.substr(4);; group = group.parent_path()) {
      std::ifstream limit(group / "memory.max");
      if (double allowed = 0; limit >> allowed) bytes = std::min(bytes, allowed);
      if (group == top || !group.has_relative_path()) break;
    }
  }
  return bytes / bytes_a_megabyte;
}

MemoryLimit::MemoryLimit(double limit_mb) {
  rlimit limit{};
  const MappedMemory now = mapped_memory();
  if (now.data == 0 || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  previous_ = limit.rlim_cur;
  // Every byte that is mapped from now on may become resident.
  const double allowed = now.data + std::max(0.0, bytes_a_megabyte * limit_mb - now.anonymous - now.files);
  if (allowed >= static_cast<double>(limit.rlim_cur)) return;
  limit.rlim_cur = static_cast<rlim_t>(allowed);
  is_on_ = setrlimit(RLIMIT_DATA, &limit) == 0;
}

MemoryLimit::~MemoryLimit() {
  rlimit limit{};
  if (!is_on_ || getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = static_cast<rlim_t>(previous_);
  setrlimit(RLIMIT_DATA, &limit);
}

}  // namespace unsnarl::platform
