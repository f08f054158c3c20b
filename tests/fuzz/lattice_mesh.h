#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "fuzz/targets.h"
#include "unsnarl/intersections.h"
#include "unsnarl/surface.h"

namespace unsnarl::fuzz {

/// Takes numbers from bytes; zeros once they have run out.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  bool is_empty() const { return bytes_.empty(); }
  int below(int n) {
    if (bytes_.empty()) return 0;
    const int value = bytes_.front() % n;
    bytes_ = bytes_.subspan(1);
    return value;
  }

 private:
  Bytes bytes_;
};

/// A mesh with tiny whole numbers for coordinates: there touching, coplanar, folded, duplicate and zero-area faces are
/// the rule and not the exception. Its surface is the same, scaled by a power of two, so that nothing is rounded.
struct LatticeMesh {
  std::vector<std::int64_t> coordinates;
  Surface surface;
  FindOptions find;

  struct Limits {
    int vertices, faces, largest_exponent;  ///< of the scale
  };
  /// Any bytes mean a mesh.
  LatticeMesh(ByteReader& bytes, const Limits& limits) {
    const int size = 2 + bytes.below(7);
    const int exponent =
        bytes.below(4) == 0 ? bytes.below(2 * limits.largest_exponent + 1) - limits.largest_exponent : 0;
    find.threads = 1;
    find.weld = static_cast<Weld>(bytes.below(3));
    const bool polygons = bytes.below(4) == 0;
    const int vertices = 3 + bytes.below(limits.vertices - 2);
    for (int i = 0; i < 3 * vertices; ++i) {
      coordinates.push_back(bytes.below(size));
      surface.positions.push_back(std::ldexp(static_cast<double>(coordinates.back()), exponent));
    }
    if (polygons) surface.offsets.push_back(0);
    for (int f = 0; f < limits.faces && !bytes.is_empty(); ++f) {
      const int corners = polygons ? 3 + bytes.below(3) : 3;
      for (int k = 0; k < corners; ++k) surface.corners.push_back(bytes.below(vertices));
      if (polygons) surface.offsets.push_back(static_cast<std::int32_t>(surface.corners.size()));
    }
  }
};

}  // namespace unsnarl::fuzz
