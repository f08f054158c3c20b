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
/// meshes end 2 % farther with 8 % more flipped faces, in 7 % less time; with 6, a wig ends a third farther.
constexpr int bisections_back = 5;
/// Share of a region's pairs, without unit, that may be left for a candidate to be kept, or a coarse mesh to be carried
/// to the fine one. With a third, posed bodies end up to 12 % farther; with none, they take 1.3 times as long.
/// A creature of which one region leaves 12 of 100 on the coarse mesh ends at 0.85 % in 67 CPU s where these are
/// carried to the fine mesh, at 0.51 % in 29 s where local strategies begin anew instead.
constexpr double few_left = 0.1;

}  // namespace unsnarl
