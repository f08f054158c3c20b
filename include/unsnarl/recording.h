#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

/// The notes that repair() takes on its way. They never change the result.
struct RecordOptions {
  bool history = false;  ///< the iterations of every region: RepairReport::history
  /// Most frames to keep in RepairResult::frames; 0: none, else >= 2. Where there are more, every second one is left
  /// out, as often as needed. Implies `history`.
  int frames = 0;

  bool any() const { return history || frames > 0; }
};

/// The energies that the solvers minimise.
enum class EnergyTerm : std::uint8_t {
  gaussian,
  minkowski,
  arap,
  bending,
  pull,
  orientation,
  volume,
  barrier,
  count,  ///< no term: how many there are; a new one comes before it
};
inline constexpr auto energy_term_count = static_cast<std::size_t>(EnergyTerm::count);
inline constexpr std::array<std::string_view, energy_term_count> energy_term_names = {
    "gaussian", "minkowski", "arap", "bending", "pull", "orientation", "volume", "barrier"};
static_assert(!energy_term_names.back().empty(), "every EnergyTerm has a name");

/// One iteration: the state reached, and the step that led to it. Of a long try of a strategy those alone at which all
/// pairs were looked for.
struct IterationRecord {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::size_t pairs = 0;  ///< intersecting pairs of triangles left in the region
  double step = 0;        ///< largest motion of a vertex since the iteration before, length
  double min_gap =
      none;  ///< smallest distance within the barrier's reach, length; NaN: nothing is near, or without a barrier
  /// Smallest, mean and largest bandwidth of the Gaussian energy, lengths; NaN but in the paper's untangling.
  std::array<double, 3> bandwidth = {none, none, none};
  /// Weighted terms of the objective, by EnergyTerm; NaN: the method does not have it. Weights and units are the
  /// method's own: compare within a region and phase only.
  std::array<double, energy_term_count> energy = no_energies();

  double& operator[](EnergyTerm term) { return energy[static_cast<std::size_t>(term)]; }
  double operator[](EnergyTerm term) const { return energy[static_cast<std::size_t>(term)]; }

 private:
  static constexpr std::array<double, energy_term_count> no_energies() {
    std::array<double, energy_term_count> energies{};
    for (double& energy : energies) energy = none;
    return energies;
  }
};

/// The iterations that led one region to where it ended, tries that were given up left out.
struct RegionHistory {
  std::string phase;       ///< "untangle", "recover"
  std::string strategy;    ///< untangle: as in RegionReport; recover: empty
  std::size_t region = 0;  ///< untangle: position in RepairReport::regions; recover: number of the area, from 0
  std::vector<IterationRecord> iterations;
  /// In the paper's untangling, at its end: of each vertex of the input its bandwidth, a length, NaN where it could not
  /// move. Else empty.
  std::vector<double> bandwidths;
};

/// The surface at a moment, as what has moved since the frame before. Regions that do not overlap are shown at work at
/// the same time: frame k of a strategy (or of the recovery) has the k-th iteration of each.
struct RecordedFrame {
  std::string phase;                       ///< "input" (the first), "untangle", "recover", "result" (the last)
  std::string strategy;                    ///< untangle: the strategy at work
  int iteration = 0;                       ///< of the regions at work
  std::size_t pairs = 0;                   ///< intersecting pairs of faces, of all classes, that may not stay
  std::size_t allowed = 0;                 ///< and those that the options allow
  std::vector<std::int32_t> intersecting;  ///< ids of the faces in these pairs, ascending
  std::vector<std::int32_t> vertices;      ///< that moved since the frame before, ids of the input, ascending
  std::vector<double> displacements;       ///< 3 a vertex: where they are, minus where they are in the input
};

}  // namespace unsnarl
