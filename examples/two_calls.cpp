// Finds the self-intersections of a surface, and repairs it.
#include <unsnarl/repair.h>

#include <cstdio>

int main() {
  unsnarl::Surface surface;
  surface.positions = {0, 0, 0,  4, 0, 0, 0, 4, 0,   // x y z of vertices 0, 1, 2
                       1, 1, -1, 1, 1, 2, 2, 1, 2};  // 3, 4, 5
  surface.corners = {0, 1, 2, 3, 4, 5};              // two triangles, one through the other

  for (const unsnarl::IntersectingPair& pair : unsnarl::find_intersections(surface))
    std::printf("faces %d and %d intersect\n", pair.a, pair.b);

  const unsnarl::RepairResult result = unsnarl::repair(surface);
  if (result.status != unsnarl::Status::embedded) return 1;
  surface.positions = result.positions;
  std::printf("%zu pairs left\n", unsnarl::find_intersections(surface).size());
}
