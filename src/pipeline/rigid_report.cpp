#include "pipeline/rigid_report.h"

#include "geometry/box.h"
#include "geometry/sort_unique.h"
#include "rigid/bodies.h"

namespace unsnarl {

std::string name_of_rigid_part(const RepairOptions& options, Index part) {
  const auto p = static_cast<std::size_t>(part);
  return p < options.rigid_names.size() ? options.rigid_names[p] : std::to_string(part);
}

void measure_rigid_parts(const SurfaceView& surface, const RepairOptions& options, Index part_count,
                         std::span<const double> positions, RepairReport& report) {
  const Scale scale(surface.positions);
  const auto point = [&](std::span<const double> all, std::size_t v) {
    return Vec3(scale.in(all[3 * v]), scale.in(all[3 * v + 1]), scale.in(all[3 * v + 2]));
  };
  const double diagonal = diagonal_of_box(surface.positions, scale), unit = diagonal > 0 ? 1 / diagonal : 1;
  for (Index part = 0; part < part_count; ++part) {
    std::vector<std::size_t> vertices;
    for (std::size_t v = 0; v < options.rigid.size(); ++v)
      if (options.rigid[v] == part) vertices.push_back(v);
    RigidPartReport& entry = report.rigid_parts.emplace_back();
    entry.name = name_of_rigid_part(options, part);
    entry.vertices = vertices.size();
    if (vertices.empty()) continue;
    Positions from(3, static_cast<Index>(vertices.size())), to = from;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      from.col(static_cast<Index>(k)) = point(surface.positions, vertices[k]);
      to.col(static_cast<Index>(k)) = point(positions, vertices[k]);
    }
    const RigidMotion motion = best_rigid_motion(from, to);
    for (int k = 0; k < 9; ++k) entry.rotation[k] = motion.rotation(k / 3, k % 3);
    for (int k = 0; k < 3; ++k) entry.translation[k] = scale.out(motion.translation[k]);
    entry.rotation_deg = motion.degrees();
    entry.translation_rel = (to.rowwise().mean() - from.rowwise().mean()).norm() * unit;
    if (from == to) continue;
    const Positions carried = (motion.rotation * from).colwise() + motion.translation;
    entry.residual_rel = (to - carried).colwise().norm().maxCoeff() * unit;
  }
}

void begin_with_input(const SurfaceView& surface, std::span<const double> placed,
                      std::span<const IntersectingPair> pairs, std::vector<RecordedFrame>& frames) {
  RecordedFrame placement = frames.front(), input = frames.front();
  placement.phase = "untangle";
  placement.strategy = "place";
  for (std::size_t v = 0; v < surface.vertex_count(); ++v) {
    const Vec3 d = Eigen::Map<const Vec3>(&placed[3 * v]) - Eigen::Map<const Vec3>(&surface.positions[3 * v]);
    if (d == Vec3::Zero()) continue;
    placement.vertices.push_back(static_cast<std::int32_t>(v));
    placement.displacements.insert(placement.displacements.end(), {d[0], d[1], d[2]});
  }
  if (placement.vertices.empty()) return;
  input.pairs = pairs.size();
  input.intersecting.clear();
  for (const IntersectingPair& pair : pairs) input.intersecting.insert(input.intersecting.end(), {pair.a, pair.b});
  sort_unique(input.intersecting);
  frames.front() = std::move(placement);
  frames.insert(frames.begin(), std::move(input));
}

}  // namespace unsnarl
