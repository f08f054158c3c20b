#pragma once

#include <functional>

#include "samples/mesh_builder.h"

namespace unsnarl {

/// A map from unit vectors to space.
using DirectionMap = std::function<Vec3(const Vec3& direction)>;

/// The image of the unit sphere under f: 6 n^2 cells of a cube swollen to the sphere, turned so that no vertex lies on
/// a plane of symmetry of the axes.
Surface sample_sphere(int n, FaceKind faces, const DirectionMap& f);

/// The same for an even map, f(-d) = f(d): opposite vertices are one, so that the surface is a projective plane of 3
/// n^2 cells.
Surface sample_projective_plane(int n, FaceKind faces, const DirectionMap& f);

}  // namespace unsnarl
