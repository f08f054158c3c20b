#include "report/rigid_report.h"

#include "geometry/box.h"
#include "geometry/scale.h"
#include "rigid/rigid_motion.h"

namespace unsnarl {

void measure_rigid_parts(const SurfaceView& surface, const RepairOptions& options, const RigidParts& parts,
                         std::span<const double> positions, RepairReport& report) {
  const Scale scale(surface.positions);
  const auto point = [&](std::span<const double> all, std::size_t v) {
    return Vec3(scale.in(all[3 * v]), scale.in(all[3 * v + 1]), scale.in(all[3 * v + 2]));
  };
  const double diagonal = diagonal_of_box(surface.positions, scale), unit = diagonal > 0 ? 1 / diagonal : 1;
  for (Index part = 0; part < parts.count; ++part) {
    std::vector<std::size_t> vertices;
    for (std::size_t v = 0; v < options.rigid.size(); ++v)
      if (options.rigid[v] == part) vertices.push_back(v);
    RigidPartReport& entry = report.rigid_parts.emplace_back();
    entry.name = parts.name(part);
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

}  // namespace unsnarl
