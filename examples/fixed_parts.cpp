// Repairs around a part that must not move: the upper of two sheets.
#include <unsnarl/repair.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "crossing_sheets.h"

int main() {
  const unsnarl::Surface surface = crossing_sheets();
  const std::size_t vertices = surface.view().vertex_count(), upper = vertices / 2;

  unsnarl::RepairOptions options;
  options.fixed.assign(vertices, 0);
  std::fill_n(options.fixed.begin(), upper, 1);  // the first half of the vertices: the upper sheet
  options.min_gap_rel = 1e-3;                    // and keep this far from it, as a share of the diagonal

  const unsnarl::RepairResult result = unsnarl::repair(surface, options);
  for (const unsnarl::Obstruction& obstruction : result.report.obstructions)
    std::printf("not repaired: %s\n", obstruction.message.c_str());
  const bool unmoved = std::equal(result.positions.begin(), result.positions.begin() + 3 * static_cast<long>(upper),
                                  surface.positions.begin());
  std::printf("%s; the fixed part is %s; moved by %.2g %% of the diagonal at most\n",
              std::string(to_string(result.status)).c_str(), unmoved ? "as it was" : "elsewhere",
              100 * result.report.displacement_max_rel);
  return result.status == unsnarl::Status::embedded && unmoved ? 0 : 1;
}
