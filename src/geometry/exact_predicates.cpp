// The last resort of the predicates, by CGAL's kernel (LGPL). The only file of the product that includes CGAL: the
// kernel switches the rounding mode, which this file alone is compiled for.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

#include "geometry/predicates.h"

namespace unsnarl::detail {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) {
  return {p[0], p[1], p[2]};
}
}  // namespace

Sign orient3d_by_kernel(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (!(a.allFinite() && b.allFinite() && c.allFinite() && d.allFinite())) return 0;
  return static_cast<Sign>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

Sign orient2d_exact(double ax, double ay, double bx, double by, double cx, double cy) {
  using Point = Kernel::Point_2;
  for (const double coordinate : {ax, ay, bx, by, cx, cy})
    if (!std::isfinite(coordinate)) return 0;
  return static_cast<Sign>(CGAL::orientation(Point(ax, ay), Point(bx, by), Point(cx, cy)));
}

}  // namespace unsnarl::detail
