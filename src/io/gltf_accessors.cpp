#include "io/gltf_accessors.h"

#include <fmt/format.h>

#include <limits>

#include "io/byte_order.h"

namespace unsnarl {
namespace {

using Value = JsonText::Value;

enum ComponentType : std::size_t { unsigned_byte = 5121, unsigned_short = 5123, unsigned_int = 5125, single = 5126 };
/// A larger stride of a buffer view is refused (unit: bytes)
constexpr std::size_t largest_stride = 1u << 20;

}  // namespace

std::size_t member_index(const Value& of, const char* key, std::size_t otherwise, const std::string& where) {
  const Value value = of[key];
  if (!value) return otherwise;
  const std::optional<std::size_t> result = value.index();
  if (!result) throw FileError(fmt::format("{}: '{}' is not a whole number; the file is damaged", where, key));
  return *result;
}

namespace {

template <std::size_t N>
std::array<float, N> load_floats(std::string_view data, std::size_t offset) {
  std::array<float, N> result{};
  for (std::size_t k = 0; k < N; ++k) result[k] = load<float>(data.data() + offset + 4 * k, std::endian::little);
  return result;
}

}  // namespace

std::array<float, 3> load_position(std::string_view data, std::size_t offset) {
  return load_floats<3>(data, offset);
}

std::array<float, 16> load_matrix(std::string_view data, std::size_t offset) {
  return load_floats<16>(data, offset);
}

GltfAccessors::GltfAccessors(const Value& root, const GltfBuffers& buffers)
    : accessors_(root["accessors"].elements()), views_(root["bufferViews"].elements()), buffers_(&buffers) {}

AccessorLayout GltfAccessors::positions(std::size_t id, const std::string& user) const {
  const std::string name = fmt::format("{}: accessor {}", user, id);
  AccessorLayout result = layout(id, "VEC3", name);
  if (result.component_type != single) {
    throw FileError(name +
                    " is quantised (KHR_mesh_quantization), which is not supported; "
                    "convert the positions to 32-bit floats first");
  }
  result.element_size = position_size;
  locate(result, id, name);
  return result;
}

AccessorLayout GltfAccessors::matrices(std::size_t id, const std::string& user) const {
  const std::string name = fmt::format("{}: accessor {}", user, id);
  AccessorLayout result = layout(id, "MAT4", name);
  if (result.component_type != single) throw FileError(name + ": matrices should be of 32-bit floats");
  result.element_size = matrix_size;
  locate(result, id, name);
  return result;
}

AccessorLayout GltfAccessors::indices(std::size_t id, const std::string& user) const {
  const std::string name = fmt::format("{}: accessor {}", user, id);
  AccessorLayout result = layout(id, "SCALAR", name);
  result.element_size = result.component_type == unsigned_byte    ? 1
                        : result.component_type == unsigned_short ? 2
                        : result.component_type == unsigned_int   ? 4
                                                                  : 0;
  if (result.element_size == 0) throw FileError(name + ": indices should be unsigned integers; the file is damaged");
  locate(result, id, name);
  return result;
}

std::size_t GltfAccessors::index(const AccessorLayout& indices, std::size_t i) const {
  const char* at = buffers_->data(indices.buffer).data() + indices.start + i * indices.stride;
  switch (indices.component_type) {
    case unsigned_byte: return load<std::uint8_t>(at, std::endian::little);
    case unsigned_short: return load<std::uint16_t>(at, std::endian::little);
    default: return load<std::uint32_t>(at, std::endian::little);
  }
}

AccessorLayout GltfAccessors::texture_coordinates(std::size_t id, const std::string& user) const {
  const std::string name = fmt::format("{}: accessor {}", user, id);
  AccessorLayout result = layout(id, "VEC2", name);
  result.element_size = result.component_type == single           ? 8
                        : result.component_type == unsigned_short ? 4
                        : result.component_type == unsigned_byte  ? 2
                                                                  : 0;
  if (result.element_size == 0) throw FileError(name + ": texture coordinates of this type are not supported");
  locate(result, id, name);
  return result;
}

std::array<float, 2> GltfAccessors::texture_coordinate(const AccessorLayout& coordinates, std::size_t i) const {
  const std::string_view data = buffers_->data(coordinates.buffer);
  const std::size_t at = coordinates.start + i * coordinates.stride;
  const auto both = [&]<class T>(T largest) -> std::array<float, 2> {
    const auto one = [&](std::size_t k) {
      return static_cast<float>(load<T>(data.data() + at + k * sizeof(T), std::endian::little)) / largest;
    };
    return {static_cast<float>(one(0)), static_cast<float>(one(1))};
  };
  switch (coordinates.component_type) {
    case unsigned_byte: return both(std::uint8_t{255});
    case unsigned_short: return both(std::uint16_t{65535});
    default: return load_floats<2>(data, at);
  }
}

/// The accessor's own properties.
AccessorLayout GltfAccessors::layout(std::size_t id, std::string_view type, const std::string& name) const {
  if (id >= accessors_.size()) {
    throw FileError(fmt::format("{} does not exist, the file has {}; it is damaged", name, accessors_.size()));
  }
  const Value& accessor = accessors_[id];
  if (accessor["sparse"]) throw FileError(name + " is sparse, which is not supported; store it in full");
  if (accessor["type"].string() != type) {
    throw FileError(fmt::format("{} should be of type {}; the file is damaged", name, type));
  }
  AccessorLayout result;
  result.component_type = member_index(accessor, "componentType", 0, name);
  result.count = member_index(accessor, "count", 0, name);
  return result;
}

/// Places of its elements, by its view and buffer; all of them are there.
void GltfAccessors::locate(AccessorLayout& layout, std::size_t id, const std::string& name) const {
  const Value& accessor = accessors_[id];
  if (!accessor["bufferView"]) {
    throw FileError(name + " has no bufferView; geometry that an extension stores elsewhere is not supported");
  }
  const std::size_t view_id = member_index(accessor, "bufferView", 0, name);
  if (view_id >= views_.size()) {
    throw FileError(fmt::format("{}: bufferView {} does not exist; it is damaged", name, view_id));
  }
  const Value& view = views_[view_id];
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (view["extensions"][extension]) {
      throw FileError(
          fmt::format("{}: compressed with {}, which is not supported; decompress the file first, or export it "
                      "without compression",
                      name, extension));
    }
  }
  layout.buffer = buffers_->resolve(member_index(view, "buffer", std::numeric_limits<std::size_t>::max(), name));
  layout.stride = member_index(view, "byteStride", layout.element_size, name);
  if (layout.stride < layout.element_size || layout.stride > largest_stride) {
    throw FileError(fmt::format("{}: a byteStride of {} is impossible; the file is damaged", name, layout.stride));
  }
  const std::size_t view_start = member_index(view, "byteOffset", 0, name);
  const std::size_t view_size = member_index(view, "byteLength", 0, name);
  const std::size_t start = member_index(accessor, "byteOffset", 0, name);
  const std::size_t available = buffers_->data(layout.buffer).size();
  if (view_start > available || view_size > available - view_start) {
    throw FileError(
        fmt::format("{}: bufferView {} reaches beyond its buffer of {} bytes; the file is cut short or damaged", name,
                    view_id, available));
  }
  if (layout.count > 0 && (start > view_size || view_size - start < layout.element_size ||
                           (view_size - start - layout.element_size) / layout.stride < layout.count - 1)) {
    throw FileError(
        fmt::format("{}: {} elements do not fit into bufferView {} of {} bytes; the file is cut short or damaged", name,
                    layout.count, view_id, view_size));
  }
  layout.start = view_start + start;
}

}  // namespace unsnarl
