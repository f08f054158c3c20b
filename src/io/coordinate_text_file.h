#pragma once

#include "io/mesh_file.h"
#include "io/token_edits.h"
#include "io/vertex_normals.h"

namespace unsnarl {

/// A text file in which every coordinate of a position is a token of its own (OBJ, OFF): moved ones are replaced.
class CoordinateTextFile : public MeshFile {
 public:
  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override {
    TokenEdits edits;
    edit_coordinates(edits, bytes, begins, surface.positions, positions, precision(float32_digits));
    if (recompute_normals && has_vertex_normals())
      edit_coordinates(edits, bytes, normal_begins, normals,
                       turned_normals(surface, as_written(positions, float32_digits), normals, normal_of_corner),
                       TextPrecision::float_digits);
    return {{{}, edits.apply(bytes)}};
  }
  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const override {
    return coordinates_as_written(surface.positions, positions, precision(float32_digits));
  }

  bool has_vertex_normals() const override { return !normals.empty(); }

  std::vector<std::size_t> begins;  ///< where the token of each coordinate starts, 3 a vertex
  std::vector<double> normals;      ///< 3 each; zero where the file has no numbers
  std::vector<std::size_t> normal_begins;
  std::vector<std::int32_t> normal_of_corner;  ///< -1: none

 private:
  static TextPrecision precision(bool float32_digits) {
    return float32_digits ? TextPrecision::float_digits : TextPrecision::double_digits;
  }
};

}  // namespace unsnarl
