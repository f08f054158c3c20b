#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/trajectory.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// Gathers the trajectories of all regions into the history and the frames of a repair.
///
/// Regions are added in the order in which they are committed, so that the recording does not depend on the number of
/// threads. Within a stage (a strategy, a recovery) those whose vertices do not overlap play at the same time; one that
/// overlaps an earlier one plays after it.
class Recorder {
 public:
  /// input: positions of the scene. Throws std::invalid_argument where options make no sense.
  Recorder(const RecordOptions& options, Positions input);

  bool is_on() const { return options_.any(); }
  Trajectory new_trajectory() const { return Trajectory(options_.frames > 0 ? trajectory_budget : 0); }

  void begin_stage(std::string phase);
  /// Adds the trajectory that led these vertices of the scene to their positions in x. `region`: its number in the
  /// report, or no_region for what the history leaves out.
  static constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();
  void add(Trajectory trajectory, std::string strategy, std::size_t region, std::span<const Index> vertices,
           const Positions& x);

  struct Stage {
    struct Track {
      std::string strategy;
      std::size_t region = 0;
      std::vector<IterationRecord> iterations;
      std::vector<double> bandwidths;  // of the vertices
      std::vector<Index> vertices;     // of the scene
      std::vector<Trajectory::State> states;
    };
    std::string phase;
    std::vector<Track> tracks;
  };
  /// All that was recorded so far; cheap to copy.
  using Stages = std::vector<std::shared_ptr<Stage>>;
  const Stages& stages() const { return stages_; }
  /// Positions at the start.
  const Positions& input() const { return input_; }
  const RecordOptions& options() const { return options_; }
  /// Region r of the report becomes number[r], or leaves the history (no_region).
  void renumber(std::span<const std::size_t> number);
  /// Goes back to stages that were taken earlier.
  void restore(Stages stages) { stages_ = std::move(stages); }

  /// Bandwidths are those of the scene's vertices.
  std::vector<RegionHistory> history() const;

 private:
  /// Memory for the states of one region's trajectory (unit: bytes)
  static constexpr std::size_t trajectory_budget = std::size_t{256} << 20;
  /// Memory for the states of all trajectories together (unit: bytes)
  static constexpr std::size_t total_budget = std::size_t{512} << 20;

  void thin_out();

  RecordOptions options_;
  Positions input_;
  Stages stages_;
  std::size_t bytes_ = 0;  // of all states, forgotten ones included
  int stride_ = 1;         // every stride-th iteration of a track is kept, and its end
};

}  // namespace unsnarl
