#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "mesh/areas.h"
#include "pipeline/frame_motion.h"
#include "run/calling_thread.h"
#include "run/thread_limit.h"
#include "scene/face_pairs.h"
#include "scene/output_format.h"
#include "unsnarl/sequence.h"

namespace unsnarl {
namespace {

/// Binomial weights over the frames around one, of those nearest first: repeated averages of three (1/4, 1/2, 1/4). On
/// 24 frames of a dancer in a dress, mean jitter against repairs by themselves: 36 % with a reach of 2, 32 % with 4, 32
/// % with 6.
constexpr std::array<double, sequence_reach + 1> weights = {70.0 / 256, 56.0 / 256, 28.0 / 256, 8.0 / 256, 1.0 / 256};

/// Corrections below this share of the diagonal are not spread to other times: they would touch vertices without being
/// seen. On the same frames 96.4 % of the vertices stay untouched instead of 95.6 % with 1e-6, and jitter is the same.
constexpr double least_correction_rel = 3e-5;

/// Frames that are under way at once, by thread: enough that none waits for long. They are lost where a call is cut
/// off, and held in memory with the frames around them.
constexpr std::size_t frames_by_thread = 2;

struct Frame {
  std::vector<double> input;
  RepairResult alone;
  bool is_repaired_alone = false;
  bool is_clean = false;              // came back as it was
  std::unique_ptr<FrameMotion> seen;  // from its first repair on, while its jitter is not known
  bool is_wanted = true;              // else an earlier call came to its result
  bool is_busy = false;               // a job of it runs
  bool is_finished = false;
  FrameResult finished;        // until it is handed on
  std::vector<double> result;  // empty: not known
};

/// The repair of a frame by itself, or all that comes after those of the frames around it.
struct FrameJob {
  std::size_t frame;
  bool is_repair_alone;
};

Jitter jitter_of(const Positions& before, const Positions& here, const Positions& after, double diagonal) {
  const auto differences = (before - 2 * here + after).colwise().norm();
  if (here.cols() == 0 || !(diagonal > 0)) return {};
  return {differences.mean() / diagonal, differences.maxCoeff() / diagonal};
}

/// The distance of each vertex between two positions of the same surface, at this scale.
Eigen::RowVectorXd distances(const std::vector<double>& positions, const std::vector<double>& others,
                             const Scale& scale) {
  const auto n = static_cast<Index>(positions.size() / 3);
  using Columns = Eigen::Map<const Positions>;
  const auto in = [&](double number) { return scale.in(number); };
  return (Columns(positions.data(), 3, n).unaryExpr(in) - Columns(others.data(), 3, n).unaryExpr(in)).colwise().norm();
}
double largest(const Eigen::RowVectorXd& lengths) {
  return lengths.size() > 0 ? lengths.maxCoeff() : 0;
}

class SequenceRepair {
 public:
  SequenceRepair(const SequenceSource& source, const SequenceOptions& options,
                 const std::function<void(FrameResult&&)>& take, Context& context)
      : source_(source),
        options_(options),
        take_(take),
        context_(context),
        tell_(std::exchange(context.on_progress, {})),
        threads_(options.repair.find.threads),
        first_(options.first),
        last_(std::min(options.last, source.frames)),
        ahead_(frames_by_thread * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())),
        frames_(source.frames),
        opened_(first_),
        handed_on_(first_),
        jitter_known_(first_),
        forgotten_(begin_around(first_)),
        next_alone_(forgotten_) {}
  ~SequenceRepair() { context_.on_progress = tell_; }
  SequenceRepair(const SequenceRepair&) = delete;
  SequenceRepair& operator=(const SequenceRepair&) = delete;

