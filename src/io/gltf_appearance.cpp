#include "io/gltf_appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "geometry/portable_math.h"
#include "io/base64.h"
#include "io/image_collector.h"
#include "io/linked_file.h"
#include "io/uri.h"

namespace unsnarl {
namespace {

using Value = JsonText::Value;

/// glTF 2.0, section 5.26; any other value repeats.
enum SamplerWrap : std::size_t { clamp_to_edge = 33071, mirrored_repeat = 33648 };

/// Points of blended materials that are less opaque than this are holes (unit: alpha)
constexpr float cutoff_of_blended = 0.5f;

double number(const Value& value, double otherwise) {
  return value.number().value_or(otherwise);
}
double element(const Value& array, std::size_t i, double otherwise) {
  const std::vector<Value> elements = array.elements();
  return i < elements.size() ? number(elements[i], otherwise) : otherwise;
}

/// From linear light (IEC 61966-2-1).
float to_srgb(double linear) {
  constexpr double linear_up_to = 0.0031308;  ///< Darker values are multiplied by the slope (fixed by sRGB)
  constexpr double slope = 12.92;             ///< Slope of the linear part (fixed by sRGB)
  constexpr double gamma = 2.4;               ///< Exponent of the curved part (fixed by sRGB)
  constexpr double offset = 0.055;            ///< Offset of the curved part (fixed by sRGB)
  constexpr double factor = 1.055;            ///< Factor of the curved part (fixed by sRGB)
  const double x = std::isfinite(linear) ? std::clamp(linear, 0.0, 1.0) : 1.0;
  return static_cast<float>(x <= linear_up_to ? slope * x : factor * portable::pow(x, 1 / gamma) - offset);
}

/// The transform of texture coordinates that a texture info asks for (KHR_texture_transform): uv -> offset +
/// rotation(scale uv).
struct TextureTransform {
  std::array<double, 2> offset = {0, 0}, scale = {1, 1};
  double rotation = 0;

  explicit TextureTransform(const Value& extension) {
    for (std::size_t k = 0; k < 2; ++k) {
      offset[k] = element(extension["offset"], k, 0);
      scale[k] = element(extension["scale"], k, 1);
    }
    rotation = number(extension["rotation"], 0);
  }
  std::array<float, 2> of(const std::array<float, 2>& uv) const {
    const double c = portable::cos(rotation), s = portable::sin(rotation), u = scale[0] * uv[0], v = scale[1] * uv[1];
    return {static_cast<float>(offset[0] + c * u + s * v), static_cast<float>(offset[1] - s * u + c * v)};
  }
};

class AppearanceReader {
 public:
  AppearanceReader(const Value& root, const GltfBuffers& buffers, const std::filesystem::path& folder, std::size_t room)
      : buffers_(buffers),
        accessors_(root, buffers),
        materials_(root["materials"].elements()),
        textures_(root["textures"].elements()),
        images_(root["images"].elements()),
        samplers_(root["samplers"].elements()),
        views_(root["bufferViews"].elements()),
        folder_(folder),
        collector_(result_, room) {}

  Appearance read(const std::vector<GltfPart>& parts, const SurfaceView& surface) {
    result_.material_of_face.assign(surface.face_count(), -1);
    result_.uv_of_corner.assign(2 * surface.corners.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      const std::size_t end = p + 1 < parts.size() ? parts[p + 1].first_face : surface.face_count();
      const std::optional<std::size_t> id = parts[p].material.index();
      if (!id || *id >= materials_.size()) continue;
      const std::int32_t material = material_number(*id);
      std::fill(result_.material_of_face.begin() + static_cast<std::ptrdiff_t>(parts[p].first_face),
                result_.material_of_face.begin() + static_cast<std::ptrdiff_t>(end), material);
      if (result_.materials[static_cast<std::size_t>(material)].image >= 0)
        read_coordinates(parts[p], end, texture_info(materials_[*id]), surface);
    }
    if (result_.images.empty()) result_.uv_of_corner.clear();
    return std::move(result_);
  }

