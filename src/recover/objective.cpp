#include "recover/objective.h"

#include <algorithm>
#include <utility>

#include "geometry/portable_math.h"

namespace unsnarl {
namespace {

Bending bending_of(const Patch& patch, const EdgeTable& edges, double h) {
  std::vector<BendingHinge> hinges = bending_hinges_of(patch.triangles, edges);
  std::erase_if(hinges, [&](const BendingHinge& hinge) {
    return std::all_of(hinge.begin(), hinge.end(), [&](Index v) { return v >= patch.free_count; });
  });
  Bending::Options options;
  options.edge_length = h;
  return Bending(patch.rest, patch.x, hinges, options);
}

std::vector<VolumeLoss::Surface> closed_surfaces_of(const Patch& patch) {
  std::vector<std::vector<Triangle>> triangles = triangles_of_solids(patch);
  std::vector<VolumeLoss::Surface> surfaces;
  for (std::size_t s = 0; s < triangles.size(); ++s)
    surfaces.push_back({std::move(triangles[s]), patch.solids.list[s].volume, patch.solids.list[s].area});
  return surfaces;
}

}  // namespace

Objective::Objective(const Patch& patch, const EdgeTable& edges, const ObjectiveOptions& options, double h) {
  const std::span<const Triangle> active(patch.triangles.data(), static_cast<std::size_t>(patch.active_count));
  auto& pull = sum_.part<QuadraticPull>().energy;
  pull = {vertex_areas(patch.rest, patch.triangles), patch.rest, 1 / options.time_step};
  double mean_mass = 0;
  for (Index v = 0; v < patch.free_count; ++v) mean_mass += pull.mass[v];
  mean_mass /= std::max<Index>(patch.free_count, 1);
  const double contact_force = options.contact_force * mean_mass * h;

  auto& arap = sum_.part<ArapTriangle>();
  arap.energy = ArapTriangle(patch.rest, active, options.rotation_damping);
  arap.weight = portable::pow(options.arap_length * h, 2);
  auto& bending = sum_.part<Bending>();
  bending.energy = bending_of(patch, edges, h);
  bending.weight = portable::pow(options.bending_length * h, 4);
  auto& orientation = sum_.part<OrientationPenalty>();
  OrientationPenalty::Options flips;
  flips.activation = options.flip_activation;
  orientation.energy = OrientationPenalty(patch.rest, active, flips);
  orientation.weight = flip_weight_ = options.flip_weight * contact_force;
  auto& volumes = sum_.part<VolumeLoss>();
  volumes.energy = VolumeLoss(patch.rest, closed_surfaces_of(patch), options.kept_volume);
  volumes.weight = options.volume_weight;
  sum_.part<IpcBarrier>().weight = contact_force;
}

void Objective::restrict_to(MovingVertices moving) {
  moving_ = std::move(moving);
  sum_.part<QuadraticPull>().elements = moving_.vertices;
  sum_.part<ArapTriangle>().restrict_to(moving_.moves);
  sum_.part<Bending>().restrict_to(moving_.moves);
  sum_.part<OrientationPenalty>().restrict_to(moving_.moves);
  sum_.part<VolumeLoss>().restrict_to(moving_.moves);
}

double Objective::value(const Positions& x) {
  sum_.part<IpcBarrier>().take_all();
  return sum_.value(x);
}

double Objective::linearise(const Positions& x, Positions& gradient, Hessian& hessian) {
  sum_.part<IpcBarrier>().take_all();
  return sum_.linearise(x, moving_.slot, moving_.count(), gradient, hessian);
}

IterationRecord Objective::terms() const {
  IterationRecord record;
  record[EnergyTerm::pull] = sum_.last<QuadraticPull>();
  record[EnergyTerm::arap] = sum_.last<ArapTriangle>();
  record[EnergyTerm::bending] = sum_.last<Bending>();
  record[EnergyTerm::orientation] = sum_.last<OrientationPenalty>();
  record[EnergyTerm::volume] = sum_.last<VolumeLoss>();
  record[EnergyTerm::barrier] = sum_.last<IpcBarrier>();
  return record;
}

}  // namespace unsnarl
