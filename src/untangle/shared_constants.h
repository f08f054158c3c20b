#pragma once

namespace unsnarl {

// Constants that several strategies share. h is the patch's edge length.

/// Length in h: the penalty acts until faces are this far apart. 28 iterations against 61 without.
constexpr double penalty_margin = 0.03;
/// Length in h by which vertices are shifted at the start, to break the symmetry of coincident sheets and exact folds.
/// Other values were not measured.
constexpr double symmetry_jitter = 1e-3;
/// Share of its area before, or at rest, below which a face is squeezed: a candidate with such faces is no solution.
/// Without unit. With 1e-3, one of 40 deep, warped and immersed surfaces stays unresolved and one ends four times as
/// far; 1e-5 and 1e-6 take up to three times as long on two others; with 1e-12 one is pulled into a point, where every
/// step meets all faces.
constexpr double squeezed_area = 1e-4;
/// Bisections of a solution's displacement back to where it began; the smallest clean one is kept. Without them, 98
/// meshes end 2 % farther with 8 % more flipped faces, in 7 % less time.
constexpr int bisections_back = 5;

}  // namespace unsnarl
