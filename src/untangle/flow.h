#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>

#include "scene/patch.h"
#include "unsnarl/intersections.h"

namespace unsnarl {

/// How a strategy of the flow decides which parts of the surface repel each other.
enum class FlowWeights {
  ratio,      ///< parts much farther apart along the surface than through space
  adjacency,  ///< all but adjacent ones (paper §3.5.2); inflates flat areas by 1.2 to 1.9
};

/// One way to run the shape-level untangling (paper §3.3, eq. (11)):
///   E = lambda_gaussian E_G + lambda_minkowski h E_M + lambda_arap E_ARAP, every term length squared,
/// by L-BFGS in the metric 2 lambda_arap (L + locality A/S): L the Laplacian of ARAP's weights, A/S the vertices'
/// shares of the area. (Trefoil tube: 226 pairs left after 299 iterations in the plain metric, none after 9 in this
/// one.)
struct FlowSettings {
  std::string_view name;
  int max_iterations = 200;  ///< of L-BFGS; most that succeed take 10 to 70
  /// Large: forces stay local; 1: they move whole limbs.
  double locality = 30;
  FlowWeights weights = FlowWeights::ratio;
  /// Parts repel where geodesic distance > ratio * distance. 1.8 leaves flat and mildly bent areas alone; pinches and
  /// cross-caps need about 1.1.
  double ratio = 1.8;
  double ratio_sharpness = 1.5;  ///< full repulsion from ratio * this on
  double lambda_gaussian = 1;
  /// At the start; it grows on stalls. Large early values lock sheets against each other: with lambda_gaussian = 0.3,
  /// 1 solved 15 of 21 meshes, 4 only 10.
  double lambda_minkowski = 1;
  double lambda_arap = 1;
  double margin = 0.03;  ///< h: the penalty acts until faces are this far apart; 28 iterations against 61 without
  bool adaptive_bandwidth = true;  ///< clusters' bandwidths follow the symmetric local model (II); false: frozen
  double hot_range = 4;            ///< bandwidths: only clusters this close to an intersecting face interact
  double max_spacing_rel = 0.06;   ///< of the diagonal: how coarse the clusters may get on stalls
  double minkowski_growth = 3;     ///< factor on a stall with few pairs left
  /// Stalls after which the strategy gives up where it has taken away next to nothing. Gentle strategies do nothing at
  /// all to a deep immersion: 96 iterations and 3 s each without this.
  int hopeless_stalls = 3;
  /// Instead of all this: the boundary recedes along the surface (Recession), then the contour method. For surfaces
  /// that nothing short of moving the boundary through them can part: punctured projective planes and Klein bottles.
  bool recedes = false;
};

/// Constants that all strategies share.
struct FlowOptions {
  double spacing_edges = 2;      ///< h: least spacing of the clusters ...
  double spacing_rel = 0.012;    ///< ... and of the diagonal: steps and clusters must not shrink with h on fine meshes
  double start_bandwidth = 2;    ///< spacings
  double least_bandwidth = 1;    ///< spacings
  double largest_bandwidth = 3;  ///< spacings
  double cutoff = 2.2;           ///< bandwidths: exp(-4.8) = 0.8 % of the force at 0 is left out
  double vertex_trim = 0.1;      ///< of the shared corner of one-vertex pairs: took 52, 18, 6 of them to 0
  double jitter = 1e-3;          ///< h: breaks the symmetry of exactly coincident sheets
  double accept_motion = 0.02;   ///< h: the line search stops halving here and takes the step: E_M is not smooth
  int memory = 8;                ///< of L-BFGS
  int stall_iterations = 12;     ///< without ...
  double stall_drop = 0.15;      ///< ... this relative drop of the number of pairs: something must change
  double hopeless_share = 0.8;   ///< of the pairs: a strategy that never got below by its last allowed stall gives up
  double few_pairs = 0.1;        ///< of the initial number: then the penalty grows, else the clusters
  double spacing_growth = 1.6;   ///< of the clusters, on a stall with many pairs left
  double largest_minkowski =
      100;  ///< the strategy ends where it would have to grow further: from there on sheets only lock
  /// From this share of the initial pairs on (and from few_finish pairs on), the local contour method tries to take
  /// away the rest: it clears in a few steps what the flow would still chase after 100 iterations. Again when they have
  /// halved.
  double finish_share = 0.05;
  double stalled_share = 0.5;   ///< on a stall, and at the end of a strategy, already from this share on
  std::size_t few_finish = 12;  ///< pairs
  int finish_iterations = 25;   ///< of the contour method; it needs 4 or never gets there
  double finish_step = 0.3;     ///< h
  std::array<double, 3> finish_localities = {8, 4, 16};  ///< h, in this order
  /// Shares of the way to the spine that a receding boundary is tried at, in this order. First clean for a punctured
  /// Boy's surface 0.3, Klein bottle 0.5, Roman surface 0.5, cross-cap 0.7, a patch of Henneberg's surface 0.8.
  std::array<double, 7> recession_shares = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  int recession_iterations = 120;  ///< of the contour method; the last ones to succeed needed 111
  /// Step and locality of that method, of the diagonal, at least finish_step and 4 h: fine meshes must go as far as
  /// coarse ones. All shares are tried with the first before the second.
  struct Stride {
    double step_rel, locality_rel;
  };
  /// Both as shares of the diagonal.
  std::array<Stride, 2> recession_strides = {{{0.009, 0.12}, {0.02, 0.28}}};
  double recession_area = 0.02;   ///< of its area at rest: with thinner faces than this, further shares are tried
  double area_floor = 1e-3;       ///< of its area at rest: thinner faces are no solution
  int bisections = 5;             ///< of the displacement back to rest; the smallest clean one is kept
  double candidate_reach = 0.25;  ///< h: motion until the candidate pairs are gathered anew
};

/// The variants of the default configuration, those that move least first.
std::span<const FlowSettings> flow_variants();

struct FlowResult {
  bool clean = false;  ///< no active triangle intersects another (but for the tolerated pairs), none is squeezed
  int iterations = 0;
  std::size_t pairs_left = 0;  ///< in patch.x
  std::string_view strategy;
};

/// Moves the free vertices of patch.x, starting from patch.rest, until the exact detector finds no pair of any class on
/// the active triangles. Fixed vertices and obstacles repel but stand still. Pairs of faces on the same three vertices
/// and `tolerated` pairs (sorted, of patch triangles) are let be. Where it fails, patch.x is the state with the fewest
/// pairs. `stop` is asked once an iteration; true ends the flow as a failure.
FlowResult flow(Patch& patch, const FlowSettings& strategy, const std::function<bool()>& stop = {},
                std::span<const IntersectingPair> tolerated = {}, const FlowOptions& options = {});

}  // namespace unsnarl
