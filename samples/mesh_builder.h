#pragma once

#include <initializer_list>

#include "geometry/types.h"
#include "unsnarl/surface.h"

namespace unsnarl {

enum class FaceKind { triangles, quads };

/// Collects vertices and polygons of one sample. No two calls of add_vertex give the same vertex.
class MeshBuilder {
 public:
  Index add_vertex(const Vec3& position);
  void add_face(std::initializer_list<Index> corners);
  /// A quad, or two triangles along the diagonal a-c (along b-d where `other_diagonal`).
  void add_cell(Index a, Index b, Index c, Index d, FaceKind kind, bool other_diagonal = false);
  /// Adds all of `part` as vertices and faces of its own, moved by `offset`.
  void append(const SurfaceView& part, const Vec3& offset = Vec3::Zero());
  /// Drops the vertices that no face uses, leaving the order of the others, and hands the surface over.
  Surface take();

 private:
  Surface surface_{{}, {}, {0}};
};

}  // namespace unsnarl
