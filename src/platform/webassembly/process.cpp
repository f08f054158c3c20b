#include "platform/process.h"

#include <cerrno>

#include "unsnarl/errors.h"

/// There is one process, which cannot start others.
namespace unsnarl::platform {
namespace {

[[noreturn]] void refuse_processes() {
  throw SystemError("WebAssembly has no processes, which a batch needs: call the program once for each mesh", ENOSYS);
}

}  // namespace

struct ChildProcess::Handles {};

std::string reason_of_death(int exit_code) {
  return "signal " + std::to_string(-exit_code);
}

ChildProcess::ChildProcess(const std::string&, const std::vector<std::string>&, const std::filesystem::path&) {
  refuse_processes();
}

ChildProcess::~ChildProcess() = default;

void ChildProcess::kill() {}

void ChildProcess::wait() {}

ProcessEnd ChildProcess::end() {
  return {};
}

/// JavaScript that calls the program puts a file there, which tells one build from another.
std::filesystem::path program_file() {
  return "/proc/self/exe";
}

std::filesystem::path program_path() {
  refuse_processes();
}

int process_number() {
  return 1;
}

std::string host_name() {
  return {};
}

std::string version_of_glibc() {
  return {};
}

}  // namespace unsnarl::platform
