#pragma once

namespace unsnarl {

/// Gives memory that is not in use back to the system, as far as the allocator can.
void release_free_memory();
/// Resident memory of this process, MB: now, and the most so far.
double resident_memory_mb();
double peak_memory_mb();
/// Processor time of this process so far, by all threads and in the system, s.
double cpu_seconds();

}  // namespace unsnarl
