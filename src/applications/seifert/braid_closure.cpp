#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "geometry/portable_math.h"
#include "geometry/types.h"
#include "unsnarl/link.h"

namespace unsnarl {
namespace {

constexpr double first_radius = 1;   ///< Radius of the innermost strand (unit: length)
constexpr double radius_step = 0.5;  ///< Distance between strands (unit: length)
/// Each strand lies this much lower than the next inner one (unit: length)
constexpr double height_step = 0.5;
/// Either strand rises or sinks by this where two cross (unit: length)
constexpr double crossing_rise = 0.2;

/// Columns of generators that do not touch each other: each as early as those before it allow.
std::vector<std::vector<int>> columns_of(int strands, std::span<const int> braid) {
  std::vector<std::vector<int>> columns;
  std::vector<std::size_t> free_from(strands + 1, 0);
  for (const int generator : braid) {
    const int i = std::abs(generator);
    const std::size_t column = std::max(free_from[i - 1], free_from[i]);
    if (column == columns.size()) columns.emplace_back();
    columns[column].push_back(generator);
    free_from[i - 1] = free_from[i] = column + 1;
  }
  if (columns.empty()) columns.emplace_back();
  return columns;
}

}  // namespace

Link braid_closure(int strands, std::span<const int> braid, int points) {
  if (strands < 1) throw std::invalid_argument(fmt::format("a braid of {} strands; give 1 or more", strands));
  if (points < 2 || points > 1000) throw std::invalid_argument(fmt::format("{} points; give 2 to 1000", points));
  for (std::size_t k = 0; k < braid.size(); ++k)
    if (braid[k] == 0 || braid[k] <= -strands || braid[k] >= strands)
      throw std::invalid_argument(
          fmt::format("generator {} of the braid is {}; with {} strands they are 1 to {}, or "
                      "negative",
                      k + 1, braid[k], strands, strands - 1));
  std::vector<std::vector<int>> columns = columns_of(strands, braid);
  while (columns.size() < 3) columns.emplace_back();  // polygons around the axis need corners
  const double angle_step = 2 * std::numbers::pi / static_cast<double>(columns.size());
  Link link;
  std::vector<bool> seen(strands, false);
  for (int start = 0; start < strands; ++start) {
    if (seen[start]) continue;
    std::vector<double>& p = link.components.emplace_back();
    int place = start;
    do {
      seen[place] = true;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        int step = 0, rises = 0;
        for (const int generator : columns[c]) {
          const int i = std::abs(generator) - 1;  // the places i and i + 1 change
          if (place != i && place != i + 1) continue;
          step = place == i ? 1 : -1;
          rises = (place == i) == (generator > 0) ? 1 : -1;
        }
        for (int k = 0; k < points; ++k) {
          const double t = (k + 0.5) / points;  // not where strands cross, where both would have a point
          const double angle = angle_step * (static_cast<double>(c) + t);
          const double at = place + step * t * t * (3 - 2 * t);
          const double s = portable::sin(std::numbers::pi * t);
          const double r = first_radius + radius_step * at;
          p.insert(p.end(), {r * portable::cos(angle), r * portable::sin(angle),
                             rises * crossing_rise * s * s - height_step * at});
        }
        place += step;
      }
    } while (place != start);
  }
  return link;
}

}  // namespace unsnarl
