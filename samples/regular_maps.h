#pragma once

#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// The two triangulations of genus 3 that are regular maps: every face, in each of its six positions, goes to every
/// other by an automorphism (Conder's list: R3.1 and R3.2). Oriented; the vertices are those that occur.

/// Klein's map {3,7}: 24 vertices, 84 edges, 56 faces, 336 automorphisms. Vertices are the vectors of the plane over
/// the field of seven elements but for their sign, not zero, on which PSL(2,7) acts; a face is three of them that add
/// up to zero under some signs, two of them of determinant 1.
std::vector<Triangle> klein_map_faces();

/// Dyck's map {3,8}: 12 vertices, 48 edges, 32 faces, 192 automorphisms. Vertices are three copies (0 to 3, 4 to 7, 8
/// to 11) of the whole numbers modulo 4; a face has one of each, and they add up to 0 or to 1. The group is made of the
/// shifts that keep this sum, the permutations of the copies, and the negation that changes 0 with 1.
std::vector<Triangle> dyck_map_faces();

}  // namespace unsnarl
