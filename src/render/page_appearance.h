#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "geometry/types.h"
#include "render/page_elements.h"
#include "unsnarl/appearance.h"
#include "unsnarl/surface.h"

namespace unsnarl {

/// The triangles that draw the faces.
struct PageTriangles {
  std::vector<Index> corners;  ///< 3 a triangle
  std::vector<Index> faces;    ///< one entry a triangle; empty: each is a face
};

/// Vertices with texture coordinates: those of the surface, and behind them copies of those that have several.
struct TextureVertices {
  std::vector<Index> triangles;  ///< as PageTriangles::corners
  std::vector<Index> copies;     ///< vertex of the surface that each further one copies
  std::vector<float> uv;         ///< 2 each
};
TextureVertices texture_vertices(const Appearance& appearance, const SurfaceView& surface,
                                 const PageTriangles& triangles);

/// Puts images, materials and texture coordinates into the page; what is said of them comes as JSON.
nlohmann::ordered_json add_appearance(const Appearance& appearance, const SurfaceView& surface,
                                      const PageTriangles& triangles, PageElements& elements);

}  // namespace unsnarl
