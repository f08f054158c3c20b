#pragma once

#include <array>

#include "io/mesh_file.h"
#include "io/number_array.h"
#include "io/surface_builder.h"
#include "io/token_edits.h"

namespace unsnarl {

/// A number in a text.
struct NumberToken {
  std::size_t begin = 0;
  std::uint32_t length = 0;
};

/// Vertices whose positions lie behind each other in one array of numbers.
struct PointBlock {
  NumberArray array;
  std::size_t first_vertex = 0, count = 0;
  std::size_t vertex_step = 0, coordinate_step = 0;  ///< in bytes, of binary numbers
  double divisor = 1;                                ///< of stored integers
  std::vector<NumberToken> tokens;                   ///< of text, 3 a vertex
};

/// A file whose positions are numbers in arrays, as text, in binary, encoded or in files beside it. Where they are
/// encoded, the arrays with moved vertices are encoded anew; all else stays.
class PointFile : public MeshFile {
 public:
  /// Distances between numbers of an array, in numbers. {1, n} where the file has all x, then all y, then all z.
  struct Layout {
    std::size_t vertex = 3, coordinate = 1;
  };
  enum class Missing : std::uint8_t { refused, marked_by_nan };

  /// Appends the vertices of an array. `end`, where given, becomes the place after the last number (of text). Throws
  /// FileError unless all are finite; a vertex marked by NaN, where that is usual, is kept out of the surface with its
  /// faces.
  void add_points(NumberArray array, Layout layout, Missing missing = Missing::refused, std::size_t* end = nullptr);
  /// Appends one that is already described, in binary and with steps in bytes.
  void add_binary_points(PointBlock block, Missing missing = Missing::refused);
  /// Appends one vertex of a text with numbers of 64 bits.
  void add_point(const std::array<double, 3>& position, const std::array<NumberToken, 3>& tokens);
  /// To be called after the last vertex and face.
  void finish();

  /// Adds a face by the 0-based ids of its vertices, unless one is missing; after all points. What is wrong with it, to
  /// follow "face 7"; empty: nothing.
  std::string add_face(std::span<const std::int64_t> face);
  /// The same for a strip of triangles; those without three different vertices only lead to the next ones.
  std::string add_strip(std::span<const std::int64_t> strip);

  std::size_t vertex_count() const { return surface.positions.size() / 3; }
  std::size_t face_count() const { return faces_.count(); }

  std::vector<OutputFile> patched(std::span<const double> positions, bool float32_digits) const override;
  std::vector<double> as_written(std::span<const double> positions, bool float32_digits) const override;

  /// All files beside this one that numbers may lie in, each once.
  std::vector<std::shared_ptr<const ExternalFile>> external_files;

 protected:
  /// patched() with more changes of the main file.
  std::vector<OutputFile> patched_with(std::vector<TextEdit> edits, std::span<const double> positions,
                                       bool float32_digits) const;
  /// Adds what follows from other edits.
  virtual void add_consequences(std::vector<TextEdit>& edits) const { static_cast<void>(edits); }

 private:
  bool is_missing(std::size_t vertex) const { return vertex < missing_.size() && missing_[vertex]; }
  static TextPrecision precision(const NumberArray& array, bool float32_digits);
  void mark_missing(std::size_t vertex);
  void place_missing(std::vector<double>& positions) const;
  void patch_text(const PointBlock& block, std::span<const double> written, std::span<const double> positions,
                  bool float32_digits, std::vector<TextEdit>& edits) const;
  void patch_binary(const PointBlock& block, std::span<const double> written, char* data) const;
  bool has_moved(const PointBlock& block, std::span<const double> written) const;

  std::vector<PointBlock> blocks_;
  std::vector<bool> missing_;  ///< empty: none
  FaceCollector faces_{surface};
  std::vector<std::int32_t> face_;
  std::size_t faces_left_out_ = 0;
};

}  // namespace unsnarl
