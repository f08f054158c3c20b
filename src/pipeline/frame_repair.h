#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/frame_motion.h"
#include "unsnarl/repair.h"
#include "unsnarl/sequence.h"

namespace unsnarl {

/// What is known of a frame of a sequence.
struct SequenceFrame {
  std::vector<double> input;          ///< 3 n doubles; empty: not read
  std::unique_ptr<FrameMotion> seen;  ///< in which the corrections of other frames are seen
  RepairResult repaired;              ///< before corrections are averaged
  bool is_clean = false;              ///< that left it as it was
  std::vector<double> result;         ///< 3 n doubles; empty: not known
};

/// The work on single frames. Each function writes the frame that it is called for alone, and may run beside others of
/// other frames.
struct FrameRepair {
  const SequenceSource& source;
  const RepairOptions& options;  ///< of each frame
  Context& context;              ///< asked for cancellation alone

  void see(SequenceFrame& frame) const;
  /// Repairs frame t from the correction of frame `other`, which is repaired, where that has one; t: by itself.
  void repair(std::size_t t, std::size_t other, std::span<SequenceFrame> frames) const;
  /// The result of frame t, whose frames around are repaired: smooth in time, where that holds.
  FrameResult finished(std::size_t t, std::span<const SequenceFrame> frames) const;
  /// The report of frame t, whose result is known.
  FrameReport measured(std::size_t t, const SequenceFrame& frame) const;
  /// How evenly the results go on at frame t, given those of the frames beside it.
  Jitter jitter_of_results(std::size_t t, std::span<const SequenceFrame> frames) const;

 private:
  bool stands_still_at(const SequenceFrame& other, std::size_t t, const SequenceFrame& frame) const;
  std::optional<Positions> start(const SequenceFrame& frame, const SequenceFrame& other) const;
  SurfaceView surface(const std::vector<double>& positions) const;
  RepairOptions options_of(std::size_t t) const;
  Positions mean_correction(std::size_t t, std::span<const SequenceFrame> frames) const;
  std::vector<double> smooth_target(std::size_t t, std::span<const SequenceFrame> frames) const;
  void smooth(std::size_t t, std::span<const SequenceFrame> frames, FrameResult& result) const;
  bool holds(const SequenceFrame& frame, const RepairResult& smoothed) const;
};

}  // namespace unsnarl
