#include "batch/resources.h"

#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace unsnarl::app {

int processors() {
  return oneapi::tbb::info::default_concurrency();
}

double memory_mb() {
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
  return 1e-6 * bytes;
}

}  // namespace unsnarl::app
