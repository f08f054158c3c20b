#include "platform/usage.h"

#include <windows.h>
//
#include <malloc.h>
#include <psapi.h>

#include <algorithm>
#include <cstdint>

#include "platform/windows/system.h"

namespace unsnarl::platform {
namespace {

PROCESS_MEMORY_COUNTERS memory_counters() {
  PROCESS_MEMORY_COUNTERS counters{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters);
  return counters;
}

}  // namespace

void release_free_memory() {
  ::_heapmin();
}

double resident_memory_mb() {
  return static_cast<double>(memory_counters().WorkingSetSize) / bytes_a_megabyte;
}

double peak_memory_mb() {
  return static_cast<double>(memory_counters().PeakWorkingSetSize) / bytes_a_megabyte;
}

double cpu_seconds() {
  FILETIME created{}, ended{}, in_system{}, of_program{};
  ::GetProcessTimes(::GetCurrentProcess(), &created, &ended, &in_system, &of_program);
  return seconds_of(in_system) + seconds_of(of_program);
}

double usable_memory_mb() {
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  ::GlobalMemoryStatusEx(&memory);
  double bytes = static_cast<double>(memory.ullTotalPhys);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION job{};
  if (::QueryInformationJobObject(nullptr, JobObjectExtendedLimitInformation, &job, sizeof job, nullptr)) {
    const DWORD flags = job.BasicLimitInformation.LimitFlags;
    if ((flags & JOB_OBJECT_LIMIT_JOB_MEMORY) != 0) bytes = std::min(bytes, static_cast<double>(job.JobMemoryLimit));
    if ((flags & JOB_OBJECT_LIMIT_PROCESS_MEMORY) != 0)
      bytes = std::min(bytes, static_cast<double>(job.ProcessMemoryLimit));
  }
  return bytes / bytes_a_megabyte;
}

// A job that this process is in, whose limit is on what its processes commit.

MemoryLimit::MemoryLimit(double limit_mb) {
  const PROCESS_MEMORY_COUNTERS now = memory_counters();
  const HANDLE job = ::CreateJobObjectW(nullptr, nullptr);
  if (job == nullptr) return;
  previous_ = reinterpret_cast<std::uint64_t>(job);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY;
  // Every byte that is committed from now on may become resident.
  const double more = std::max(0.0, bytes_a_megabyte * limit_mb - static_cast<double>(now.WorkingSetSize));
  limits.ProcessMemoryLimit = now.PagefileUsage + static_cast<SIZE_T>(more);
  is_on_ = ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits) &&
           ::AssignProcessToJobObject(job, ::GetCurrentProcess());
}

MemoryLimit::~MemoryLimit() {
  const auto job = reinterpret_cast<HANDLE>(previous_);
  if (job == nullptr) return;
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION none{};
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &none, sizeof none);
  ::CloseHandle(job);
}

}  // namespace unsnarl::platform
