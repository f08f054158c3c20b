#pragma once

#include <cstddef>

namespace unsnarl {

// Constants that several strategies share. h is the patch's edge length.

/// Share of its area before, or at rest, below which a face is squeezed: a candidate with such faces is no solution.
/// Without unit. With 1e-3, one of 40 deep, warped and immersed surfaces stays unresolved and one ends four times as
/// far; 1e-5 and 1e-6 take up to three times as long on two others; with 1e-12 one is pulled into a point, where every
/// step meets all faces.
constexpr double squeezed_area = 1e-4;
/// Share of a region's pairs, without unit, that may be left for a candidate to be kept, or a coarse mesh to be carried
/// to the fine one. With a third, posed bodies end up to 12 % farther; with none, they take 1.3 times as long.
/// A creature of which one region leaves 12 of 100 on the coarse mesh ends at 0.85 % in 67 CPU s where these are
/// carried to the fine mesh, at 0.51 % in 29 s where local strategies begin anew instead.
constexpr double few_left = 0.1;
/// Share of a region's pairs, without unit, that the best candidate of a tier may leave to be kept; a coarse mesh on
/// its way back that has more is given up, and after one that ends with no more no coarser one is tried (a tenth in
/// place of this: a layered cloth that keeps 45 of 195 pairs goes by a second one and has no end in 565 s, not 201).
/// With 1, a soup of crossings takes a tier for every pair, and two of 24 random warps take 21 and 16 s, not 2 and 13;
/// given up at a tenth, a posed body ends twice as far.
constexpr double few_enough_to_keep = 0.7;
/// Number of faces, at most, of components that are placed, where each try takes an exact test of them all, of the
/// first coarse mesh of whole components, and of coarse meshes, with those of obstacles, on the way back on which far
/// parts are tried again and layers are parted crossing by crossing. Far parts: on 21 meshes it takes 3 % more time,
/// with 8000 8 %, and they end as close; twenty others take 2 and 9 %, and end 4 and 5 % closer. Layers: on none, one
/// of 24 warps ends 8.6 times as far; on all, layered cloth takes a quarter more time (docs/experiments.md).
constexpr std::size_t most_faces_of_small = 4000;  // faces

}  // namespace unsnarl