  std::vector<FrameReport> run() {
    const auto work = [&](int) {
      std::unique_lock lock(mutex_);
      try {
        while (const std::optional<FrameJob> job = next_job(lock)) do_job(*job, lock);
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        has_failed_ = true;
        changed_.notify_all();
        throw;
      }
      changed_.notify_all();
    };
    tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), work, tbb::simple_partitioner());
    std::vector<FrameReport> reports;
    for (const auto& [t, report] : reports_) reports.push_back(report);
    return reports;
  }

 private:
  SurfaceView surface(const std::vector<double>& positions) const {
    return {positions, source_.corners, source_.offsets};
  }
  // The frames around frame t, itself among them.
  static std::size_t begin_around(std::size_t t) { return t - std::min(t, sequence_reach); }
  std::size_t end_around(std::size_t t) const { return std::min(t + sequence_reach + 1, source_.frames); }

  // Scheduling. Callers of these functions hold the lock.

  /// A job of which all is there that it needs, as soon as there is one; none: nothing is left to begin.
  std::optional<FrameJob> next_job(std::unique_lock<std::mutex>& lock) {
    for (;; changed_.wait_for(lock, longest_wait)) {
      if (has_failed_ || context_.is_cancelled()) return {};
      while (opened_ < std::min(last_, handed_on_ + ahead_)) open(opened_++);
      const auto job = std::find_if(jobs_.begin(), jobs_.end(), [&](const FrameJob& j) { return is_ready(j); });
      if (job != jobs_.end()) {
        const FrameJob found = *job;
        jobs_.erase(job);
        return found;
      }
      if (jobs_.empty() && opened_ >= last_) return {};
    }
  }

  /// Adds the jobs for frame t.
  void open(std::size_t t) {
    Frame& frame = frames_[t];
    if (source_.done) frame.result = source_.done(t);
    frame.is_wanted = frame.result.empty();
    if (frame.is_wanted)
      for (next_alone_ = std::max(next_alone_, begin_around(t)); next_alone_ < end_around(t); ++next_alone_)
        jobs_.push_back({next_alone_, true});
    jobs_.push_back({t, false});
  }

  bool is_ready(const FrameJob& job) const {
    if (frames_[job.frame].is_busy) return false;  // the result of an earlier call is looked at while it is repaired
    if (job.is_repair_alone || !frames_[job.frame].is_wanted) return true;
    for (std::size_t s = begin_around(job.frame); s < end_around(job.frame); ++s)
      if (!frames_[s].is_repaired_alone) return false;
    return true;
  }

  /// Without the lock meanwhile.
  void do_job(const FrameJob& job, std::unique_lock<std::mutex>& lock) {
    read(job.frame);
    frames_[job.frame].is_busy = true;
    lock.unlock();
    // A repair waits for its own tasks; it must not begin with another frame meanwhile.
    tbb::this_task_arena::isolate([&] {
      if (job.is_repair_alone)
        repair_alone(job.frame);
      else
        finish(job.frame);
    });
    lock.lock();
    Frame& frame = frames_[job.frame];
    frame.is_busy = false;
    if (context_.is_cancelled()) return;  // it may have been cut short
    (job.is_repair_alone ? frame.is_repaired_alone : frame.is_finished) = true;
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
    for (; handed_on_ < last_ && frames_[handed_on_].is_finished; progress(++handed_on_)) {
      Frame& frame = frames_[handed_on_];
      reports_[handed_on_] = frame.finished.report;
      if (!frame.is_wanted) continue;
      frame.result = frame.finished.positions;
      take_(std::exchange(frame.finished, {}));
    }
    for (; jitter_known_ < handed_on_ && (jitter_known_ + 1 < handed_on_ || handed_on_ == last_); ++jitter_known_)
      measure_jitter(jitter_known_);
    for (; forgotten_ + sequence_reach < handed_on_; ++forgotten_) frames_[forgotten_] = {};
  }

  void measure_jitter(std::size_t t) {
    const auto is_known = [&](std::size_t s) { return s < frames_.size() && !frames_[s].result.empty(); };
    if (t > 0 && is_known(t - 1) && is_known(t + 1))
      reports_[t].jitter = jitter_at(t, [](const Frame& frame) { return frame.result; });
    if (!frames_[t].is_busy) frames_[t].seen.reset();
  }

  void progress(std::size_t end) const {
    if (!tell_) return;
    const double fraction = static_cast<double>(end - first_) / static_cast<double>(last_ - first_);
    tell_({.fraction = fraction, .phase = "frames", .pairs_left = 0, .displacement_rel = 0});
  }

  // The jobs, which run without the lock: each writes its own frame and reads frames that no other job writes.

  FindOptions find() const { return options_.repair.find; }
  RepairOptions options_of(std::size_t t) const {
    RepairOptions options = options_.repair;
    options.record = {};
    if (source_.as_written)
      options.as_written = [this, t](std::span<const double> positions, bool float32) {
        return source_.as_written(t, positions, float32);
      };
    return options;
  }

  void see(Frame& frame) const {
    if (!frame.seen) frame.seen = std::make_unique<FrameMotion>(surface(frame.input), find());
  }

  void repair_alone(std::size_t s) {
    Frame& frame = frames_[s];
    see(frame);
    Finders finders(frame.seen->prepared().triangles(), frame.seen->prepared().scale);
    frame.alone = repair_from(surface(frame.input), frame.seen->known(), finders, options_of(s), &context_);
    frame.is_clean = frame.alone.positions == frame.input;
    if (s < first_ || s >= last_) frame.seen.reset();  // nothing is seen from a frame that is not wanted
  }

  /// The mean of the corrections around frame t; frames beyond the ends are as the last ones.
  Positions mean_correction(std::size_t t, const FrameMotion& seen) const {
    Positions mean = Positions::Zero(3, seen.prepared().weld_map.count);
    std::map<std::size_t, double> shares;
    for (std::size_t k = 0; k <= sequence_reach; ++k) {
      shares[t - std::min(t, k)] += weights[k];
      if (k > 0) shares[std::min(t + k, source_.frames - 1)] += weights[k];
    }
    for (const auto& [s, share] : shares) {
      const Frame& frame = frames_[s];
      if (!frame.is_clean) mean += share * seen.correction(frame.input, frame.alone.positions);
    }
    return mean;
  }

  void finish(std::size_t t) {
    Frame& frame = frames_[t];
    see(frame);
    FrameResult& result = frame.finished;
    if (!frame.is_wanted) {
      result.report.frame = t;
      result.report.status = Status::embedded;
      result.report.diagonal = diagonal_of(surface(frame.input));
      measure(frame, frame.result, result.report);
      return;
    }
    result.positions = frame.alone.positions;
    FrameReport& report = result.report;
    const RepairReport& alone = frame.alone.report;
    report = {.frame = t,
              .status = frame.alone.status,
              .before = alone.before,
              .after = alone.after,
              .diagonal = alone.diagonal,
              .float32_embedded = alone.float32_embedded,
              .precision = alone.precision,
              .alone = {},
              .jitter = {}};
    if (!frame.is_clean && frame.alone.status == Status::embedded && options_.repair.recover) {
      smooth(t, result);
      if (lacked_memory_around(t)) report.status = Status::memory_limit;
    }
    measure(frame, result.positions, report);
    if (t > 0 && t + 1 < source_.frames) report.alone = jitter_at(t, [](const Frame& f) { return f.alone.positions; });
  }

  /// Whether the mean of the corrections is that of repairs that memory ran out in.
  bool lacked_memory_around(std::size_t t) const {
    const auto begin = frames_.begin();
    return std::any_of(begin + static_cast<std::ptrdiff_t>(begin_around(t)),
                       begin + static_cast<std::ptrdiff_t>(end_around(t)),
                       [](const Frame& frame) { return frame.alone.status == Status::memory_limit; });
  }

  /// Replaces the result of a repair by itself with a smooth one, where that holds.
  void smooth(std::size_t t, FrameResult& result) {
    const Frame& frame = frames_[t];
    const PreparedSurface& prepared = frame.seen->prepared();
    const Scale& scale = prepared.scale;
    const double least = least_correction_rel * prepared.diagonal_of(frame.input);
    const Positions mean = mean_correction(t, *frame.seen);
    std::vector<double> target = frame.input;
    for (std::size_t v = 0; v < prepared.weld_map.vertex_of.size(); ++v) {
      const auto correction = mean.col(prepared.weld_map.vertex_of[v]);
      if (correction.norm() < least) continue;
      for (std::size_t k = 0; k < 3; ++k) target[3 * v + k] = scale.out(scale.in(target[3 * v + k]) + correction[k]);
    }
    RepairOptions options = options_of(t);
    const double most_displacement_rel = std::exchange(options.max_displacement_rel, 0);
    const RepairReport& alone = frame.alone.report;
    if (options.as_written)
      target = options.as_written(target, alone.precision == Precision::float32);
    else if (alone.precision == Precision::float32)
      round_changed_to_float32(frame.input, target);
    // In the welding and triangulation of the input, not of the target; from what is known of the repair by itself.
    Finders finders(prepared.triangles(), prepared.scale);
    if (alone.after.total() == 0)
      finders.start_without_pairs(prepared.gather(result.positions), alone.float32_embedded);
    RepairResult smoothed = repair_from(surface(target), frame.seen->known(), finders, options, &context_);
    if (smoothed.status == Status::memory_limit) result.report.status = smoothed.status;
    if (smoothed.status != Status::embedded) return;
    // A layer that came out on another side would pop.
    if (largest(distances(smoothed.positions, target, scale)) > largest(distances(result.positions, target, scale)))
      return;
    // The repair followed pairs from frame to target: what it calls embedded is decided once more from nothing.
    const PairCounts left = count_by_class(FacePairFinder(prepared).find(prepared.gather(smoothed.positions)));
    if (options.goal == Goal::all ? left.total() > 0 : left[PairClass::disjoint] > 0) return;
    if (options.find.weld_tolerance == 0 && !prepared.seams_are_closed(smoothed.positions)) return;
    if (count_lost_areas(prepared.rest, prepared.gather(smoothed.positions), prepared.triangles()) > 0) return;
    if (alone.float32_embedded && !smoothed.report.float32_embedded) return;
    FrameResult candidate{result.report, std::move(smoothed.positions)};
    candidate.report.after = smoothed.report.after;
    candidate.report.float32_embedded = smoothed.report.float32_embedded;
    candidate.report.precision = smoothed.report.precision;
    candidate.report.is_smoothed = true;
    measure(frame, candidate.positions, candidate.report);
    if (most_displacement_rel > 0 && candidate.report.displacement_max_rel > most_displacement_rel) return;
    result = std::move(candidate);
  }

  static void measure(const Frame& frame, const std::vector<double>& positions, FrameReport& report) {
    const std::size_t n = frame.input.size() / 3;
    const Scale scale(frame.input);
    const Eigen::RowVectorXd moved = distances(positions, frame.input, scale);
    double sum = 0;
    std::size_t untouched = 0;
    for (std::size_t v = 0; v < n; ++v) {
      untouched += std::equal(&frame.input[3 * v], &frame.input[3 * v] + 3, &positions[3 * v]);
      sum += moved[static_cast<Index>(v)];
    }
    const double diagonal = diagonal_of_box(frame.input, scale), unit = diagonal > 0 ? 1 / diagonal : 0;
    report.displacement_mean_rel = n > 0 ? sum / static_cast<double>(n) * unit : 0;
    report.displacement_max_rel = largest(moved) * unit;
    report.untouched_share = n > 0 ? static_cast<double>(untouched) / static_cast<double>(n) : 1;
  }

  template <class Result>
  Jitter jitter_at(std::size_t t, const Result& result_of) const {
    const Frame& frame = frames_[t];
    const auto correction = [&](std::size_t s) {
      const Frame& other = frames_[s];
      return frame.seen->correction(other.input, result_of(other));
    };
    return jitter_of(correction(t - 1), correction(t), correction(t + 1),
                     frame.seen->prepared().diagonal_of(frame.input));
  }

  const SequenceSource& source_;
  const SequenceOptions& options_;
  const std::function<void(FrameResult&&)>& take_;
  Context& context_;
  std::function<void(const Context::Progress&)> tell_;  // ours: the repairs of frames report nothing
  ThreadLimit threads_;
  const std::size_t first_, last_, ahead_;  // so many frames are under way at once
  std::mutex mutex_;                        // guards all below but the frames' contents, and calls of source_ and take_
  std::condition_variable changed_;         // a job is done, or none is to be begun any more
  std::vector<Frame> frames_;
  std::size_t count_ = 0;                                      // coordinates of a frame; 0: not known
  std::size_t opened_, handed_on_, jitter_known_, forgotten_;  // up to which frame; of those wanted but the last
  std::size_t next_alone_;                                     // no frame before it will be repaired by itself
  std::vector<FrameJob> jobs_;                                 // not yet begun, in the order of need
  bool has_failed_ = false;
  std::map<std::size_t, FrameReport> reports_;
};

}  // namespace

std::vector<FrameReport> repair_sequence(const SequenceSource& source, const SequenceOptions& options,
                                         const std::function<void(FrameResult&&)>& take, Context* context) {
  if (!options.repair.rigid.empty())
    throw std::invalid_argument(
        "RepairOptions::rigid: parts of sequences cannot be rigid, since corrections are averaged "
        "over frames");
  return work_reporting_here(context, [&](Context& own) { return SequenceRepair(source, options, take, own).run(); });
}

}  // namespace unsnarl
