// What CONTRIBUTING.md promises of its energy: the objective has it, with a gradient, and recordings name it.
#include <cmath>
#include <cstdio>

#include "recover/objective.h"
#include "scene/shapes.h"

int main() {
  using namespace unsnarl;
  if (energy_term_names[static_cast<std::size_t>(EnergyTerm::targets)] != "targets") return std::puts("no name"), 1;
  Patch patch = shapes::patch_of(shapes::bumpy_sheet(4, 0.2));
  Objective objective(patch, build_edges(patch.triangles), {}, 1);
  objective.restrict_to(MovingVertices(std::vector<std::uint8_t>(static_cast<std::size_t>(patch.x.cols()), 1)));
  Positions gradient(3, patch.x.cols()), other = gradient, x = patch.x;
  Hessian hessian;
  objective.linearise(x, gradient, hessian);
  if (objective.terms()[EnergyTerm::targets] != 0) return std::puts("not at rest"), 1;
  x(0, 0) += 0.1;
  const double value = objective.linearise(x, gradient, hessian);
  if (!(objective.terms()[EnergyTerm::targets] > 0)) return std::puts("no energy"), 1;
  x(0, 0) += 1e-6;
  const double slope = (objective.linearise(x, other, hessian) - value) / 1e-6;
  if (!(std::abs(slope - gradient(0, 0)) < 1e-3 * std::abs(slope))) return std::puts("not its gradient"), 1;
}
