#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace unsnarl {

enum class PlyScalar : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
constexpr std::size_t size_of(PlyScalar type) {
  /// Sizes of the types of numbers, in the order of PlyScalar (fixed by the format, in bytes)
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(PlyScalar type) {
  return type != PlyScalar::float32 && type != PlyScalar::float64;
}
double load_scalar(const char* from, PlyScalar type, std::endian order);

struct PlyProperty {
  std::string name;
  PlyScalar type = PlyScalar::float32;
  std::optional<PlyScalar> count_type;  ///< set: a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// The number of a property.
  std::optional<std::size_t> find(std::string_view property) const;
  /// Bytes that every record takes at least (lists being empty).
  std::size_t smallest_record() const;
};

struct PlyHeader {
  bool ascii = false;
  std::endian order = std::endian::little;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes, including the end of its last line
};

/// Reads the description of the body of a PLY file. Throws FileError, naming the line.
PlyHeader parse_ply_header(std::string_view text);

}  // namespace unsnarl
