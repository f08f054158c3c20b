#include "batch/worker_process.h"

#include "platform/process.h"
#include "unsnarl/errors.h"

namespace unsnarl::app {

WorkerEnd WorkerProcesses::run(const std::string& program, const std::vector<std::string>& arguments,
                               const std::filesystem::path& standard_error, double time_limit_s) {
  const Clock::time_point start = Clock::now();
  platform::ChildProcess process(program, arguments, standard_error);
  std::list<Running>::iterator entry;
  {
    const std::lock_guard lock(mutex_);
    const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_limit_s));
    entry = running_.insert(running_.end(), {&process, time_limit_s > 0 ? start + limit : Clock::time_point::max()});
    if (stopped_) process.kill();
  }
  process.wait();
  WorkerEnd end;
  platform::ProcessEnd ended;
  {
    const std::lock_guard lock(mutex_);
    end.timed_out = entry->timed_out;
    running_.erase(entry);  // nobody can kill it any more
    ended = process.end();
  }
  if (!ended.has_started) throw FileError(program + ": cannot be started; --worker needs a program");
  end.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  end.exit_code = ended.exit_code;
  end.cpu_s = ended.cpu_s;
  end.peak_memory_mb = ended.peak_memory_mb;
  return end;
}

void WorkerProcesses::stop_late_ones() {
  const std::lock_guard lock(mutex_);
  for (Running& worker : running_)
    if (Clock::now() > worker.deadline) {
      worker.timed_out = true;
      worker.process->kill();
    }
}

void WorkerProcesses::stop_all() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  for (const Running& worker : running_) worker.process->kill();
}

bool WorkerProcesses::is_stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

}  // namespace unsnarl::app
