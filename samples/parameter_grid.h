#pragma once

#include <functional>

#include "samples/mesh_builder.h"

namespace unsnarl {

/// How the two ends of a parameter interval meet. `mirrored` (u only): (u_max, v) is (u_min, v_min + v_max - v), as on
/// a Möbius band (v open) or a Klein bottle (v closed).
enum class Seam { open, closed, mirrored };

struct ParameterRange {
  double minimum = 0, maximum = 1;
  int steps = 8;
  Seam seam = Seam::open;
  /// Closed and mirrored ranges: fraction of a step by which the samples are moved, so that they miss the symmetry
  /// lines on which double curves like to lie.
  double shift = 0.37;

  double step() const { return (maximum - minimum) / steps; }
};

/// A rectangle of parameters cut into cells; ends that meet share their vertices.
struct ParameterGrid {
  ParameterRange u, v;
  FaceKind faces = FaceKind::triangles;
  /// Which cells (by their centre) are part of the surface; empty: all.
  std::function<bool(double u, double v)> keep = {};
};

/// The surface f over the grid, its front where df/dv x df/du points. A mirrored u with a closed v moves the samples of
/// v by half a step, whatever v.shift says, as the mirror image of a sample has to be a sample.
Surface sample_grid(const ParameterGrid& grid, const std::function<Vec3(double u, double v)>& f);

/// Steps, at least `minimum`, such that cells are about as long as one of `reference` steps over `reference_length`.
int steps_for(double length, int reference, double reference_length, int minimum = 3);

}  // namespace unsnarl
