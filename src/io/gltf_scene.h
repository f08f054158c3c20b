#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/json_text.h"

namespace unsnarl {

/// An affine map from the space of a mesh to the world, and back. The identity gives exactly what it gets.
class Placement {
 public:
  Placement() = default;
  /// Row-major 3 x 4.
  explicit Placement(const std::array<double, 12>& rows);
  /// The first three rows of a 4 x 4 matrix whose columns follow each other, as glTF stores it.
  template <class Number>
  static Placement of_columns(const std::array<Number, 16>& m) {
    return Placement({m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14]});
  }

  /// Can positions be mapped back?
  bool is_invertible() const { return is_invertible_; }
  std::array<double, 3> to_world(const std::array<double, 3>& local) const;
  std::array<double, 3> to_local(const std::array<double, 3>& world) const;
  Placement operator*(const Placement& inner) const;
  friend bool operator==(const Placement& a, const Placement& b) { return a.rows_ == b.rows_; }

 private:
  std::array<double, 12> rows_{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::array<double, 9> inverse_{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool is_identity_ = true, is_invertible_ = true;
};

/// Placement of a mesh: the first that the default scene gives it.
struct MeshPlace {
  Placement placement;
  std::string node;                 ///< name of the node; empty: the scene does not show the mesh
  std::size_t instances = 0;        ///< nodes of the scene that show it
  std::optional<std::size_t> skin;  ///< none: the mesh is not skinned
  bool was_flat = false;            ///< no node has an invertible transform; the identity stands in
};

struct ScenePlaces {
  std::vector<MeshPlace> of_meshes;                ///< one entry a mesh
  std::vector<std::optional<Placement>> of_nodes;  ///< one entry a node; none: it is not in the default scene
};

/// Throws FileError where the nodes are no forest.
ScenePlaces places_in_scene(const JsonText::Value& root, std::size_t mesh_count);

}  // namespace unsnarl
