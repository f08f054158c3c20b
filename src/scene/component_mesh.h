#pragma once

#include <span>
#include <utility>
#include <vector>

#include "contact/closed_surface.h"
#include "mesh/components.h"

namespace unsnarl {

/// A component by itself: its triangles over its own vertices.
struct ComponentMesh {
  std::vector<Triangle> triangles;
  Positions x;
  std::vector<Index> vertices;  ///< of each column of x: which vertex of the surface it is; ascending

  /// The same where the surface is now.
  ComponentMesh at(const Positions& surface) const;
};

/// `triangles`: of one component, over the columns of x.
ComponentMesh component_mesh(const Positions& x, std::span<const Triangle> triangles);

/// The triangles of each component, by its number; they may be another cut of the faces than the components know.
std::vector<std::vector<Triangle>> triangles_by_component(std::span<const Triangle> triangles,
                                                          const Components& components);

/// A closed component, asked what is inside.
struct SolidComponent {
  explicit SolidComponent(ComponentMesh component) : mesh(std::move(component)), surface(mesh.triangles) {
    surface.update(mesh.x);
  }
  ComponentMesh mesh;
  ClosedSurface surface;
};

}  // namespace unsnarl
