#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace unsnarl {

/// How a file wants its faces to look, for views alone: base colours, and images on the faces.
struct Appearance {
  struct Image {
    std::string name;        ///< for the reader
    std::string media_type;  ///< "image/png" or "image/jpeg"
    std::string bytes;       ///< of the image file, as it is stored
    std::size_t width = 0, height = 0;
  };
  enum class Wrap : std::uint8_t { repeat, mirror, clamp };
  struct Material {
    std::array<float, 3> colour = {1, 1, 1};  ///< sRGB, [0, 1]; times the colour of the image, where there is one
    std::int32_t image = -1;                  ///< index into images; -1: none
    float alpha_cutoff = 0;  ///< [0, 1]; points where the image has a smaller alpha are holes; 0: none are
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;

    friend bool operator==(const Material&, const Material&) = default;
  };

  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<std::int32_t> material_of_face;  ///< one entry a face: index into materials, or -1; empty: -1 for all
  /// u to the right and v downwards from the upper left corner of the image, in units of its sides: two numbers a
  /// corner of the surface; empty where there are no images.
  std::vector<float> uv_of_corner;
  std::vector<std::string> notes;  ///< what could not be taken, one sentence each

  /// Is there an image, or more than one colour?
  bool is_worth_showing() const;
};

/// Bytes of all images of an Appearance together, as they are stored, unless a caller says otherwise. In a page they
/// are a third more.
inline constexpr std::size_t most_image_bytes = 32'000'000;
/// Pixels of one image: 400 MB for the moment in which a browser decodes it.
inline constexpr std::size_t most_image_pixels = 100'000'000;

}  // namespace unsnarl
