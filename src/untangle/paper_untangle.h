#pragma once

#include <cstddef>
#include <functional>

#include "scene/patch.h"

namespace unsnarl {

/// Bandwidths of the Gaussian energy, for the ablation of the paper's §5.6.
enum class BandwidthScope {
  global,  ///< one eps, the stationary one of highest energy (§3.1.3)
  local,   ///< one eps a vertex, symmetric model (II) (§3.1.4)
};

/// What is minimised where triangles meet, for the comparison of §3.2.
enum class MeshEnergy { penetration_depth, intersection_length };

/// The untangling phase as the paper describes it (§3.1-3.3, §3.5), so that its experiments can be repeated; the
/// default configuration is escalate() instead. Works on a copy scaled to unit size (§3.5.5):
/// lengths below are in units of the patch's largest extent, or of its mean edge where they say so. Where the paper
/// names no value, the one here is ours.
struct PaperOptions {
  BandwidthScope scope = BandwidthScope::local;
  bool adaptive = true;        ///< bandwidths follow the geometry; false: frozen at the start's
  double bandwidth_scale = 1;  ///< the Gaussian's bandwidths, in those found (Fig. 14)
  MeshEnergy mesh_energy = MeshEnergy::penetration_depth;
  double lambda_gaussian = 1;  ///< 0: without
  /// Of the mesh energy; 0: without. Large weights lock sheets against each other before they have come apart: of 16
  /// coarse samples 13, 14, 15, 13, 8 and 1 came clean with 0.01, 0.03, 0.1, 0.3, 1 and 10 (docs/ablations.md).
  double lambda_minkowski = 0.1;
  double lambda_arap = 1;         ///< weak on purpose (§5.8): recovery follows
  double damping = 0.25;          ///< theta (§3.1.5)
  int bandwidth_iterations = 50;  ///< at the start; one an iteration afterwards, where adaptive
  double start_bandwidth = 2;     ///< mean edges
  double largest_bandwidth = 4;   ///< mean edges: without a bound, the truncation below sets it on flat areas
  double neighbourhood = 2.5;     ///< bandwidths beyond which pairs are left out (§3.5.4)
  int area_refresh = 10;          ///< iterations until the vertex areas are computed anew (§3.5.3)
  int memory = 8;                 ///< of L-BFGS
  int max_iterations = 3000;      ///< the paper's slowest variant has a median of 1504
};

struct PaperResult {
  bool clean = false;  ///< no two faces that share no vertex intersect: the paper's criterion
  int iterations = 0;
  int evaluations = 0;
  std::size_t disjoint_left = 0;
  double mean_bandwidth = 0;  ///< length, at the end
};

/// Minimises lambda_G E_G + lambda_M E_M + lambda_reg E_ARAP over the free vertices by plain L-BFGS with Armijo
/// backtracking from alpha = 1, starting from patch.rest; ends as soon as no disjoint pair is left. patch.x is the last
/// iterate.
PaperResult paper_untangle(Patch& patch, const PaperOptions& options = {}, const std::function<bool()>& stop = {});

}  // namespace unsnarl