 private:
  static Value base_texture_or_factor(const Value& material, const char* of_roughness, const char* of_glossiness) {
    const Value glossy = material["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    const Value found = material["pbrMetallicRoughness"][of_roughness];
    return found || !glossy ? found : glossy[of_glossiness];
  }
  static Value texture_info(const Value& material) {
    return base_texture_or_factor(material, "baseColorTexture", "diffuseTexture");
  }

  std::int32_t material_number(std::size_t id) {
    const auto [entry, is_new] = numbers_.try_emplace(id, static_cast<std::int32_t>(result_.materials.size()));
    if (is_new) result_.materials.push_back(material(materials_[id]));
    return entry->second;
  }

  Appearance::Material material(const Value& json) {
    Appearance::Material result;
    const Value factor = base_texture_or_factor(json, "baseColorFactor", "diffuseFactor");
    for (std::size_t k = 0; k < 3; ++k) result.colour[k] = to_srgb(element(factor, k, 1));
    const std::optional<std::size_t> id = texture_info(json)["index"].index();
    if (!id || *id >= textures_.size()) return result;
    const Value& texture = textures_[*id];
    result.image = image_of(texture);
    const std::string mode = json["alphaMode"].string();
    if (mode == "MASK")
      result.alpha_cutoff = static_cast<float>(std::clamp(number(json["alphaCutoff"], 0.5), 0.0, 1.0));
    if (mode == "BLEND") result.alpha_cutoff = cutoff_of_blended;
    const std::optional<std::size_t> sampler = texture["sampler"].index();
    if (sampler && *sampler < samplers_.size()) {
      result.wrap_u = wrap(samplers_[*sampler]["wrapS"]);
      result.wrap_v = wrap(samplers_[*sampler]["wrapT"]);
    }
    return result;
  }

  static Appearance::Wrap wrap(const Value& value) {
    const std::optional<std::size_t> mode = value.index();
    return mode == clamp_to_edge     ? Appearance::Wrap::clamp
           : mode == mirrored_repeat ? Appearance::Wrap::mirror
                                     : Appearance::Wrap::repeat;
  }

  std::int32_t image_of(const Value& texture) {
    Value source = texture["source"];
    for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu"})
      if (!source) source = texture["extensions"][extension]["source"];  // the collector says that it is not read
    const std::optional<std::size_t> id = source.index();
    if (!id || *id >= images_.size()) return -1;
    const Value& image = images_[*id];
    const std::string uri = image["uri"].string();
    std::string name = image["name"].string();
    if (name.empty() && !uri.starts_with("data:")) name = uri;
    return collector_.add(name.empty() ? fmt::to_string(*id) : fmt::format("{} ({})", *id, name), [&] {
      if (!uri.empty()) return image_at(uri);
      return image_in_view(image);
    });
  }

  std::string image_at(const std::string& uri) const {
    if (!uri.starts_with("data:")) return collector_.read_beside(folder_, named_path(percent_decoded(uri)));
    const std::size_t start = data_uri_start(uri);
    if (start == std::string::npos) throw FileError("its data: URI is not base64");
    collector_.require_room((uri.size() - start) / 4 * 3);
    std::optional<std::string> bytes = base64_decoded(std::string_view(uri).substr(start));
    if (!bytes) throw FileError("its data: URI is not valid base64");
    return *std::move(bytes);
  }

  std::string image_in_view(const Value& image) const {
    const std::size_t id = member_index(image, "bufferView", views_.size(), "image");
    if (id >= views_.size()) throw FileError("it has neither a uri nor a bufferView of the file");
    const std::string where = fmt::format("bufferView {}", id);
    const std::string_view data = buffers_.data(
        buffers_.resolve(member_index(views_[id], "buffer", std::numeric_limits<std::size_t>::max(), where)));
    const std::size_t begin = member_index(views_[id], "byteOffset", 0, where);
    const std::size_t size = member_index(views_[id], "byteLength", 0, where);
    if (begin > data.size() || size > data.size() - begin) throw FileError(where + " reaches beyond its buffer");
    collector_.require_room(size);
    return std::string(data.substr(begin, size));
  }

  void read_coordinates(const GltfPart& part, std::size_t end_face, const Value& info, const SurfaceView& surface) {
    const Value extension = info["extensions"]["KHR_texture_transform"];
    const TextureTransform transform(extension);
    const std::size_t set = extension["texCoord"].index().value_or(info["texCoord"].index().value_or(0));
    const std::string semantic = fmt::format("TEXCOORD_{}", set);
    try {
      const std::optional<std::size_t> id = part.attributes[semantic].index();
      if (!id) throw FileError(semantic + " is missing");
      const AccessorLayout layout = accessors_.texture_coordinates(*id, semantic);
      if (layout.count < part.vertices) throw FileError(semantic + " has fewer elements than POSITION");
      // A surface of glTF has triangles alone.
      for (std::size_t c = 3 * part.first_face; c < 3 * end_face; ++c) {
        const auto vertex = static_cast<std::size_t>(surface.corners[c]) - part.first_vertex;
        const std::array<float, 2> uv = transform.of(accessors_.texture_coordinate(layout, vertex));
        for (std::size_t k = 0; k < 2; ++k) result_.uv_of_corner[2 * c + k] = std::isfinite(uv[k]) ? uv[k] : 0;
      }
    } catch (const FileError& error) {
      if (complaints_.insert(error.what()).second)
        result_.notes.push_back(fmt::format("Images cannot be placed on some faces: {}.", error.what()));
    }
  }

  const GltfBuffers& buffers_;
  const GltfAccessors accessors_;
  const std::vector<Value> materials_, textures_, images_, samplers_, views_;
  const std::filesystem::path& folder_;
  Appearance result_;
  ImageCollector collector_;
  std::map<std::size_t, std::int32_t> numbers_;  ///< of the file's materials in the result
  std::set<std::string> complaints_;
};

}  // namespace

Appearance gltf_appearance(const Value& root, const GltfBuffers& buffers, const std::vector<GltfPart>& parts,
                           const SurfaceView& surface, const std::filesystem::path& folder, std::size_t room) {
  return AppearanceReader(root, buffers, folder, room).read(parts, surface);
}

}  // namespace unsnarl
