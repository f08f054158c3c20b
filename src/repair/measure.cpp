#include "repair/measure.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "geometry/box.h"
#include "mesh/areas.h"

namespace unsnarl {
namespace {

void measure_displacement(std::span<const double> before, std::span<const double> after, RepairReport& report) {
  const std::size_t n = before.size() / 3;
  if (n == 0) return;
  double sum = 0, squares = 0, largest = 0;
  std::size_t untouched = 0;
  for (std::size_t v = 0; v < n; ++v) {
    double squared = 0;
    for (int k = 0; k < 3; ++k) squared += std::pow(after[3 * v + k] - before[3 * v + k], 2);
    bool same = true;
    for (int k = 0; k < 3; ++k) same &= after[3 * v + k] == before[3 * v + k];
    untouched += same;
    sum += std::sqrt(squared);
    squares += squared;
    largest = std::max(largest, std::sqrt(squared));
  }
  const double unit = report.diagonal > 0 ? 1 / report.diagonal : 0;
  report.displacement_mean_rel = sum / static_cast<double>(n) * unit;
  report.displacement_rms_rel = std::sqrt(squares / static_cast<double>(n)) * unit;
  report.displacement_max_rel = largest * unit;
  report.untouched_share = static_cast<double>(untouched) / static_cast<double>(n);
}

/// Sum over closed orientable components of |volume|: after / before - 1 of the component that changed most.
double volume_change(const PreparedSurface& prepared, const Components& components, const Positions& x) {
  std::vector<std::vector<Triangle>> lists(components.count());
  for (std::size_t t = 0; t < prepared.triangles().size(); ++t) {
    const Index c = components.component_of_triangle[t];
    if (components.list[c].closed() && components.list[c].orientable) lists[c].push_back(prepared.triangles()[t]);
  }
  double worst = 0;
  for (const auto& list : lists) {
    if (list.empty()) continue;
    const double before = signed_volume(prepared.rest, list);
    if (before == 0) continue;
    const double change = signed_volume(x, list) / before - 1;
    if (std::abs(change) > std::abs(worst)) worst = change;
  }
  return worst;
}

}  // namespace

double diagonal_of(const SurfaceView& surface) {
  const std::span<const double> x = surface.positions;
  Box box;
  for (std::size_t i = 0; i + 2 < x.size(); i += 3) box.extend(Vec3(x[i], x[i + 1], x[i + 2]));
  return x.empty() ? 0 : box.diagonal();
}

void measure_change(const SurfaceView& surface, const PreparedSurface& prepared, const Diagnosis& diagnosis,
                    std::span<const double> positions, RepairReport& report) {
  report.diagonal = diagonal_of(surface);
  measure_displacement(surface.positions, positions, report);
  const Positions x = prepared.gather(positions);
  const std::span<const Triangle> triangles = prepared.triangles();
  std::vector<std::uint8_t> in_conflict(triangles.size(), 0);
  for (const IntersectingPair& pair : diagnosis.pairs) in_conflict[pair.a] = in_conflict[pair.b] = 1;
  report.turned_triangles = report.turned_triangles_without_conflict = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (area_vector(prepared.rest, triangles[t]).dot(area_vector(x, triangles[t])) >= 0) continue;
    ++report.turned_triangles;
    report.turned_triangles_without_conflict += in_conflict[t] == 0;
  }
  report.volume_change_rel = volume_change(prepared, diagnosis.components, x);
  const double area = total_area(prepared.rest, triangles);
  report.area_change_rel = area > 0 ? total_area(x, triangles) / area - 1 : 0;
}

double resident_memory_mb() {
  long total = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &total, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace unsnarl
