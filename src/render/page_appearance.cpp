#include "render/page_appearance.h"

#include <algorithm>
#include <string>

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> wrap_names = {"repeat", "mirror", "clamp"};  // in the order of Appearance::Wrap

/// Gives each pair of a vertex and a place in the image a number of its own: the first of a vertex has the vertex's.
class VertexCopies {
 public:
  explicit VertexCopies(std::size_t vertex_count)
      : has_place_(vertex_count), next_(vertex_count, -1), uv_(2 * vertex_count, 0) {}

  Index number_of(Index vertex, float u, float v) {
    const auto is_at = [&](Index k) { return uv_[2 * at(k)] == u && uv_[2 * at(k) + 1] == v; };
    if (!has_place_[at(vertex)]) {
      has_place_[at(vertex)] = true;
      uv_[2 * at(vertex)] = u;
      uv_[2 * at(vertex) + 1] = v;
      return vertex;
    }
    Index last = vertex;
    for (Index k = vertex; k >= 0; k = next_[at(k)]) {
      if (is_at(k)) return k;
      last = k;
    }
    const auto added = static_cast<Index>(next_.size());
    next_[at(last)] = added;
    next_.push_back(-1);
    uv_.insert(uv_.end(), {u, v});
    copies_.push_back(vertex);
    return added;
  }
  std::vector<Index>& copies() { return copies_; }
  std::vector<float>& uv() { return uv_; }

 private:
  static std::size_t at(Index k) { return static_cast<std::size_t>(k); }
  std::vector<bool> has_place_;
  std::vector<Index> next_;  ///< the next copy of the same vertex; -1: there is none
  std::vector<Index> copies_;
  std::vector<float> uv_;
};

}  // namespace

TextureVertices texture_vertices(const Appearance& appearance, const SurfaceView& surface,
                                 const PageTriangles& triangles) {
  VertexCopies numbers(surface.vertex_count());
  TextureVertices result;
  result.triangles = triangles.corners;
  for (std::size_t t = 0; 3 * t < triangles.corners.size(); ++t) {
    const std::size_t face = triangles.faces.empty() ? t : static_cast<std::size_t>(triangles.faces[t]);
    const std::int32_t material = appearance.material_of_face[face];
    if (material < 0 || appearance.materials[static_cast<std::size_t>(material)].image < 0) continue;
    const std::span<const std::int32_t> corners = surface.face(face);
    const auto first = static_cast<std::size_t>(corners.data() - surface.corners.data());
    for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
      const Index vertex = triangles.corners[k];
      const std::size_t corner =
          first + static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
      result.triangles[k] =
          numbers.number_of(vertex, appearance.uv_of_corner[2 * corner], appearance.uv_of_corner[2 * corner + 1]);
    }
  }
  result.copies = std::move(numbers.copies());
  result.uv = std::move(numbers.uv());
  return result;
}

Json add_appearance(const Appearance& appearance, const SurfaceView& surface, const PageTriangles& triangles,
                    PageElements& elements) {
  Json images = Json::array(), materials = Json::array();
  if (appearance.is_worth_showing()) {
    for (const Appearance::Image& image : appearance.images) {
      elements.add_bytes("image_" + std::to_string(images.size()), image.bytes);
      images.push_back(
          {{"name", image.name}, {"media_type", image.media_type}, {"width", image.width}, {"height", image.height}});
    }
    for (const Appearance::Material& material : appearance.materials)
      materials.push_back({{"colour", material.colour},
                           {"image", material.image},
                           {"alpha_cutoff", material.alpha_cutoff},
                           {"wrap",
                            {wrap_names[static_cast<std::size_t>(material.wrap_u)],
                             wrap_names[static_cast<std::size_t>(material.wrap_v)]}}});
    elements.add_words("face_materials", appearance.material_of_face, 1);
  }
  if (!images.empty()) {
    const TextureVertices vertices = texture_vertices(appearance, surface, triangles);
    if (!vertices.copies.empty()) {
      elements.add_words("texture_triangles", vertices.triangles, 3);
      elements.add_words("texture_copies", vertices.copies, 1);
    }
    elements.add_words("texture_uv", vertices.uv, 2);
  }
  return {{"images", images}, {"materials", materials}, {"notes", appearance.notes}};
}

}  // namespace unsnarl
