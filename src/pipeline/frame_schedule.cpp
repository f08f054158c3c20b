#include "pipeline/frame_schedule.h"

#include <algorithm>
#include <cassert>

#include "unsnarl/sequence.h"

namespace unsnarl {

FrameSchedule::FrameSchedule(std::size_t frames, std::size_t first, std::size_t last, std::size_t ahead)
    : first_(first),
      last_(std::min(last, frames)),
      ahead_(ahead),
      frames_(frames),
      opened_(first),
      handed_on_(first),
      next_repair_(deciding_frames(first, frames).first) {}

std::size_t FrameSchedule::start_of(std::size_t t) const {
  const std::size_t key = key_frame_of(t, frames_.size());
  return t < key ? t + 1 : std::max(key, t - std::min<std::size_t>(t, 1));
}

std::size_t FrameSchedule::begin_around(std::size_t t) {
  return t - std::min(t, sequence_reach);
}

std::size_t FrameSchedule::end_around(std::size_t t) const {
  return std::min(t + sequence_reach + 1, frames_.size());
}

bool FrameSchedule::may_open() const {
  return opened_ < std::min(last_, handed_on_ + ahead_);
}

void FrameSchedule::open(bool is_done) {
  assert(may_open());
  const std::size_t t = opened_++;
  frames_[t].is_wanted = !is_done;
  if (!is_done) {
    const DecidingFrames deciding = deciding_frames(t, frames_.size());
    for (next_repair_ = std::max(next_repair_, deciding.first); next_repair_ < deciding.last; ++next_repair_)
      jobs_.push_back({next_repair_, true});
  }
  jobs_.push_back({t, false});
}

bool FrameSchedule::is_ready(const Job& job) const {
  if (frames_[job.frame].is_busy) return false;  // a result known before is looked at while the frame is repaired
  if (job.is_repair) return start_of(job.frame) == job.frame || frames_[start_of(job.frame)].is_repaired;
  if (!frames_[job.frame].is_wanted) return true;
  for (std::size_t s = begin_around(job.frame); s < end_around(job.frame); ++s)
    if (!frames_[s].is_repaired) return false;
  return true;
}

std::optional<FrameSchedule::Job> FrameSchedule::begin() {
  const auto job = std::find_if(jobs_.begin(), jobs_.end(), [&](const Job& j) { return is_ready(j); });
  if (job == jobs_.end()) return std::nullopt;
  const Job found = *job;
  jobs_.erase(job);
  frames_[found.frame].is_busy = true;
  return found;
}

void FrameSchedule::end(const Job& job) {
  Frame& frame = frames_[job.frame];
  assert(frame.is_busy);
  frame.is_busy = false;
  (job.is_repair ? frame.is_repaired : frame.is_finished) = true;
}

std::optional<std::size_t> FrameSchedule::hand_on() {
  if (handed_on_ >= last_ || !frames_[handed_on_].is_finished) return std::nullopt;
  return handed_on_++;
}

}  // namespace unsnarl
