#include "platform/process.h"

#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "platform/posix/system.h"
#include "unsnarl/errors.h"

#ifdef __linux__
#include <sys/prctl.h>
#endif
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

namespace unsnarl::platform {
namespace {

/// The exit code of a child that could not become the program (fixed by shells)
constexpr int exit_cannot_start = 127;

#ifdef __APPLE__
constexpr double bytes_of_maxrss = 1;  ///< What ru_maxrss counts in, bytes (fixed by macOS)
#else
constexpr double bytes_of_maxrss = 1024;  ///< What ru_maxrss counts in, bytes (fixed by Linux)
#endif

/// The child between fork and exec: calls that are safe after a fork of a process with threads, and no others.
[[noreturn]] void become(char* const* words, const char* standard_error, pid_t parent) {
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(exit_cannot_start);
#else
  static_cast<void>(parent);
#endif
  ::setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);  // this process waits for signals in a thread and blocks them elsewhere
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int nothing = ::open("/dev/null", O_RDWR);
  const int log = ::open(standard_error, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(log >= 0 ? log : nothing, STDERR_FILENO);
  ::execv(words[0], words);
  ::_exit(exit_cannot_start);
}

}  // namespace

struct ChildProcess::Handles {
  pid_t process = 0;
};

std::string reason_of_death(int exit_code) {
  return "signal " + std::to_string(-exit_code) + " (" + ::strsignal(-exit_code) + ")";
}

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           const std::filesystem::path& standard_error)
    : handles_(std::make_unique<Handles>()) {
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t self = ::getpid();
  handles_->process = ::fork();
  if (handles_->process < 0)
    throw SystemError("cannot start a process: " + std::generic_category().message(errno), errno);
  if (handles_->process == 0) become(words.data(), standard_error.c_str(), self);
}

ChildProcess::~ChildProcess() = default;

void ChildProcess::kill() {
  ::kill(-handles_->process, SIGKILL);
  ::kill(handles_->process, SIGKILL);  // where it has not made its group yet
}

void ChildProcess::wait() {
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(handles_->process), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
}

ProcessEnd ChildProcess::end() {
  int status = 0;
  rusage usage{};
  while (::wait4(handles_->process, &status, 0, &usage) != handles_->process && errno == EINTR) {
  }
  ProcessEnd end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  end.has_started = end.exit_code != exit_cannot_start;
  end.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  end.peak_memory_mb = bytes_of_maxrss * static_cast<double>(usage.ru_maxrss) / bytes_a_megabyte;
  return end;
}

std::filesystem::path program_file() {
  return "/proc/self/exe";
}

std::filesystem::path program_path() {
  std::error_code error;
  std::filesystem::path path = std::filesystem::read_symlink(program_file(), error);
  if (error) throw FileError(program_file().string() + ": " + error.message(), error.value());
  return path;
}

int process_number() {
  return ::getpid();
}

std::string host_name() {
  std::string name(256, '\0');
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.c_str();
}

std::string version_of_glibc() {
#ifdef __GLIBC__
  return gnu_get_libc_version();
#else
  return {};
#endif
}

}  // namespace unsnarl::platform
