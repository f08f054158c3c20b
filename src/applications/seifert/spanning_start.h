#pragma once

#include <stdexcept>
#include <vector>

#include "applications/seifert/link_diagram.h"

namespace unsnarl {

/// A triangle mesh. The first vertices are the points of a link, component by component.
struct SpanningMesh {
  std::vector<Vec3> x;
  std::vector<Triangle> faces;
};

/// Thrown where strands are so close that in doubles the surfaces built around them cannot be told apart.
struct NoSpanningStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Seifert's surface of a diagram, embedded by the way it is built, and with the very points of the link as its
/// boundary (H. Seifert, "Über das Geschlecht von Knoten", 1934).
///
/// - A collar hangs down from the link, a little way.
/// - At a crossing its lower rims, which run through it straight, are joined by two triangles: a band with half a
/// twist.
/// - What is left of the rims are the Seifert circles. From each a wall hangs straight down to a flat disc below the
///   link, at a height of its own: the deeper a circle lies within others, the higher. Walls stand over the circles,
///   which do not meet in the picture, and the discs of the circles around one pass below its own.
///
/// step: between the heights of discs, > 0. handles: hung from the lowest disc. Throws NoSpanningStart; what it returns
/// can intersect itself where strands are close to each other by so little that rounding decides.
SpanningMesh spanning_start(const Link& link, const LinkDiagram& diagram, double step, int handles = 0);

}  // namespace unsnarl
