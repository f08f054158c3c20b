#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "applications/seifert/polynomial.h"
#include "geometry/types.h"
#include "unsnarl/link.h"

namespace unsnarl {

using Vec2 = Eigen::Vector2d;

/// A link seen along an axis: where strands cross, and which is on top.
struct LinkDiagram {
  /// Edge k of a component runs from its point k to the next.
  struct Strand {
    Index component = 0, edge = 0;
    double fraction = 0;  ///< of the edge, in (0, 1): where it crosses
  };
  struct Crossing {
    Strand over, under;
    Vec2 place;
    double gap = 0;     ///< between the strands, along the axis
    double radius = 0;  ///< distance from `place` to the nearest other edge, or to an end of either strand
    double band = 0;    ///< half length that a band between the strands may have along either, in the picture
    double beside = 0;  ///< from an end of such a band to the other strand
    int sign = 0;       ///< +1: right-handed
  };
  /// One visit of a crossing.
  struct Pass {
    Index crossing = 0;
    bool over = false;
  };

  Eigen::Matrix3d frame;          ///< rows: the axes; seen from the far end of the third
  std::vector<Positions> points;  ///< one a component, in the frame
  std::vector<Crossing> crossings;
  std::vector<std::vector<Pass>> passes;  ///< one list a component: along it
  Index circles = 0;                      ///< Seifert circles
  bool connected = false;                 ///< the surface of Seifert's algorithm is

  /// Euler characteristic of the surface that Seifert's algorithm makes.
  Index euler_characteristic() const { return circles - static_cast<Index>(crossings.size()); }
};

/// Nothing if the view along the third row of the (orthogonal) frame is not generic: three strands in one place, a
/// vertex on an edge, or strands so near each other that rounding could change which is on top, or what is built
/// between them. Decided by exact arithmetic.
std::optional<LinkDiagram> diagram_of(const Link& link, const Eigen::Matrix3d& frame);

/// Returns the one of `directions` views whose surface is connected and of largest Euler characteristic; of several,
/// the one with most room. The coordinate axes are the first three views. Nothing if no view is generic. stop: asked
/// after each view; true: the best of those seen is enough, once there is one.
std::optional<LinkDiagram> best_diagram(const Link& link, int directions, const std::function<bool()>& stop = {});

/// Room for windings of the surface around an edge, at the narrowest crossing: width times length, an area.
double narrowest_nesting(const LinkDiagram& diagram);

/// Turns a view by smaller and smaller angles, as long as it stays as simple, toward the largest narrowest_nesting().
LinkDiagram roomier_diagram(const Link& link, LinkDiagram diagram, const std::function<bool()>& stop = {});

/// The Alexander polynomial, all variables equal, by Fox calculus on the Wirtinger presentation; without units.
Polynomial alexander_polynomial(const LinkDiagram& diagram);

}  // namespace unsnarl
