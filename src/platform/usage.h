#pragma once

#include <cstdint>

namespace unsnarl::platform {

/// Gives memory that is not in use back to the system, as far as the allocator can.
void release_free_memory();
/// Resident memory of this process, MB: now, and the most so far.
double resident_memory_mb();
double peak_memory_mb();
/// Processor time of this process so far, by all threads and in the system, s.
double cpu_seconds();

/// Memory that this process may use, in MB (10^6 bytes): what the machine has, or the control group of the process (a
/// Slurm job, a container) allows.
double usable_memory_mb();

/// While it lives, allocations fail that would take this process beyond `limit_mb` of resident memory, the program
/// itself included. Threads are to be started before: their stacks would count in full. Linux and Windows; elsewhere it
/// does nothing.
class MemoryLimit {
 public:
  explicit MemoryLimit(double limit_mb);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

  bool is_on() const { return is_on_; }

 private:
  std::uint64_t previous_ = 0;
  bool is_on_ = false;
};

}  // namespace unsnarl::platform
