#pragma once

#include <array>
#include <span>
#include <vector>

#include "applications/seifert/spanning_start.h"

namespace unsnarl {

/// A flat disc: the polygon through vertices of a mesh, and where they are in its plane.
struct FlatDisc {
  std::vector<Index> corners;
  std::vector<Vec2> outline;
};

bool is_clockwise(const FlatDisc& disc);

/// A regular hexagon in a disc, in which both ends of a handle fit.
struct HandlePlace {
  Index disc = 0;
  Vec2 middle = Vec2(0, 0);
  double radius = 0;
};

/// Places apart from each other, one after the other where discs have most room. The same on every machine.
std::vector<HandlePlace> handle_places(std::span<const FlatDisc> discs, int count);

/// The corners of such a hexagon; its left half is the mirror image of its right one.
std::array<Vec2, 6> hexagon_of(const HandlePlace& place);

/// Fills a hexagon of vertices by a handle: half a ring whose ends are holes in the hexagon's halves. It raises the
/// genus by one and keeps the boundary. A loop along it links only a loop around it, so that the Alexander polynomial
/// stays the same. The ring reaches as far toward `down`, of unit length, as the hexagon is wide. hexagon: as
/// hexagon_of gives them, and in the order in which faces run around.
void add_handle(SpanningMesh& mesh, const std::array<Index, 6>& hexagon, const Vec3& down);

/// The polygon that goes around holes too, along a way to each and back: bridges run between the nearest corners that
/// see each other. Holes run the other way than the outline, and meet neither it nor each other.
void cut_to_holes(FlatDisc& disc, std::vector<FlatDisc> holes);

}  // namespace unsnarl
