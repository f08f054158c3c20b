#include "batch/worker_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "unsnarl/errors.h"

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace unsnarl::app {
namespace {

/// The exit code of a child that could not become the program, as shells have it.
constexpr int exit_cannot_start = 127;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// ru_maxrss is in bytes on macOS, in KiB elsewhere.
#ifdef __APPLE__
constexpr double bytes_of_maxrss = 1;
#else
constexpr double bytes_of_maxrss = 1024;
#endif

/// A worker with all that it has started; itself also where it has not made its group yet.
void kill_all_of(pid_t worker) {
  ::kill(-worker, SIGKILL);
  ::kill(worker, SIGKILL);
}

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

WorkerEnd WorkerProcesses::run(const std::string& program, const std::vector<std::string>& arguments,
                               const std::filesystem::path& standard_error, double time_limit_s) {
  std::vector<char*> words = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const Clock::time_point start = Clock::now();
  const pid_t self = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw SystemError(fmt::format("cannot start a process: {}", std::strerror(errno)), errno);
  if (child == 0) become(words.data(), standard_error.c_str(), self);

  std::list<Running>::iterator entry;
  {
    const std::lock_guard lock(mutex_);
    const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_limit_s));
    entry = running_.insert(running_.end(), {child, time_limit_s > 0 ? start + limit : Clock::time_point::max()});
    if (stopped_) kill_all_of(child);
  }
  // Its number stays taken until it is reaped below, where nobody can kill it any more.
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  WorkerEnd end;
  int status = 0;
  rusage usage{};
  {
    const std::lock_guard lock(mutex_);
    end.timed_out = entry->timed_out;
    running_.erase(entry);
    while (::wait4(child, &status, 0, &usage) != child && errno == EINTR) {
    }
  }
  end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  end.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  end.peak_memory_mb = 1e-6 * bytes_of_maxrss * static_cast<double>(usage.ru_maxrss);
  if (end.exit_code == exit_cannot_start) throw FileError(program + ": cannot be started; --worker needs a program");
  return end;
}

void WorkerProcesses::stop_late_ones() {
  const std::lock_guard lock(mutex_);
  for (Running& worker : running_)
    if (Clock::now() > worker.deadline) {
      worker.timed_out = true;
      kill_all_of(worker.process);
    }
}

void WorkerProcesses::stop_all() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  for (const Running& worker : running_) kill_all_of(worker.process);
}

bool WorkerProcesses::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

}  // namespace unsnarl::app
