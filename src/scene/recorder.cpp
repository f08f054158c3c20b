#include "scene/recorder.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace unsnarl {

using Track = Recorder::Stage::Track;

Recorder::Recorder(const RecordOptions& options, Positions input) : options_(options), input_(std::move(input)) {
  if (options.frames < 0 || options.frames == 1)
    throw std::invalid_argument("RecordOptions::frames is " + std::to_string(options.frames) +
                                "; give 0 for none, or at least 2");
}

void Recorder::begin_stage(std::string phase) {
  if (!is_on()) return;
  stages_.push_back(std::make_shared<Stage>());
  stages_.back()->phase = std::move(phase);
}

void Recorder::add(Trajectory trajectory, std::string strategy, std::size_t region, std::span<const Index> vertices,
                   const Positions& x) {
  if (!is_on()) return;
  Track& track = stages_.back()->tracks.emplace_back();
  track.strategy = std::move(strategy);
  track.region = region;
  track.iterations = std::move(trajectory.iterations);
  track.bandwidths = std::move(trajectory.bandwidths);
  track.vertices.assign(vertices.begin(), vertices.end());
  if (options_.frames == 0) return;
  track.states = std::move(trajectory.states);
  Positions end(3, static_cast<Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) end.col(static_cast<Index>(i)) = x.col(vertices[i]);
  track.states.push_back({static_cast<int>(track.iterations.size()), std::move(end)});
  bytes_ += track.states.size() * track.states.back().bytes();
  if (bytes_ > total_budget) thin_out();
}

void Recorder::thin_out() {
  stride_ *= 2;
  bytes_ = 0;
  for (const auto& stage : stages_)
    for (Track& track : stage->tracks) {
      const int end = track.states.back().iteration;
      std::erase_if(track.states, [&](const Trajectory::State& state) {
        return state.iteration % stride_ != 0 && state.iteration != end;
      });
      bytes_ += track.states.size() * track.states.back().bytes();
    }
}

void Recorder::renumber(std::span<const std::size_t> number) {
  for (std::shared_ptr<Stage>& stage : stages_) {
    if (stage->phase != "untangle") continue;
    stage = std::make_shared<Stage>(*stage);  // earlier copies of the list keep theirs
    for (Track& track : stage->tracks)
      if (track.region < number.size()) track.region = number[track.region];
  }
}

std::vector<RegionHistory> Recorder::history() const {
  std::vector<RegionHistory> history;
  for (const auto& stage : stages_)
    for (const Track& track : stage->tracks) {
      if (track.region == no_region) continue;
      history.push_back({stage->phase, track.strategy, track.region, track.iterations, {}});
      if (track.bandwidths.empty()) continue;
      std::vector<double>& all = history.back().bandwidths;
      all.assign(static_cast<std::size_t>(input_.cols()), IterationRecord::none);
      for (std::size_t i = 0; i < track.vertices.size(); ++i) all[track.vertices[i]] = track.bandwidths[i];
    }
  return history;
}

}  // namespace unsnarl
