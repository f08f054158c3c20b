#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/box.h"
#include "mesh/validity.h"
#include "unsnarl/report.h"
#include "unsnarl/scene_document.h"

namespace unsnarl {
namespace {

/// `diagonal`: of the scene, at the scale.
void measure_motion(std::span<const double> before, std::span<const double> after, const Scale& scale, double diagonal,
                    SceneFileReport& report) {
  const std::size_t begin = report.file.first_vertex, n = report.file.vertices;
  if (n == 0) return;
  std::size_t untouched = 0;
  double sum = 0, largest = 0;
  for (std::size_t v = begin; v < begin + n; ++v) {
    double squared = 0;
    for (std::size_t k = 3 * v; k < 3 * v + 3; ++k) squared += std::pow(scale.in(after[k]) - scale.in(before[k]), 2);
    untouched += std::equal(&before[3 * v], &before[3 * v] + 3, &after[3 * v]);
    sum += std::sqrt(squared);
    largest = std::max(largest, std::sqrt(squared));
  }
  const double unit = diagonal > 0 ? 1 / diagonal : 0;
  report.displacement_mean_rel = sum / static_cast<double>(n) * unit;
  report.displacement_max_rel = largest * unit;
  report.untouched_share = static_cast<double>(untouched) / static_cast<double>(n);
}

}  // namespace

SceneReport scene_report(const SurfaceView& before, std::span<const SceneFile> files,
                         std::span<const IntersectingPair> pairs_before, std::span<const double> after,
                         std::span<const IntersectingPair> pairs_after) {
  if (!after.empty()) require_positions(before, after);
  SceneReport report;
  const Scale scale(before.positions);
  const double diagonal = diagonal_of_box(before.positions, scale);
  for (const SceneFile& file : files) {
    report.files.emplace_back().file = file;
    if (!after.empty()) measure_motion(before.positions, after, scale, diagonal, report.files.back());
  }
  const std::vector<std::int32_t> file_of = file_of_faces(files);
  std::map<std::pair<std::size_t, std::size_t>, ScenePairs> between;
  for (std::size_t i = 0; i < files.size(); ++i) report.pairs.push_back({.a = i, .b = i, .before = {}, .after = {}});
  const auto count = [&](std::span<const IntersectingPair> pairs, PairCounts ScenePairs::*counts) {
    for (const IntersectingPair& pair : pairs) {
      const auto a = static_cast<std::size_t>(file_of[pair.a]), b = static_cast<std::size_t>(file_of[pair.b]);
      ScenePairs& of = a == b ? report.pairs[a] : between[{std::min(a, b), std::max(a, b)}];
      ++(of.*counts)[pair.kind];
    }
  };
  count(pairs_before, &ScenePairs::before);
  count(pairs_after, &ScenePairs::after);
  for (auto& [files_of, pairs] : between) {
    pairs.a = files_of.first;
    pairs.b = files_of.second;
    report.pairs.push_back(pairs);
  }
  return report;
}

}  // namespace unsnarl
