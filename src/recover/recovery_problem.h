#pragma once

#include <functional>
#include <span>
#include <vector>

#include "optimize/newton.h"
#include "recover/contact_list.h"
#include "recover/objective.h"
#include "recover/step_filter.h"
#include "scene/patch.h"

namespace unsnarl {

/// The objective of the recovery over the vertices that move, for Newton's method. Trial steps are filtered by
/// continuous collision detection, vertex by vertex: vertices that would collide go as far as is safe, the others all
/// the way.
class RecoveryProblem final : public NewtonProblem {
 public:
  /// h: the patch's edge length. tolerated_pairs: for the trajectory. All must outlive this.
  RecoveryProblem(Patch& patch, ContactRules& rules, const IndexLists& neighbours, Objective& objective,
                  const StepOptions& options, double h, std::size_t tolerated_pairs);

  /// Begins a stage: these vertices move against barriers that set in at `activation`, except those that are closer to
  /// something than round-off. Vertices that `stationary_steps` Newton steps in a row move by less than the length
  /// `stationary` are held. Returns false if no vertex is left to move.
  bool start(std::vector<std::uint8_t> moves, double activation, double stationary, int stationary_steps);
  /// Ends a stage: gives its lists back.
  void finish();
  const MovingVertices& moving() const { return objective_.moving(); }

  Index unknowns() const override { return moving().count(); }
  double linearise(Eigen::Matrix3Xd& gradient) override;
  void apply_hessian(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const override { hessian_.apply(v, result); }
  void inverse_blocks(std::vector<Eigen::Matrix3d>& blocks) const override { hessian_.inverse_blocks(blocks); }
  Eigen::SparseMatrix<double> lower_triangle() const override { return hessian_.lower_triangle(); }
  /// Caps the motion of each connected part of the moving vertices. The translation of a part that nothing touches is
  /// not capped: the part goes as a whole until something is in its way. Faces that would flip slide along instead, as
  /// far as possible. Gathers the contacts that the capped step may meet.
  void limit(Eigen::Matrix3Xd& step) override;
  void filter(Eigen::Matrix3Xd& step) override;
  double value(const Eigen::Matrix3Xd& step) override;
  void accept(const Eigen::Matrix3Xd& step) override;
  /// Holds the vertices that collide at the last trial, whose gaps were used up when the contacts were gathered.
  bool remove_blocked() override;

 private:
  void set_moving(std::vector<std::uint8_t> moves);
  /// Holds stationary vertices, once they are many.
  void hold_stationary();
  bool hold(std::span<const Stencil> stencils);
  void note_iteration();
  /// Writes a step to displacement_, which has a column for every vertex.
  Positions& spread(const Eigen::Matrix3Xd& step);
  /// Reads a step back from displacement_.
  void collect(Eigen::Matrix3Xd& step) const;
  /// Changes the step as little as keeps faces from flipping, as far as slide_sweeps sweeps get.
  void slide_along_flips(Eigen::Matrix3Xd& step);
  /// Per part: whether a contact with something else is active.
  std::vector<std::uint8_t> touched_parts();
  OrientedFaces oriented() const;
  Index part_of(Index v) const { return moving().slot[v] < 0 ? -1 : part_[moving().slot[v]]; }

  Patch& patch_;
  const IndexLists& neighbours_;
  Objective& objective_;
  StepOptions options_;
  double h_;
  std::size_t tolerated_pairs_;
  ContactList contacts_;
  double activation_ = 0, stationary_ = 0;
  int stationary_steps_ = 0;
  std::vector<int> small_steps_;  // per vertex: number of Newton steps in a row that were shorter than stationary_
  Index part_count_ = 0;
  std::vector<Index> part_;  // of each unknown
  Hessian hessian_;
  Positions gradient_, displacement_, trial_;
  bool is_new_state_ = false;  // not in the trajectory yet
  bool has_contacts_ = false;  // the objective has those that are near here, from the trial that led here
};

}  // namespace unsnarl
