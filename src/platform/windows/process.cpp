#include "platform/process.h"

#include <windows.h>
//
#include <psapi.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <system_error>

#include "platform/windows/system.h"
#include "unsnarl/errors.h"

namespace unsnarl::platform {
namespace {

/// The exit code of what kill() ends, beside those of faults (0xC0000005, ...), which are negative too (no unit)
constexpr int exit_killed = -9;

/// A word as CommandLineToArgvW() and the C library take it apart.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') text.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    text += c;
  }
  text.append(backslashes, L'\\');
  return text + L'"';
}

/// A job whose processes end when its last handle goes, with this process at the latest.
Handle new_job() {
  Handle job = owned(::CreateJobObjectW(nullptr, nullptr));
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  if (job) ::SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

/// Opens a file that a child inherits.
Handle inherited(const wchar_t* path, DWORD access, DWORD creation) {
  SECURITY_ATTRIBUTES attributes = {sizeof attributes, nullptr, TRUE};
  return owned(::CreateFileW(path, access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &attributes,
                             creation, FILE_ATTRIBUTE_NORMAL, nullptr));
}

/// The start of a process that inherits these handles and no others.
class Startup {
 public:
  Startup(HANDLE nothing, HANDLE log) : handles_{nothing, log} {
    information_.StartupInfo.cb = sizeof information_;
    information_.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    information_.StartupInfo.hStdInput = information_.StartupInfo.hStdOutput = nothing;
    information_.StartupInfo.hStdError = log;
    SIZE_T size = 0;
    ::InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    list_.resize(size);
    auto* const list = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(list_.data());
    if (!::InitializeProcThreadAttributeList(list, 1, 0, &size)) return;
    information_.lpAttributeList = list;
    ::UpdateProcThreadAttribute(list, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles_.data(), sizeof handles_, nullptr,
                                nullptr);
  }
  ~Startup() {
    if (information_.lpAttributeList != nullptr) ::DeleteProcThreadAttributeList(information_.lpAttributeList);
  }
  Startup(const Startup&) = delete;
  Startup& operator=(const Startup&) = delete;
  STARTUPINFOW* get() { return &information_.StartupInfo; }

 private:
  std::array<HANDLE, 2> handles_;
  std::vector<std::byte> list_;
  STARTUPINFOEXW information_{};
};

}  // namespace

struct ChildProcess::Handles {
  Handle process, job;
};

std::string reason_of_death(int exit_code) {
  if (exit_code == exit_killed) return "force";
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "exception 0x%08X", static_cast<unsigned>(exit_code));
  return text.data();
}

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           const std::filesystem::path& standard_error)
    : handles_(std::make_unique<Handles>()) {
  const std::wstring path = utf16_of(program);
  std::wstring words = quoted(path);
  for (const std::string& argument : arguments) words += L' ' + quoted(utf16_of(argument));
  const Handle nothing = inherited(L"NUL", GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING);
  const Handle log = inherited(standard_error.c_str(), GENERIC_WRITE, CREATE_ALWAYS);
  Startup startup(nothing.get(), log ? log.get() : nothing.get());
  handles_->job = new_job();
  if (!handles_->job)
    throw SystemError("cannot start a process: " + std::generic_category().message(last_errno()), last_errno());
  PROCESS_INFORMATION started{};
  if (!::CreateProcessW(path.c_str(), words.data(), nullptr, nullptr, TRUE,
                        CREATE_SUSPENDED | CREATE_NO_WINDOW | EXTENDED_STARTUPINFO_PRESENT, nullptr, nullptr,
                        startup.get(), &started))
    return;  // has_started of its end() is false
  handles_->process = owned(started.hProcess);
  const Handle thread = owned(started.hThread);
  ::AssignProcessToJobObject(handles_->job.get(), started.hProcess);
  ::ResumeThread(thread.get());
}

ChildProcess::~ChildProcess() = default;

void ChildProcess::kill() {
  ::TerminateJobObject(handles_->job.get(), static_cast<UINT>(exit_killed));
}

void ChildProcess::wait() {
  if (handles_->process) ::WaitForSingleObject(handles_->process.get(), INFINITE);
}

ProcessEnd ChildProcess::end() {
  ProcessEnd end;
  const HANDLE process = handles_->process.get();
  end.has_started = process != nullptr;
  if (!end.has_started) return end;
  DWORD exit_code = 0;
  ::GetExitCodeProcess(process, &exit_code);
  end.exit_code = static_cast<int>(exit_code);
  FILETIME created{}, ended{}, in_system{}, of_program{};
  if (::GetProcessTimes(process, &created, &ended, &in_system, &of_program))
    end.cpu_s = seconds_of(in_system) + seconds_of(of_program);
  PROCESS_MEMORY_COUNTERS memory{};
  if (::GetProcessMemoryInfo(process, &memory, sizeof memory))
    end.peak_memory_mb = static_cast<double>(memory.PeakWorkingSetSize) / bytes_a_megabyte;
  handles_->job.reset();  // what it has started ends too
  return end;
}

std::filesystem::path program_file() {
  std::wstring path(256, L'\0');
  for (;;) {
    const DWORD size = ::GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    if (size == 0) throw FileError("the running program cannot be found", last_errno());
    if (size < path.size()) return path.substr(0, size);
    path.resize(2 * path.size());
  }
}

std::filesystem::path program_path() {
  return program_file();
}

int process_number() {
  return static_cast<int>(::GetCurrentProcessId());
}

std::string host_name() {
  std::wstring name(256, L'\0');
  DWORD size = static_cast<DWORD>(name.size());
  if (!::GetComputerNameExW(ComputerNameDnsHostname, name.data(), &size)) return {};
  return utf8_of(name.substr(0, size));
}

std::string version_of_glibc() {
  return {};
}

}  // namespace unsnarl::platform
