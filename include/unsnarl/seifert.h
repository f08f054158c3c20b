#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "unsnarl/link.h"
#include "unsnarl/repair.h"
#include "unsnarl/surface.h"

namespace unsnarl {

struct SeifertOptions {
  /// Edge length of the triangles inside the surface / diagonal of the link's bounding box. [0.001, 0.5]; 0: the mean
  /// edge of the link, but within 1/45 and 1/20 of the diagonal.
  double edge_rel = 0;
  /// Views to look for the simplest diagram among, [3, 10000]: the coordinate axes, then a half sphere evenly.
  int views = 60;
  /// Added to the surface, each of which raises its genus by one, [0, 100].
  int handles = 0;
  bool fair = true;  ///< false: the surface as Seifert's algorithm builds it, walls and flat discs
  double time_limit_s =
      0;  ///< wall-clock seconds after which fairing stops; the surface is embedded all the same; 0: none
};

/// What is to hold of a Seifert surface, found out from the mesh and the link alone: how it was made does not matter.
struct SeifertFindings {
  std::size_t intersecting_pairs = 0;  ///< of faces, by exact arithmetic
  bool oriented = false;               ///< a manifold with boundary whose faces agree on a side
  bool spans_link = false;             ///< its boundary runs along the link and through its very points, bit for bit
  int components = 0;                  ///< of the surface
  int closed_components = 0;           ///< those without a boundary
  int euler_characteristic = 0;
  int genus = 0;  ///< sum over the components
  /// Seifert circles - crossings, in the diagram that the link shows to its best view, - 2 for each handle.
  int expected_euler_characteristic = 0;
  /// The Alexander polynomial, all variables equal, as decimal coefficients from the constant up, without units ±t^k,
  /// the last one positive; empty: zero. That of the surface is det(V - t V'), V the linking numbers of a basis of its
  /// loops with their push-offs; that of the link is found by Fox calculus on a diagram.
  std::vector<std::string> alexander_of_surface, alexander_of_link;
  /// |polynomial of the surface at -1|, in decimal digits.
  std::string determinant = "0";
  /// Of V + V': how many more eigenvalues are positive than negative. -2 for the right-handed trefoil; many tables
  /// count the other way.
  int signature = 0;
  /// The degree of the polynomial is 1 - euler_characteristic (for a knot: twice the genus): no connected surface of
  /// the link has a smaller genus. False: unknown.
  bool genus_is_least = false;

  /// All that a Seifert surface promises.
  bool hold() const {
    return intersecting_pairs == 0 && oriented && spans_link && closed_components == 0 &&
           euler_characteristic == expected_euler_characteristic && alexander_of_surface == alexander_of_link;
  }
};

/// The link that a given surface spans.
struct SpanningBoundary {
  Link link;  ///< the boundary, in the order of its faces, each component from its first vertex on
  std::vector<std::int32_t> vertices;  ///< the vertices of the surface that are these points, in their order
  int euler_characteristic = 0;        ///< of the surface
};
/// Throws std::invalid_argument for a surface that is no oriented manifold of triangles with a boundary.
SpanningBoundary spanning_boundary(const SurfaceView& surface);

/// The findings that do not hold, one line each; empty: all hold.
std::string seifert_faults(const SeifertFindings& findings);

/// Everything by exact arithmetic and integers. The surface must consist of triangles. views, handles: as in
/// SeifertOptions. euler_characteristic: expected instead of that of Seifert's algorithm. Throws std::invalid_argument
/// for a surface that is no triangle mesh, or whose sides 64-bit numbers cannot tell apart, or as check_link does.
SeifertFindings check_seifert_surface(const SurfaceView& surface, const Link& link, int views = 60, int handles = 0,
                                      std::optional<int> euler_characteristic = {});

struct SeifertResult {
  /// embedded; cancelled or time_limit where fairing was stopped: the surface is embedded then too. no_progress: none
  /// was found for which check_seifert_surface says that all holds, since strands are too close for doubles: there is
  /// no surface, and `message` says why.
  Status status = Status::embedded;
  Surface surface;      ///< triangles; the first vertices are the points of the link, component by component
  std::string message;  ///< also where the surface was left as it was built, and why; else empty
  std::size_t crossings = 0, circles = 0;  ///< of the diagram that it was built from
  double area = 0;
  double seconds = 0;
};

/// An oriented surface without self-intersections whose boundary is the link (paper §4.4): built by Seifert's algorithm
/// from the simplest of several views, embedded and with the very points of the link from the start, then remeshed and
/// shrunk to little area without ever running through itself. docs/seifert.md explains how. The same input gives the
/// same bytes on every run (time limits and cancellation aside).
///
/// Throws std::invalid_argument as check_link does, for an option out of range, and for a link that no view tells
/// apart, or whose surface is too thin to be certified.
SeifertResult seifert_surface(const Link& link, const SeifertOptions& options = {}, Context* context = nullptr);

/// The paper's own construction (§4.4, Fig. 10): a surface that may intersect itself is untangled by repair() with its
/// boundary held, then faired as in seifert_surface(). The boundary stays bit for bit, and so does the Euler
/// characteristic; the points of the boundary come first, as spanning_boundary() has them. options.handles must be 0.
/// `crossings` and `circles` stay 0.
///
/// Throws std::invalid_argument as spanning_boundary and check_link do.
SeifertResult untangled_seifert_surface(const SurfaceView& start, const SeifertOptions& options = {},
                                        Context* context = nullptr);

/// A tube around each component of a link, of triangles.
struct KnotTube {
  Surface surface;
  double radius = 0;  ///< 0: none was found, and there is no surface
};
/// The thickest of some radii, from 0.02 of the diagonal of the link down to 5e-6 of it, for which is_clear_tube holds.
/// spanning: a surface of triangles that spans the link. Throws std::invalid_argument as spanning_boundary and
/// check_link do.
KnotTube knot_tube(const Link& link, const SurfaceView& spanning);
/// Whether a tube is closed, does not run through itself, and each of its components meets the surface in one connected
/// set of pairs of faces; contacts in neighbouring faces count as one. By exact arithmetic. Both surfaces are of
/// triangles.
bool is_clear_tube(const SurfaceView& tube, const SurfaceView& spanning);

/// "1 - 3t + t^2" of such coefficients.
std::string polynomial_text(std::span<const std::string> coefficients);

}  // namespace unsnarl
