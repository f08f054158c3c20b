#pragma once

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "cli/verification.h"

/// Runs the program as its users do.
namespace unsnarl::cli {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define UNSNARL_TESTS_WITH_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define UNSNARL_TESTS_WITH_ADDRESS_SANITIZER
#endif
#if defined(UNSNARL_TESTS_WITH_ADDRESS_SANITIZER)
inline constexpr bool memory_can_be_limited = false;  // the shadow memory takes terabytes of addresses
#else
inline constexpr bool memory_can_be_limited = true;
#endif

namespace fs = std::filesystem;

inline std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// For RunOptions::in_child: the calls "open" or "read" of files whose paths end so fail with this errno, in the
/// program and in those that it starts.
inline std::function<void()> with_failing(const std::string& call, const std::string& file, int error_number) {
  return [=] {
    ::setenv("LD_PRELOAD", UNSNARL_FAILING_READS, 1);
    ::setenv("UNSNARL_FAIL_CALL", call.c_str(), 1);
    ::setenv("UNSNARL_FAIL_FILE", file.c_str(), 1);
    ::setenv("UNSNARL_FAIL_ERRNO", std::to_string(error_number).c_str(), 1);
  };
}
#if defined(UNSNARL_TESTS_WITH_ADDRESS_SANITIZER)
inline constexpr bool calls_can_fail = false;  // its library has to be the first one
#else
inline constexpr bool calls_can_fail = true;
#endif

/// For RunOptions::in_child: permissions count for the program too, even if we are root.
inline void respect_permissions() {
  constexpr unsigned long dac_override = 1, dac_read_search = 2;  // capabilities of <linux/capability.h>
  ::prctl(PR_CAPBSET_DROP, dac_override, 0, 0, 0);
  ::prctl(PR_CAPBSET_DROP, dac_read_search, 0, 0, 0);
}

/// A folder of its own, empty at first and removed at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "unsnarl-cli-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string string() const { return path_.string(); }
  /// Names of everything in it, hidden files included.
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path_))
      names.insert(entry.path().lexically_relative(path_).string());
    return names;
  }

 private:
  fs::path path_;
};

struct Outcome {
  int exit_code = -1;  ///< negative: ended by that signal
  std::string out, err;
};

struct RunOptions {
  std::string input = {};        ///< for standard input
  std::string stdout_path = {};  ///< where standard output goes instead of Outcome::out
  /// The signal is sent whenever the next of these has appeared on standard error.
  std::vector<std::string> signal_after = {};
  int signal = SIGINT;
  int signal_after_us = -1;             ///< microseconds after the start, instead of a word; negative: never
  std::function<void()> in_child = {};  ///< called before the program starts, with its streams in place
};

/// Runs the program with these arguments and waits for it. What `fix` writes is verified by other code than its own.
inline Outcome run(const std::vector<std::string>& arguments, const RunOptions& options = {}) {
  const Folder streams;
  write(streams / "in", options.input);
  const Folder judged;
  const Verification verification(arguments, judged.string(), options.input);
  const std::string out_path = options.stdout_path.empty() ? streams / "out" : options.stdout_path;
  const std::string err_path = streams / "err";
  std::vector<std::string> words = {UNSNARL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = ::fork();
  if (child == 0) {
    const int in = ::open((streams / "in").c_str(), O_RDONLY);
    const int out = ::open(out_path.c_str(), O_WRONLY | O_CREAT, 0600);
    const int err = ::open(err_path.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(in, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::signal(SIGINT, SIG_DFL);
    if (options.in_child) options.in_child();
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  if (options.signal_after_us >= 0) {
    ::usleep(static_cast<useconds_t>(options.signal_after_us));
    ::kill(child, options.signal);
  }
  int status = 0;
  std::size_t sent = 0;
  while (::waitpid(child, &status, sent < options.signal_after.size() ? WNOHANG : 0) != child) {
    if (sent < options.signal_after.size() &&
        contents(err_path).find(options.signal_after[sent]) != std::string::npos) {
      ::kill(child, options.signal);
      ++sent;
    }
    ::usleep(2000);
  }
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (fs::is_regular_file(out_path)) outcome.out = contents(out_path);  // a device may never end
  outcome.err = contents(err_path);
  verification.judge(outcome.exit_code, outcome.out);
  return outcome;
}

}  // namespace unsnarl::cli
