#pragma once

#include <atomic>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/job.h"
#include "pipeline/triangulations.h"
#include "scene/finders.h"
#include "scene/patch.h"
#include "scene/scene.h"
#include "scene/scene_index.h"
#include "untangle/escalation.h"

namespace unsnarl {

/// Repairs the scene of a surface: untangles it, recovers it and rounds it, again where rounding brought intersections.
/// The job must outlive it.
class SceneRepair {
 public:
  /// `scene` is at rest; `pairs` are those of its triangles, of which `ignored` (sorted) are let be.
  SceneRepair(const Job& job, Scene scene, std::vector<IntersectingPair> pairs, std::vector<IntersectingPair> ignored);

  // Finders are of the triangles of the scene at that time; keep_within_displacement() takes those of the input's cut.

  const Scene& scene() const { return scene_; }
  /// Finders of the triangles of the scene as it is now; of no use once take() has changed them.
  Finders make_finders() const { return Finders(scene_.triangles, job_.prepared.scale, scene_.groups()); }
  /// Nothing but what is let be intersects, and no face has lost its area.
  bool is_resolved(Finders& finders) const;
  /// At rest, is there anything to do?
  bool has_work(Finders& finders) const;
  /// Where float32 was not asked for and rounding to it lets no way hold, float64 has to do.
  void work(Finders& finders);
  /// Opens faces that are folded together closer than RepairOptions::min_dihedral_deg.
  void open_dihedrals(Finders& finders);
  /// Where the work ended between: makes of the positions those that will be read back.
  void round() { scene_.x = as_written(scene_.x); }
  /// Puts what was moved farther than allowed back to rest.
  void keep_within_displacement(IntersectionFinder& finder);

  /// float32 is to hold.
  bool float32() const { return float32_; }
  /// Smallest gap met while contacts were listed, or infinity.
  double smallest_gap() const { return smallest_gap_; }
  /// Something could not be resolved within the displacement that is allowed.
  bool displacement_is_exceeded() const { return displacement_is_exceeded_; }

  // For polygons, which may be cut anew (settle_triangulation).

  /// Makes the scene one of these triangles, where it is now.
  void take(const UnitedTriangulations& cuts);
  /// From now on lets be what no motion parts, or need not. Returns all pairs of components that are not let be.
  std::vector<IntersectingPair> ignore_inseparable_pairs(Finders& finders);
  /// From now on lets the components be on which something is left. Returns whether there are any besides those before.
  bool tolerate_what_is_left(Finders& finders);
  void restore_to_rest(std::span<const Index> vertices);

  /// A state to go back to, with the same triangles or others.
  struct Checkpoint {
    Positions x;
    std::size_t regions;
    Recorder::Stages recorded;
    double smallest_gap;
  };
  Checkpoint checkpoint() const { return {scene_.x, job_.regions.size(), job_.recorder.stages(), smallest_gap_}; }
  void restore(const Checkpoint& checkpoint);

 private:
  struct Rounds {
    bool resolved = false;
    std::optional<Checkpoint> before_rounding;  // the last state without pairs, but of what is stuck
  };
  Rounds work_in_rounds(Finders& finders);

  bool chooses_float32() const;
  bool may_give_up_float32() const { return float32_ && !job_.options.precision; }
  double wanted_gap(std::span<const Index> vertices) const;
  Positions as_written(const Positions& x) const;
  std::vector<IntersectingPair> float32_conflicts(Finders& finders, const Positions& x) const;
  bool has_moved(Index t, const Positions& x) const;
  bool can_be_separated(const IntersectingPair& pair) const;
  Index component_of(Index t) const { return job_.diagnosis.components.component_of_vertex[scene_.triangles[t][0]]; }
  /// Components on which something but what is let be intersects or a face has lost its area; ascending.
  std::vector<Index> components_with_rest(Finders& finders) const;

  EscalationOptions escalation_options();
  EscalationResult untangle(SceneIndex& index, std::span<const IntersectingPair> ignored,
                            const EscalationOptions& escalation);
  /// Pushes the surfaces that cross, of those that are to lie inside each other, into this order.
  void push_into_nesting(SceneIndex& index, EscalationResult& untangled);
  /// Says of each region how deep it was and how far it went.
  void measure_regions(EscalationResult& untangled) const;
  /// `left`: pairs of triangles that could not be untangled.
  double recover(const std::vector<std::vector<Index>>& regions, std::span<const IntersectingPair> left,
                 SceneIndex& index);
  /// A candidate by itself.
  void recover(Patch& patch) const;
  bool stays_near(Patch& patch);
  /// pairs_now: how many triangles' pairs there are with what is being tried; not given: `left` is all.
  void report_progress(double fraction, std::span<const IntersectingPair> left, std::optional<double> pairs_now = {});

  const Job& job_;
  Scene scene_;
  std::vector<IntersectingPair> pairs_, ignored_;
  std::vector<std::uint8_t> is_tolerated_;  // per component: what is left of it stays as it is
  bool float32_;
  std::vector<std::vector<Index>> moved_;  // what regions freed
  double smallest_gap_ = std::numeric_limits<double>::infinity();
  std::atomic<bool> displacement_is_exceeded_{false};
};

}  // namespace unsnarl
