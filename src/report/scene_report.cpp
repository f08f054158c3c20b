#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/box.h"
#include "geometry/portable_math.h"
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
    for (std::size_t k = 3 * v; k < 3 * v + 3; ++k)
      squared += portable::pow(scale.in(after[k]) - scale.in(before[k]), 2);
    untouched += std::equal(&before[3 * v], &before[3 * v] + 3, &after[3 * v]);
    sum += std::sqrt(squared);
    largest = std::max(largest, std::sqrt(squared));
  }
  const double unit = diagonal > 0 ? 1 / diagonal : 0;
  report.displacement_mean_rel = sum / static_cast<double>(n) * unit;
  report.displacement_max_rel = largest * unit;
  report.untouched_share = static_cast<double>(untouched) / static_cast<double>(n);
}

/// Adds pairs of faces to the counts of their files; pairs between two files come after those within, in their order.
void count(std::span<const IntersectingPair> pairs, PairCounts ScenePairs::*counts, SceneReport& report) {
  std::vector<SceneFile> files;
  for (const SceneFileReport& file : report.files) files.push_back(file.file);
  const std::vector<std::int32_t> file_of = file_of_faces(files);
  const auto within = report.pairs.begin() + static_cast<std::ptrdiff_t>(files.size());
  std::map<std::pair<std::size_t, std::size_t>, ScenePairs> between;
  for (auto it = within; it != report.pairs.end(); ++it) between[{it->a, it->b}] = *it;
  for (const IntersectingPair& pair : pairs) {
    const auto a = static_cast<std::size_t>(file_of[pair.a]), b = static_cast<std::size_t>(file_of[pair.b]);
    ScenePairs& of = a == b ? report.pairs[a] : between[{std::min(a, b), std::max(a, b)}];
    ++(of.*counts)[pair.kind];
  }
  report.pairs.erase(within, report.pairs.end());
  for (auto& [files_of, of] : between) {
    of.a = files_of.first;
    of.b = files_of.second;
    report.pairs.push_back(of);
  }
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
  for (std::size_t i = 0; i < files.size(); ++i) {
    ScenePairs& within = report.pairs.emplace_back();
    within.a = within.b = i;
  }
  count(pairs_before, &ScenePairs::before, report);
  count(pairs_after, &ScenePairs::after, report);
  return report;
}

void count_allowed_pairs(std::span<const IntersectingPair> before, std::span<const IntersectingPair> after,
                         SceneReport& report) {
  count(before, &ScenePairs::allowed_before, report);
  count(after, &ScenePairs::allowed_after, report);
}

}  // namespace unsnarl
