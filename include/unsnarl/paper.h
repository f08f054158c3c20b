#pragma once

#include <cstdint>
#include <string_view>

namespace unsnarl {

/// Bandwidths eps of the Gaussian self-contact energy: Table 2 of Minarčík, Liu, Crane, Li: *Untangling Surfaces via
/// Shape and Mesh Repulsion*. Its model (III), one a pair, diverges and is not offered.
enum class PaperBandwidth : std::uint8_t {
  global,       ///< one eps, the stationary one of highest energy (§3.1.3)
  independent,  ///< one eps a vertex, each for its own interactions (model (I))
  symmetric,    ///< one eps a vertex, coupled (§3.1.4, model (II)): the paper's
};

/// The measure of what intersects: penetration depth is the paper's; intersection length is what it argues against
/// (§3.2).
enum class PaperMeshEnergy : std::uint8_t { penetration_depth, intersection_length };

std::string_view to_string(PaperBandwidth bandwidth);  ///< "global", "independent", "symmetric"
std::string_view to_string(PaperMeshEnergy energy);    ///< "depth", "length"

/// The untangling of the paper (§3.1 to 3.3, §3.5): lambda_G E_G + lambda_M E_M + lambda_reg E_ARAP, minimised by
/// L-BFGS at unit scale (§3.5.5) until no two faces that share no vertex intersect. The paper names neither weights nor
/// neighbourhoods, and says that they differ between its datasets: these are ours (docs/ablations.md).
struct PaperOptions {
  PaperBandwidth bandwidth = PaperBandwidth::symmetric;
  bool adaptive = true;        ///< bandwidths follow the surface, one damped step an iteration; false: frozen (§5.6)
  double bandwidth_scale = 1;  ///< the Gaussian's bandwidths, in those found, > 0 (Fig. 14)
  PaperMeshEnergy mesh_energy = PaperMeshEnergy::penetration_depth;
  bool whole_polygons = true;  ///< E_M between convex polygons as they are (§3.2); false: between their triangles
  double lambda_gaussian = 1;  ///< >= 0; 0: without
  /// >= 0; 0: without. Times the mean edge at unit scale: E_M is a length, the other energies are areas, so that one
  /// weight suits meshes coarse and fine. With 0.2, 0.3, 0.4 and 1, 30, 30, 29 and 30 of 30 samples come clean at
  /// resolution 24, and 29, 29, 29 and 27 at 18; all of 12 characters with the first three.
  double lambda_mesh = 0.3;
  /// >= 0. With 0.25, 0.5 and 1, 30, 30 and 27 of 30 samples come clean, by a median motion of 45, 30 and 18 %.
  double lambda_arap = 0.5;
  double damping = 0.25;       ///< theta of the bandwidths' fixed-point steps, in (0, 1] (§3.1.5)
  double start_bandwidth = 2;  ///< in mean edges at a vertex, > 0: where these steps begin
  int start_iterations = 50;   ///< of them before the first iteration, >= 0
  /// In bandwidths, > 0: pairs of vertices farther apart are left out (§3.5.4). On flat areas bandwidths grow until
  /// this bounds them.
  double neighbourhood = 1.5;
  /// Iterations after which vertex areas are taken anew, >= 1 (§3.5.3): what grows repels itself more from then on.
  /// Never anew: 20 of 30 samples clean; every 10, 25, 50, 100: 29, 30, 30, 29.
  int area_refresh = 50;
  int memory = 8;             ///< steps that L-BFGS keeps, >= 1
  int max_iterations = 3000;  ///< >= 0; the paper's slowest variant has a median of 1504
};

}  // namespace unsnarl
