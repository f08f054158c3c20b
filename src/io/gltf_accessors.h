#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_container.h"
#include "io/json_text.h"

namespace unsnarl {

/// Places of the elements of an accessor.
struct AccessorLayout {
  std::size_t buffer = 0, start = 0, stride = 0, count = 0;
  std::size_t component_type = 0;  ///< as the file writes it
  std::size_t element_size = 0;    ///< bytes

  std::size_t end() const { return count == 0 ? start : start + (count - 1) * stride + element_size; }
};

/// The accessors of a glTF, with their views and buffers. `user` names in messages who needs one; FileError is thrown
/// where an accessor is missing, of another kind, unsupported, or reaches beyond its buffer.
class GltfAccessors {
 public:
  /// Size of a position, three floats (fixed by the format, in bytes)
  static constexpr std::size_t position_size = 3 * sizeof(float);
  /// Size of a matrix, 16 floats (fixed by the format, in bytes)
  static constexpr std::size_t matrix_size = 16 * sizeof(float);

  GltfAccessors() = default;
  /// `root` and `buffers` have to outlive this.
  GltfAccessors(const JsonText::Value& root, const GltfBuffers& buffers);

  /// Three floats an element.
  AccessorLayout positions(std::size_t id, const std::string& user) const;
  /// Sixteen floats an element, a column after the other.
  AccessorLayout matrices(std::size_t id, const std::string& user) const;
  AccessorLayout indices(std::size_t id, const std::string& user) const;
  /// Two floats an element, or whole numbers that stand for [0, 1].
  AccessorLayout texture_coordinates(std::size_t id, const std::string& user) const;
  /// Element i of an accessor of indices.
  std::size_t index(const AccessorLayout& indices, std::size_t i) const;
  /// Element i of an accessor of texture coordinates.
  std::array<float, 2> texture_coordinate(const AccessorLayout& coordinates, std::size_t i) const;

  JsonText::Value json(std::size_t id) const { return accessors_[id]; }

 private:
  AccessorLayout layout(std::size_t id, std::string_view type, const std::string& name) const;
  void locate(AccessorLayout& layout, std::size_t id, const std::string& name) const;

  std::vector<JsonText::Value> accessors_, views_;
  const GltfBuffers* buffers_ = nullptr;
};

/// A member that is a whole number and not negative; `otherwise` where it is missing.
std::size_t member_index(const JsonText::Value& of, const char* key, std::size_t otherwise, const std::string& where);

/// The three floats at `offset`.
std::array<float, 3> load_position(std::string_view data, std::size_t offset);
/// The sixteen floats at `offset`.
std::array<float, 16> load_matrix(std::string_view data, std::size_t offset);

}  // namespace unsnarl
