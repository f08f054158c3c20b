// This stands in for CGAL where tests are built without it: the product itself says what a result intersects. Such a
// build leaves out the tests that compare the two.
#include "oracle/intersections_oracle.h"
#include "unsnarl/surface.h"

namespace unsnarl::oracle {

std::vector<IntersectingPair> intersections_by_cgal(std::span<const double> positions,
                                                    std::span<const OracleTriangle> triangles) {
  std::vector<std::int32_t> corners;
  for (const OracleTriangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  FindOptions options;
  options.weld = Weld::none;
  return find_intersections({positions, corners}, options);
}

}  // namespace unsnarl::oracle
