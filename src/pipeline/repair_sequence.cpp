
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "geometry/parallel.h"
#include "pipeline/frame_repair.h"
#include "pipeline/frame_schedule.h"
#include "run/calling_thread.h"
#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

/// Returns how many frames are under way at once: for each thread those around a key frame, which follow each other.
std::size_t frames_ahead() {
  return key_frame_distance * static_cast<std::size_t>(thread_count());
}

/// The threads that work on the frames, and what they share: jobs run without the lock, and each writes its own frame.
class SequenceWork {
 public:
  using Take = std::function<void(FrameResult&&)>;
  SequenceWork(const SequenceSource& source, const SequenceOptions& options, const Take& take, Context& context)
      : source_(source),
        take_(take),
        context_(context),
        tell_(std::exchange(context.on_progress, {})),
        threads_(options.repair.find.threads),
        first_(options.first),
        last_(std::min(options.last, source.frames)),
        repair_{source, options.repair, context},
        schedule_(source.frames, first_, last_, frames_ahead()),
        frames_(source.frames),
        jitter_known_(first_),
        forgotten_(deciding_frames(first_, source.frames).first) {}
  ~SequenceWork() { context_.on_progress = tell_; }
  SequenceWork(const SequenceWork&) = delete;
  SequenceWork& operator=(const SequenceWork&) = delete;

  std::vector<FrameReport> run() {
    const auto work = [&](int) {
      std::unique_lock lock(mutex_);
      try {
        while (const auto job = next_job(lock)) do_job(*job, lock);
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        has_failed_ = true;
        changed_.notify_all();
        throw;
      }
      changed_.notify_all();
    };
    run_on_threads(thread_count(), work);
    std::vector<FrameReport> reports;
    for (const auto& [t, report] : reports_) reports.push_back(report);
    return reports;
  }

 private:
  // Callers of these functions hold the lock.

  /// Waits for a job; none: nothing is left to begin.
  std::optional<FrameSchedule::Job> next_job(std::unique_lock<std::mutex>& lock) {
    for (;; changed_.wait_for(lock, longest_wait)) {
      if (has_failed_ || context_.is_cancelled()) return {};
      while (schedule_.may_open()) open(schedule_.next_to_open());
      if (const auto job = schedule_.begin()) return job;
      if (schedule_.is_over()) return {};
    }
  }

  void open(std::size_t t) {
    if (source_.done) frames_[t].result = source_.done(t);
    schedule_.open(!frames_[t].result.empty());
  }

  /// Without the lock meanwhile.
  void do_job(const FrameSchedule::Job& job, std::unique_lock<std::mutex>& lock) {
    read(job.frame);
    FrameResult result;
    const bool is_wanted = schedule_.is_wanted(job.frame);
    lock.unlock();
    // A repair waits for its own tasks; it must not begin with another frame meanwhile.
    run_isolated([&] {
      SequenceFrame& frame = frames_[job.frame];
      if (job.is_repair) {
        repair_.repair(job.frame, schedule_.start_of(job.frame), frames_);
        if (job.frame < first_ || job.frame >= last_) frame.seen.reset();  // nothing is seen from what is not wanted
        return;
      }
      repair_.see(frame);
      if (is_wanted)
        result = repair_.finished(job.frame, frames_);
      else
        result.report = repair_.measured(job.frame, frame);
    });
    lock.lock();
    if (context_.is_cancelled()) return;  // it may have been cut short
    schedule_.end(job);
    if (!job.is_repair) finished_[job.frame] = std::move(result);
    hand_on();
    changed_.notify_all();
  }

  void read(std::size_t t) {
    std::vector<double>& input = frames_[t].input;
    if (!input.empty()) return;
    input = source_.positions(t);
    if (count_ == 0) count_ = input.size();
    if (input.size() != count_)
      throw std::invalid_argument("frame " + std::to_string(t) + " has " + std::to_string(input.size() / 3) +
                                  " vertices, others have " + std::to_string(count_ / 3));
  }

  /// Hands on what is finished, in the order of the frames; forgets what no frame needs any more.
  void hand_on() {
    while (const auto t = schedule_.hand_on()) {
      FrameResult result = std::move(finished_.extract(*t).mapped());
      reports_[*t] = result.report;
      if (schedule_.is_wanted(*t)) {
        frames_[*t].result = result.positions;
        take_(std::move(result));
      }
      progress(schedule_.handed_on());
    }
    const std::size_t end = schedule_.handed_on();
    for (; jitter_known_ < end && (jitter_known_ + 1 < end || end == last_); ++jitter_known_)
      measure_jitter(jitter_known_);
    for (; forgotten_ < deciding_frames(end, frames_.size()).first; ++forgotten_) frames_[forgotten_] = {};
  }

  void measure_jitter(std::size_t t) {
    const auto is_known = [&](std::size_t s) { return s < frames_.size() && !frames_[s].result.empty(); };
    if (t > 0 && is_known(t - 1) && is_known(t + 1)) reports_[t].jitter = repair_.jitter_of_results(t, frames_);
    if (!schedule_.is_busy(t)) frames_[t].seen.reset();
  }

  void progress(std::size_t end) const {
    if (!tell_) return;
    const double fraction = static_cast<double>(end - first_) / static_cast<double>(last_ - first_);
    tell_({.fraction = fraction, .phase = "frames", .pairs_left = 0, .displacement_rel = 0});
  }

  const SequenceSource& source_;
  const Take& take_;
  Context& context_;
  std::function<void(const Context::Progress&)> tell_;  // ours: the repairs of frames report nothing
  ThreadLimit threads_;
  const std::size_t first_, last_;
  const FrameRepair repair_;
  std::mutex mutex_;                 // guards all below but the frames' contents, and calls of source_ and take_
  std::condition_variable changed_;  // a job is done, or none is to be begun any more
  FrameSchedule schedule_;
  std::vector<SequenceFrame> frames_;
  std::size_t count_ = 0;                        // coordinates of a frame; 0: not known
  std::size_t jitter_known_, forgotten_;         // up to which frame
  std::map<std::size_t, FrameResult> finished_;  // until they are handed on
  std::map<std::size_t, FrameReport> reports_;
  bool has_failed_ = false;
};

}  // namespace

std::vector<FrameReport> repair_sequence(const SequenceSource& source, const SequenceOptions& options,
                                         const std::function<void(FrameResult&&)>& take, Context* context) {
  if (!options.repair.rigid.empty())
    throw std::invalid_argument(
        "RepairOptions::rigid: parts of sequences cannot be rigid, since corrections are averaged "
        "over frames");
  return work_reporting_here(context, [&](Context& own) { return SequenceWork(source, options, take, own).run(); });
}

}  // namespace unsnarl
