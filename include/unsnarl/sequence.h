#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "unsnarl/intersections.h"
#include "unsnarl/repair.h"
#include "unsnarl/report.h"

namespace unsnarl {

/// A moving surface: frames of the same faces, and whatever else a repair of them has to ask for. The functions are
/// called by one thread at a time.
struct SequenceSource {
  std::span<const std::int32_t> corners, offsets;  ///< as in SurfaceView
  std::size_t frames = 0;
  /// 3 n doubles, the same number in every frame. Asked for once at most.
  std::function<std::vector<double>(std::size_t frame)> positions;
  /// The result of a frame that an earlier call came to, 3 n doubles; else empty. Such a frame is not repaired again.
  /// Unset: none.
  std::function<std::vector<double>(std::size_t frame)> done;
  /// RepairOptions::as_written of a frame; unlike the others called from any thread. Unset: rounded to the precision.
  std::function<std::vector<double>(std::size_t frame, std::span<const double> positions, bool float32)> as_written;
};

/// A correction's second difference in time, in the frame's own motion: how far the correction of a vertex is from
/// going on evenly between the frames before and after, both turned as the surface around the vertex turns. Mean and
/// largest over all vertices, / diagonal of the frame.
struct Jitter {
  double mean_rel = 0, max_rel = 0;
};

/// What became of a frame.
struct FrameReport {
  std::size_t frame = 0;
  Status status = Status::no_progress;
  PairCounts before, after;
  PairCounts allowed_before, allowed_after;  ///< see RepairReport
  double diagonal = 0;                       ///< of the frame's bounding box; unit of every *_rel
  double displacement_mean_rel = 0, displacement_max_rel = 0;
  double untouched_share = 1;                ///< share of vertices that are bit-identical to the input
  bool float32_embedded = false;             ///< see RepairReport
  Precision precision = Precision::float64;  ///< see RepairReport
  bool is_smoothed = false;                  ///< false: as it came out before corrections were averaged
  /// See RepairReport: of the repair of this frame before corrections are averaged.
  std::vector<ChangedComponent> changed_components = {};
  std::optional<Jitter> alone;   ///< of the repairs before corrections are averaged; unset at the ends
  std::optional<Jitter> jitter;  ///< of the results; unset where one beside it is not known. Not yet known in `take`
};

struct FrameResult {
  FrameReport report;
  std::vector<double> positions;  ///< 3 n doubles
};

struct SequenceOptions {
  /// The options of each frame; limits hold for each by itself. Nothing is recorded; nothing can be rigid.
  RepairOptions repair;
  /// The frames wanted: [first, last). Frames around them are read where they are there, so that the result of a frame
  /// does not depend on what else is wanted.
  std::size_t first = 0, last = static_cast<std::size_t>(-1);
};

/// The corrections of so many frames before and after are averaged.
inline constexpr std::size_t sequence_reach = 4;
/// Frames whose number is a multiple of this are repaired by themselves: key frames [E236] (unit: frames)
inline constexpr std::size_t key_frame_distance = 16;

/// The key frame nearest to frame t of so many. Repairs start from each other from there on to either side [E237].
constexpr std::size_t key_frame_of(std::size_t t, std::size_t frames) {
  const std::size_t nearest = t + key_frame_distance / 2 - 1 - (t + key_frame_distance / 2 - 1) % key_frame_distance;
  return nearest < frames ? nearest : nearest - key_frame_distance;
}

/// The frames [first, last) that have an influence on frame t of so many.
struct DecidingFrames {
  std::size_t first, last;
};
constexpr DecidingFrames deciding_frames(std::size_t t, std::size_t frames) {
  const std::size_t first = t < sequence_reach ? 0 : t - sequence_reach;
  const std::size_t last = t + sequence_reach < frames ? t + sequence_reach : frames - 1;
  const std::size_t first_key = key_frame_of(first, frames), last_key = key_frame_of(last, frames);
  return {first < first_key ? first : first_key, (last > last_key ? last : last_key) + 1};
}

/// Repairs frame by frame so that corrections go on smoothly in time.
///
/// Key frames are repaired by themselves. From there on to either side, each frame is repaired from the correction of
/// the frame beside it, turned with the surface around each vertex: what intersects there is resolved with little
/// motion, then goes back toward the input. Then each frame is moved by the average of the corrections around it
/// (binomial weights over sequence_reach to either side, turned with the surface around each vertex), and what that
/// makes intersect is resolved from there. Frames without self-intersections stay as they are. A frame is certified in
/// the welding of its own input, polygons split as there and as in the result; where its smoothed version does not
/// hold, the one before averaging is its result.
///
/// take: gets each wanted frame that is not done, in order, as soon as its result is certain; called by one thread at a
/// time. What it throws ends the work and is thrown again.
/// context: progress is the share of frames, phase "frames"; Context::cancel ends it early, and frames that `take` did
/// not get are not in the answer.
/// Returns a report of each wanted frame, in order; of those that were done before, their motion and jitter.
/// Throws std::invalid_argument as repair() does, and where a frame has another number of positions.
std::vector<FrameReport> repair_sequence(const SequenceSource& source, const SequenceOptions& options,
                                         const std::function<void(FrameResult&&)>& take, Context* context = nullptr);

}  // namespace unsnarl
