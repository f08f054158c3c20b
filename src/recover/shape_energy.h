#pragma once

#include <span>
#include <vector>

#include "energy/arap_triangle.h"
#include "energy/bending.h"
#include "energy/orientation_penalty.h"
#include "energy/quadratic_pull.h"
#include "recover/recover.h"
#include "recover/step_operator.h"
#include "scene/patch.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// The vertices of a patch that move in a stage of the recovery.
struct MovingVertices {
  std::vector<std::uint8_t> moves;  ///< per vertex
  std::vector<Index> vertices;      ///< slot -> vertex
  std::vector<Index> slot;          ///< vertex -> slot or -1
};

/// What pulls an embedded patch back to its rest shape, all of the recovery's energy but the contacts:
/// pull + (arap_length h)^2 ARAP + (bending_length h)^4 bending + orientation.
class ShapeEnergy {
 public:
  /// h: the patch's edge length. The patch and the options must outlive this.
  ShapeEnergy(const Patch& patch, const EdgeTable& edges, const IndexLists& triangles_of_vertex,
              const RecoverOptions& options, double h);

  /// From now on sums run over the elements with a moving vertex. `moving` must outlive its use here.
  void restrict_to(const MovingVertices& moving);
  /// Triangles with a moving vertex.
  std::span<const Index> triangles() const { return triangles_; }
  /// Force of a contact: RecoverOptions::contact_force times the mean mass of a vertex and h.
  double contact_force() const { return contact_force_; }
  const IndexLists& neighbours() const { return neighbours_; }
  const OrientationPenalty& orientation() const { return orientation_; }

  double value(const Positions& x) const;
  /// The energy at x. Replaces the gradient, and the operator's strains and rank-one terms by those at x; its sparse
  /// matrix is that of the moving vertices.
  double linearise(const Positions& x, Positions& gradient, StepOperator& step_operator);
  /// The energy by terms, where it was last linearised.
  IterationRecord terms() const;
  /// Sparse matrix of a step: pull and a share of ARAP with the rotations held. Has the pattern of the mesh.
  void build_matrix(StepOperator& step_operator) const;

 private:
  const Patch& patch_;
  const IndexLists& triangles_of_vertex_;
  const RecoverOptions& options_;
  double arap_scale_, bending_scale_;
  double contact_force_ = 0;
  IndexLists neighbours_;

  ArapTriangle arap_;
  Bending bending_;
  QuadraticPull pull_;
  OrientationPenalty orientation_;

  const MovingVertices* moving_ = nullptr;
  std::vector<Index> triangles_, hinges_;  // with a moving vertex
  std::vector<double> energies_;           // of triangles_ and hinges_, where last linearised
  double pull_energy_ = 0, orientation_energy_ = 0;
  ScatteredSum scattered_;
};

}  // namespace unsnarl
