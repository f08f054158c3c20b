#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace unsnarl::platform {

/// How a process ended.
struct ProcessEnd {
  bool has_started = true;  ///< false: this program cannot be started
  int exit_code = 0;        ///< negative: it was killed, or died of a fault
  double cpu_s = 0, peak_memory_mb = 0;
};

/// The reason behind a negative exit code, in words.
std::string reason_of_death(int exit_code);

/// Another process, which a Ctrl-C meant for this one does not reach, and which ends with this one, however that ends
/// (Linux, Windows). Its standard input and output are empty, its standard error goes to a file.
class ChildProcess {
 public:
  /// Throws SystemError where no process can be started.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& standard_error);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Ends it and all that it has started, by force; safe from any thread until end() is called.
  void kill();
  /// Returns when it has ended.
  void wait();
  /// After wait().
  ProcessEnd end();

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

/// The file of the running program, as it can be read; what it is called, which another file may be by now. Throws
/// FileError, and SystemError where it could not be started again.
std::filesystem::path program_file();
std::filesystem::path program_path();
/// The number of this process.
int process_number();
/// The name of this machine; empty: it has none.
std::string host_name();
/// Empty: another C library runs this process.
std::string version_of_glibc();

}  // namespace unsnarl::platform
