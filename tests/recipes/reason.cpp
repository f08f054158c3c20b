// What CONTRIBUTING.md promises of its reason: such a pair may stay, is called by its name, and others have to go.
#include <cstdio>

#include "scene/diagnose.h"
#include "scene/shapes.h"

int main() {
  using namespace unsnarl;
  const shapes::Shape fold = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  Components components;
  components.list.resize(1);
  components.component_of_vertex.assign(fold.points.size(), 0);
  const PairPolicy policy(components, Goal::all, false);
  const auto reason = policy.reason_to_leave(fold.triangles[0], fold.triangles[1], PairClass::folded);
  if (!reason || to_string(*reason) != "folded" || describe(*reason).empty()) return std::puts("has to go"), 1;
  if (policy.reason_to_leave(fold.triangles[0], fold.triangles[1], PairClass::one_vertex)) return std::puts("stays"), 1;
}
