#pragma once

#include <functional>
#include <string>
#include <vector>

#include "applications/routes/moving_obstacles.h"
#include "applications/routes/segments.h"

namespace unsnarl {

struct TimeSearchSettings {
  Index steps = 1;             ///< All time has so many of equal length (unit: steps)
  std::vector<double> stride;  ///< of each agent: the longest way in one step (length)
  double cell = 1;             ///< Width of a cell of an agent's grid (unit: radius of the agent)
  std::function<bool()> stopped = [] { return false; };
};

/// Where an agent is at each step, and which of these places it has to keep: it is at its start, at a way-point or at
/// its goal.
struct TimedWay {
  std::vector<Vec3> points;
  std::vector<std::uint8_t> pinned;
};

/// A way in time for each agent, past all obstacles and past the agents that chose before: Safe Interval Path Planning
/// (M. Phillips, M. Likhachev, 2011) on a grid through the agent's start, with a straight move from any node to the
/// next place where that is clear. Agents choose by their priority, then the one with the longest way first. One that
/// finds no way, or a long detour only, chooses before all others of its priority, leaves later, and the search begins
/// anew. Empty: nothing was found; `failed` is then the agent that found no way last.
std::vector<TimedWay> search_in_time(const RoutePlan& plan, const ObstacleTriangles& still,
                                     const std::vector<MovingObstacle>& moving, const TimeSearchSettings& settings,
                                     int& failed);

}  // namespace unsnarl
