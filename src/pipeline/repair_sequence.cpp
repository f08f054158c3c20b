#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "pipeline/frame_motion.h"
#include "pipeline/threads.h"
#include "unsnarl/certify.h"
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

/// Frames that are worked on at once, by thread: enough that none waits for long. What is under way is lost where a
/// call is cut off, and held in memory with the frames around it.
constexpr std::size_t frames_by_thread = 2;

struct Frame {
  std::vector<double> input;
  RepairResult alone;
  bool is_clean = false;              // came back as it was
  std::unique_ptr<FrameMotion> seen;  // while its jitter is not known
  std::vector<double> result;         // empty: not known
};

Jitter jitter_of(const Positions& before, const Positions& here, const Positions& after, double diagonal) {
  const auto differences = (before - 2 * here + after).colwise().norm();
  if (here.cols() == 0 || !(diagonal > 0)) return {};
  return {differences.mean() / diagonal, differences.maxCoeff() / diagonal};
}

/// Of a vertex at one position from itself at the other.
double largest_distance(const std::vector<double>& positions, const std::vector<double>& others) {
  const auto n = static_cast<Index>(positions.size() / 3);
  using Columns = Eigen::Map<const Positions>;
  return n > 0 ? (Columns(positions.data(), 3, n) - Columns(others.data(), 3, n)).colwise().norm().maxCoeff() : 0;
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
        jitter_known_(options.first) {}
  ~SequenceRepair() { context_.on_progress = tell_; }
  SequenceRepair(const SequenceRepair&) = delete;
  SequenceRepair& operator=(const SequenceRepair&) = delete;

  std::vector<FrameReport> run() {
    const std::size_t at_once =
        frames_by_thread * static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    for (std::size_t begin = first_; begin < last_ && !context_.is_cancelled(); begin += at_once)
      work_on(begin, std::min(begin + at_once, last_));
    std::vector<FrameReport> reports;
    for (const auto& [t, report] : reports_) reports.push_back(report);
    return reports;
  }

 private:
  SurfaceView surface(const std::vector<double>& positions) const {
    return {positions, source_.corners, source_.offsets};
  }

  void work_on(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> all, wanted;
    for (std::size_t t = begin; t < end; ++t) {
      Frame& frame = read(t);
      all.push_back(t);
      if (source_.done) frame.result = source_.done(t);
      if (frame.result.empty()) wanted.push_back(t);
    }
    std::vector<std::size_t> needed;
    for (const std::size_t t : wanted)
      for (std::size_t s = t - std::min(t, sequence_reach); s <= std::min(t + sequence_reach, source_.frames - 1); ++s)
        if (read(s).alone.positions.empty()) needed.push_back(s);
    std::sort(needed.begin(), needed.end());
    needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
    for_each(needed, [&](std::size_t s) { repair_alone(s); });
    if (context_.is_cancelled()) return;
    in_order_.assign(wanted.begin(), wanted.end());
    for_each(all, [&](std::size_t t) {
      Frame& frame = frames_.at(t);
      frame.seen = std::make_unique<FrameMotion>(surface(frame.input), find());
      if (frame.result.empty()) hand_over(finish(t));
    });
    if (context_.is_cancelled()) return;
    for (const std::size_t t : all)
      if (!reports_.contains(t)) report_done(t);
    measure_jitter(end);
    frames_.erase(frames_.begin(), frames_.lower_bound(end - std::min(end, std::max<std::size_t>(sequence_reach, 2))));
    progress(end);
  }

  /// Frame s, with its positions.
  Frame& read(std::size_t s) {
    Frame& frame = frames_[s];
    if (!frame.input.empty()) return frame;
    frame.input = source_.positions(s);
    if (count_ == 0) count_ = frame.input.size();
    if (frame.input.size() != count_)
      throw std::invalid_argument("frame " + std::to_string(s) + " has " + std::to_string(frame.input.size() / 3) +
                                  " vertices, others have " + std::to_string(count_ / 3));
    return frame;
  }

  /// work(frame) of each, in parallel; the result does not depend on how.
  template <class Work>
  void for_each(const std::vector<std::size_t>& list, const Work& work) {
    const auto job = [&](std::size_t k) {
      // A repair waits for its own tasks; it must not begin with another frame meanwhile.
      if (!context_.is_cancelled()) tbb::this_task_arena::isolate([&] { work(list[k]); });
    };
    tbb::parallel_for(std::size_t{0}, list.size(), job, tbb::simple_partitioner());
  }

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

  void repair_alone(std::size_t s) {
    Frame& frame = frames_.at(s);
    frame.alone = repair(surface(frame.input), options_of(s), &context_);
    frame.is_clean = frame.alone.positions == frame.input;
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
      const Frame& frame = frames_.at(s);
      if (!frame.is_clean) mean += share * seen.correction(frame.input, frame.alone.positions);
    }
    return mean;
  }

  FrameResult finish(std::size_t t) {
    Frame& frame = frames_.at(t);
    FrameResult result;
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
    if (!frame.is_clean && frame.alone.status == Status::embedded && options_.repair.recover) smooth(t, result);
    measure(frame, result);
    if (t > 0 && t + 1 < source_.frames) report.alone = jitter_at(t, [](const Frame& f) { return f.alone.positions; });
    return result;
  }

  /// Replaces the result of a repair by itself with a smooth one, where that holds.
  void smooth(std::size_t t, FrameResult& result) {
    const Frame& frame = frames_.at(t);
    const PreparedSurface& prepared = frame.seen->prepared();
    const double least = least_correction_rel * frame.alone.report.diagonal;
    const Positions mean = mean_correction(t, *frame.seen);
    std::vector<double> target = frame.input;
    for (std::size_t v = 0; v < prepared.weld_map.vertex_of.size(); ++v) {
      const auto correction = mean.col(prepared.weld_map.vertex_of[v]);
      if (correction.norm() < least) continue;
      for (int k = 0; k < 3; ++k) target[3 * v + k] += correction[k];
    }
    RepairOptions options = options_of(t);
    const double most_displacement_rel = std::exchange(options.max_displacement_rel, 0);
    const RepairReport& alone = frame.alone.report;
    if (options.as_written)
      target = options.as_written(target, alone.precision == Precision::float32);
    else if (alone.precision == Precision::float32)
      for (std::size_t k = 0; k < target.size(); ++k)
        if (target[k] != frame.input[k]) target[k] = static_cast<double>(static_cast<float>(target[k]));
    RepairResult smoothed = repair(surface(target), options, &context_);
    if (smoothed.status != Status::embedded) return;
    // A layer that came out on another side would pop.
    if (largest_distance(smoothed.positions, target) > largest_distance(result.positions, target)) return;
    // Welding and triangulation are those of the input, not of the target.
    Certifier certifier(surface(frame.input), find());
    const Certificate certificate = certifier.certify(smoothed.positions);
    const bool all = options.goal == Goal::all;
    if (!certificate.seams_closed || (all ? !certificate.embedded() : certificate.pairs[PairClass::disjoint] > 0))
      return;
    const bool float32_embedded = certifier.pairs_in_float32(smoothed.positions).total() == 0;
    if (alone.float32_embedded && !float32_embedded) return;
    FrameResult candidate{result.report, std::move(smoothed.positions)};
    candidate.report.after = certificate.pairs;
    candidate.report.float32_embedded = float32_embedded;
    candidate.report.precision = smoothed.report.precision;
    candidate.report.is_smoothed = true;
    measure(frame, candidate);
    if (most_displacement_rel > 0 && candidate.report.displacement_max_rel > most_displacement_rel) return;
    result = std::move(candidate);
  }

  static void measure(const Frame& frame, FrameResult& result) {
    const std::size_t n = frame.input.size() / 3;
    double sum = 0, largest = 0;
    std::size_t untouched = 0;
    for (std::size_t v = 0; v < n; ++v) {
      const Vec3 d = Vec3::Map(&result.positions[3 * v]) - Vec3::Map(&frame.input[3 * v]);
      untouched += std::equal(&frame.input[3 * v], &frame.input[3 * v] + 3, &result.positions[3 * v]);
      sum += d.norm();
      largest = std::max(largest, d.norm());
    }
    FrameReport& report = result.report;
    const double unit = report.diagonal > 0 ? 1 / report.diagonal : 0;
    report.displacement_mean_rel = n > 0 ? sum / static_cast<double>(n) * unit : 0;
    report.displacement_max_rel = largest * unit;
    report.untouched_share = n > 0 ? static_cast<double>(untouched) / static_cast<double>(n) : 1;
  }

  template <class Result>
  Jitter jitter_at(std::size_t t, const Result& result_of) const {
    const Frame& frame = frames_.at(t);
    const auto correction = [&](std::size_t s) {
      const Frame& other = frames_.at(s);
      return frame.seen->correction(other.input, result_of(other));
    };
    return jitter_of(correction(t - 1), correction(t), correction(t + 1), diagonal_of(surface(frame.input)));
  }

  /// Gives on what is finished, in the order of the frames.
  void hand_over(FrameResult&& result) {
    if (context_.is_cancelled()) return;  // it may have been cut short
    const std::lock_guard lock(mutex_);
    finished_.emplace(result.report.frame, std::move(result));
    while (!in_order_.empty() && finished_.contains(in_order_.front())) {
      const std::size_t t = in_order_.front();
      in_order_.pop_front();
      auto next = finished_.extract(t);
      frames_.at(t).result = next.mapped().positions;
      reports_[t] = next.mapped().report;
      take_(std::move(next.mapped()));
      progress(t);
    }
  }

  void report_done(std::size_t t) {
    const Frame& frame = frames_.at(t);
    FrameResult result;
    result.report.frame = t;
    result.report.status = Status::embedded;
    result.report.diagonal = diagonal_of(surface(frame.input));
    result.positions = frame.result;
    measure(frame, result);
    reports_[t] = result.report;
  }

  /// Of the frames before `end` whose neighbours are known now.
  void measure_jitter(std::size_t end) {
    for (std::size_t t = jitter_known_; t < end; ++t) {
      if (t + 1 >= end && end < last_) return;
      jitter_known_ = t + 1;
      const auto frame = frames_.find(t);
      if (frame == frames_.end()) continue;
      const auto is_known = [&](std::size_t s) { return frames_.contains(s) && !frames_.at(s).result.empty(); };
      if (is_known(t) && t > 0 && is_known(t - 1) && is_known(t + 1))
        reports_[t].jitter = jitter_at(t, [](const Frame& f) { return f.result; });
      frame->second.seen.reset();
    }
  }

  void progress(std::size_t frame) {
    if (!tell_) return;
    fraction_ = std::max(fraction_, static_cast<double>(frame - first_) / static_cast<double>(last_ - first_));
    tell_({.fraction = fraction_, .phase = "frames", .pairs_left = 0, .displacement_rel = 0});
  }

  const SequenceSource& source_;
  const SequenceOptions& options_;
  const std::function<void(FrameResult&&)>& take_;
  Context& context_;
  std::function<void(const Context::Progress&)> tell_;  // ours: the repairs of frames report nothing
  ThreadLimit threads_;
  std::size_t first_, last_, jitter_known_, count_ = 0;
  double fraction_ = 0;
  std::map<std::size_t, Frame> frames_;
  std::mutex mutex_;                  // guards the next three and what take_ does
  std::deque<std::size_t> in_order_;  // frames of this round that take_ has not got
  std::map<std::size_t, FrameResult> finished_;
  std::map<std::size_t, FrameReport> reports_;
};

}  // namespace

std::vector<FrameReport> repair_sequence(const SequenceSource& source, const SequenceOptions& options,
                                         const std::function<void(FrameResult&&)>& take, Context* context) {
  Context own;
  return SequenceRepair(source, options, take, context ? *context : own).run();
}

}  // namespace unsnarl
