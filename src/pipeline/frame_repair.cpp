#include "pipeline/frame_repair.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/box.h"
#include "mesh/areas.h"
#include "scene/face_pairs.h"
#include "scene/output_format.h"

namespace unsnarl {
namespace {

/// Weights of the frames around one, the frame itself first: the binomial weights of repeated averages of three, 1/4,
/// 1/2, 1/4 [E183] (no unit)
constexpr std::array<double, sequence_reach + 1> weights = {70.0 / 256, 56.0 / 256, 28.0 / 256, 8.0 / 256, 1.0 / 256};

/// Smaller corrections are not spread to other frames, since they would change vertices without being seen (unit:
/// bounding-box diagonal)
constexpr double least_correction_rel = 3e-5;

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

void measure(const SequenceFrame& frame, const std::vector<double>& positions, FrameReport& report) {
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

/// The jitter at frame t of results(frame).
template <class Results>
Jitter jitter_at(std::size_t t, std::span<const SequenceFrame> frames, const Results& results) {
  const SequenceFrame& frame = frames[t];
  const auto correction = [&](std::size_t s) { return frame.seen->correction(frames[s].input, results(frames[s])); };
  const Positions before = correction(t - 1), here = correction(t), after = correction(t + 1);
  const double diagonal = frame.seen->prepared().diagonal_of(frame.input);
  if (here.cols() == 0 || !(diagonal > 0)) return {};
  const auto differences = (before - 2 * here + after).colwise().norm();
  return {differences.mean() / diagonal, differences.maxCoeff() / diagonal};
}

bool lacks_a_gap(const RepairResult& result) {
  return result.report.gap && !result.report.gap->is_met();
}

/// Something is left, and no limit has ended the work.
bool is_worth_another_try(Status status) {
  return status == Status::reduced || status == Status::no_progress || status == Status::displacement_exceeded;
}

FrameReport report_of_repair(std::size_t t, const RepairResult& repaired) {
  return {.frame = t,
          .status = repaired.status,
          .before = repaired.report.before,
          .after = repaired.report.after,
          .allowed_before = repaired.report.allowed_before,
          .allowed_after = repaired.report.allowed_after,
          .diagonal = repaired.report.diagonal,
          .float32_embedded = repaired.report.float32_embedded,
          .precision = repaired.report.precision,
          .changed_components = repaired.report.changed_components,
          .alone = {},
          .jitter = {}};
}

}  // namespace

SurfaceView FrameRepair::surface(const std::vector<double>& positions) const {
  return {positions, source.corners, source.offsets};
}

RepairOptions FrameRepair::options_of(std::size_t t) const {
  RepairOptions own = options;
  own.record = {};
  if (source.as_written)
    own.as_written = [this, t](std::span<const double> positions, bool float32) {
      return source.as_written(t, positions, float32);
    };
  return own;
}

void FrameRepair::see(SequenceFrame& frame) const {
  if (!frame.seen) frame.seen = std::make_unique<FrameMotion>(surface(frame.input), options.find);
}

/// Whether frame t is at the positions of another one, and its file can say what that came to: what stands still must
/// not go on being repaired.
bool FrameRepair::stands_still_at(const SequenceFrame& other, std::size_t t, const SequenceFrame& frame) const {
  const RepairResult& repaired = other.repaired;
  if (other.input != frame.input || !is_resolved(repaired.status)) return false;
  const bool is_float32 = repaired.report.precision == Precision::float32;
  return !source.as_written || source.as_written(t, repaired.positions, is_float32) == repaired.positions;
}

/// A frame moved by the correction of another one; nothing where that has none, or where corrections do not go back
/// toward the input.
std::optional<Positions> FrameRepair::start(const SequenceFrame& frame, const SequenceFrame& other) const {
  if (!options.recover || options.paper || other.is_clean || !is_resolved(other.repaired.status)) return std::nullopt;
  return frame.seen->prepared().rest + frame.seen->correction(other.input, other.repaired.positions);
}

void FrameRepair::repair(std::size_t t, std::size_t other, std::span<SequenceFrame> frames) const {
  SequenceFrame& frame = frames[t];
  see(frame);
  if (other != t && stands_still_at(frames[other], t, frame)) {
    frame.repaired = frames[other].repaired;
    frame.is_clean = frames[other].is_clean;
    return;
  }
  const PreparedSurface& prepared = frame.seen->prepared();
  Finders finders(prepared.triangles(), prepared.scale, prepared.passing());
  const auto repaired_from = [&](const std::optional<Positions>& beginning) {
    return repair_from(surface(frame.input), frame.seen->known(), finders, options_of(t), &context, beginning);
  };
  const std::optional<Positions> beside = other == t ? std::nullopt : start(frame, frames[other]);
  frame.repaired = repaired_from(beside);
  if (beside && is_worth_another_try(frame.repaired.status)) frame.repaired = repaired_from({});
  frame.is_clean = frame.repaired.positions == frame.input;
}

FrameReport FrameRepair::measured(std::size_t t, const SequenceFrame& frame) const {
  FrameReport report;
  report.frame = t;
  report.status = Status::embedded;
  report.diagonal = diagonal_of(surface(frame.input));
  measure(frame, frame.result, report);
  return report;
}

Jitter FrameRepair::jitter_of_results(std::size_t t, std::span<const SequenceFrame> frames) const {
  return jitter_at(t, frames, [](const SequenceFrame& frame) { return frame.result; });
}

FrameResult FrameRepair::finished(std::size_t t, std::span<const SequenceFrame> frames) const {
  const SequenceFrame& frame = frames[t];
  FrameResult result = {report_of_repair(t, frame.repaired), frame.repaired.positions};
  if (!frame.is_clean && is_resolved(frame.repaired.status) && options.recover) {
    smooth(t, frames, result);
    // The mean of the corrections may come from repairs that memory ran out in.
    const DecidingFrames deciding = deciding_frames(t, frames.size());
    for (std::size_t s = deciding.first; s < deciding.last; ++s)
      if (frames[s].repaired.status == Status::memory_limit) result.report.status = Status::memory_limit;
  }
  measure(frame, result.positions, result.report);
  if (t > 0 && t + 1 < frames.size())
    result.report.alone = jitter_at(t, frames, [](const SequenceFrame& f) { return f.repaired.positions; });
  return result;
}

/// The mean of the corrections around frame t; frames beyond the ends are as the last ones.
Positions FrameRepair::mean_correction(std::size_t t, std::span<const SequenceFrame> frames) const {
  const FrameMotion& seen = *frames[t].seen;
  Positions mean = Positions::Zero(3, seen.prepared().weld_map.count);
  std::map<std::size_t, double> shares;
  for (std::size_t k = 0; k <= sequence_reach; ++k) {
    shares[t - std::min(t, k)] += weights[k];
    if (k > 0) shares[std::min(t + k, frames.size() - 1)] += weights[k];
  }
  for (const auto& [s, share] : shares)
    if (!frames[s].is_clean) mean += share * seen.correction(frames[s].input, frames[s].repaired.positions);
  return mean;
}

/// The frame moved by that mean, in the digits of its repair.
std::vector<double> FrameRepair::smooth_target(std::size_t t, std::span<const SequenceFrame> frames) const {
  const SequenceFrame& frame = frames[t];
  const PreparedSurface& prepared = frame.seen->prepared();
  const Scale& scale = prepared.scale;
  const double least = least_correction_rel * prepared.diagonal_of(frame.input);
  const Positions mean = mean_correction(t, frames);
  std::vector<double> target = frame.input;
  for (std::size_t v = 0; v < prepared.weld_map.vertex_of.size(); ++v) {
    const auto correction = mean.col(prepared.weld_map.vertex_of[v]);
    if (correction.norm() < least) continue;
    for (std::size_t k = 0; k < 3; ++k) target[3 * v + k] = scale.out(scale.in(target[3 * v + k]) + correction[k]);
  }
  const bool is_float32 = frame.repaired.report.precision == Precision::float32;
  if (source.as_written) return source.as_written(t, target, is_float32);
  if (is_float32) round_changed_to_float32(frame.input, target);
  return target;
}

/// Replaces the result of the repair with a smooth one, where that holds.
void FrameRepair::smooth(std::size_t t, std::span<const SequenceFrame> frames, FrameResult& result) const {
  const SequenceFrame& frame = frames[t];
  const PreparedSurface& prepared = frame.seen->prepared();
  const std::vector<double> target = smooth_target(t, frames);
  RepairOptions own = options_of(t);
  const double most_displacement_rel = std::exchange(own.max_displacement_rel, 0);
  // In the welding and triangulation of the input, not of the target; from what is known of the repair.
  Finders finders(prepared.triangles(), prepared.scale, prepared.passing());
  if (frame.repaired.report.after.total() == 0)
    finders.start_without_pairs(prepared.gather(result.positions), frame.repaired.report.float32_embedded);
  RepairResult smoothed = repair_from(surface(target), frame.seen->known(), finders, own, &context);
  if (smoothed.status == Status::memory_limit) result.report.status = smoothed.status;
  if (!is_resolved(smoothed.status)) return;
  if (lacks_a_gap(smoothed) && !lacks_a_gap(frame.repaired)) return;
  // A layer that came out on another side would pop.
  if (largest(distances(smoothed.positions, target, prepared.scale)) >
      largest(distances(result.positions, target, prepared.scale)))
    return;
  if (!holds(frame, smoothed)) return;
  FrameResult candidate{result.report, std::move(smoothed.positions)};
  candidate.report.status = smoothed.status;
  candidate.report.after = smoothed.report.after;
  candidate.report.allowed_after = smoothed.report.allowed_after;
  candidate.report.float32_embedded = smoothed.report.float32_embedded;
  candidate.report.precision = smoothed.report.precision;
  candidate.report.is_smoothed = true;
  measure(frame, candidate.positions, candidate.report);
  if (most_displacement_rel > 0 && candidate.report.displacement_max_rel > most_displacement_rel) return;
  result = std::move(candidate);
}

/// The repair followed pairs from frame to target: what it calls embedded is decided once more from nothing, and
/// compared with the input of the frame.
bool FrameRepair::holds(const SequenceFrame& frame, const RepairResult& smoothed) const {
  const PreparedSurface& prepared = frame.seen->prepared();
  const Positions x = prepared.gather(smoothed.positions);
  const PairCounts left = count_by_class(FacePairFinder(prepared).find(x));
  if (options.goal == Goal::all ? left.total() > 0 : left[PairClass::disjoint] > 0) return false;
  if (options.find.weld_tolerance == 0 && !prepared.seams_are_closed(smoothed.positions)) return false;
  if (count_lost_areas(prepared.rest, x, prepared.triangles()) > 0) return false;
  return !frame.repaired.report.float32_embedded || smoothed.report.float32_embedded;
}

}  // namespace unsnarl
