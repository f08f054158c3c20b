#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace unsnarl {

/// The order of the work on the frames of a sequence. Frames are repaired outward from key frames. Each frame wanted is
/// finished from the repairs of the frames around it. Frames are finished in any order, and handed on in theirs. The
/// schedule knows nothing of what the work is, and is not safe from several threads.
class FrameSchedule {
 public:
  struct Job {
    std::size_t frame = 0;
    bool is_repair = false;  ///< else: the frame is finished from those around it
  };

  /// Frames [first, last) of `frames` are wanted. `ahead`: so many of them are under way at once, at most: enough that
  /// none waits for long; they are lost where the work is cut off.
  FrameSchedule(std::size_t frames, std::size_t first, std::size_t last, std::size_t ahead);

  /// The repair of frame t starts from that of this frame; itself: from none.
  std::size_t start_of(std::size_t t) const;
  /// The frames around t, itself among them, whose repairs its result is made of.
  static std::size_t begin_around(std::size_t t);
  std::size_t end_around(std::size_t t) const;

  /// The next frame to be opened, if one may be: its jobs are added. `open` must follow.
  bool may_open() const;
  std::size_t next_to_open() const { return opened_; }
  /// `is_done`: its result is known already; it is only looked at.
  void open(bool is_done);

  /// A job of which all is there that it needs, which begins now; none: there is none yet.
  std::optional<Job> begin();
  void end(const Job& job);
  /// No job is left to begin, now or later.
  bool is_over() const { return jobs_.empty() && !may_open() && opened_ >= last_; }

  /// The next frame, in order, that is finished and not handed on; which this does.
  std::optional<std::size_t> hand_on();
  /// All frames before this one are handed on.
  std::size_t handed_on() const { return handed_on_; }

  bool is_busy(std::size_t t) const { return frames_[t].is_busy; }
  /// The result of this opened frame was not known before.
  bool is_wanted(std::size_t t) const { return frames_[t].is_wanted; }

 private:
  struct Frame {
    bool is_wanted = true, is_busy = false, is_repaired = false, is_finished = false;
  };
  bool is_ready(const Job& job) const;

  const std::size_t first_, last_, ahead_;
  std::vector<Frame> frames_;
  std::vector<Job> jobs_;  // not yet begun, in the order of need
  std::size_t opened_, handed_on_;
  std::size_t next_repair_;  // no frame before it will be repaired
};

}  // namespace unsnarl
