// A program of somebody else: two triangles that run through each other, found and parted.
#include <unsnarl/intersections.h>
#include <unsnarl/repair.h>
#include <unsnarl/version.h>

#include <cstdio>

int main() {
  unsnarl::Surface surface;
  surface.positions = {0,   0,   0,  2,   0,   0,   0,   2,   0,  //
                       0.5, 0.5, -1, 0.6, 0.5, 0.1, 0.5, 0.6, 0.1};
  surface.corners = {0, 1, 2, 3, 4, 5};

  const auto before = unsnarl::find_intersections(surface);
  const unsnarl::RepairResult result = unsnarl::repair(surface);
  surface.positions = result.positions;
  const auto after = unsnarl::find_intersections(surface);

  std::printf("unsnarl %s: %zu pairs before, %zu after\n", unsnarl::version, before.size(), after.size());
  return before.size() == 1 && after.empty() && result.status == unsnarl::Status::embedded ? 0 : 1;
}
