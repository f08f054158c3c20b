#include "applications/seifert/link_diagram.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "geometry/portable_math.h"
#include "geometry/predicates.h"
#include "mesh/union_find.h"

namespace unsnarl {
namespace {

/// Strands nearer along the axis, and crossings nearer to anything else in the picture, are not told apart: a thousand
/// times what rounding does to rotated points (unit: size of the link)
constexpr double least_room_rel = 1e-12;

/// Half the length of a crossing's band along both strands. Windings of the strand below, from winding_of_band times as
/// far on, stay apart where the two together are below a half (unit: room around the crossing in the picture)
constexpr double band_of_room = 0.3;
/// Both strands together climb by at most this along a band, so that each band stays between its strands (unit: gap
/// between the strands)
constexpr double climb_of_gap = 0.25;
/// Windings around an edge are nested by part of their width, of no less than this: a hundred times what rounding does
/// to points (unit: size of the link)
constexpr double least_nesting_rel = 1e-14;

/// How far a view is turned at first in search of room (unit: tangent of the angle)
constexpr double first_turn = 0.16;
/// How far it is turned at last (unit: tangent of the angle)
constexpr double last_turn = 0.002;

Vec3 point_of(const Link& link, Index component, Index k) {
  const std::vector<double>& p = link.components[component];
  const auto n = static_cast<Index>(p.size() / 3);
  const double* const at = &p[3 * std::size_t(k % n)];
  return {at[0], at[1], at[2]};
}

double distance_to_edge(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - a - t * d).norm();
}

struct FlatEdge {
  Index component = 0, edge = 0, count = 0;  // count: of the component's edges
  Vec2 a, b;
  Vec2 lo, hi;
};

bool are_neighbours(const FlatEdge& e, const FlatEdge& f) {
  return e.component == f.component && ((e.edge + 1) % e.count == f.edge || (f.edge + 1) % e.count == e.edge);
}

std::vector<FlatEdge> edges_of(const LinkDiagram& diagram) {
  std::vector<FlatEdge> edges;
  for (Index c = 0; c < static_cast<Index>(diagram.points.size()); ++c) {
    const auto n = static_cast<Index>(diagram.points[c].cols());
    for (Index k = 0; k < n; ++k) {
      FlatEdge e{c, k, n, diagram.points[c].col(k).head<2>(), diagram.points[c].col((k + 1) % n).head<2>(), {}, {}};
      e.lo = e.a.cwiseMin(e.b);
      e.hi = e.a.cwiseMax(e.b);
      edges.push_back(e);
    }
  }
  return edges;
}

Sign turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return orient2d(a.x(), a.y(), b.x(), b.y(), c.x(), c.y());
}

/// Pairs (i, j), i < j, whose boxes in the picture meet, sorted.
std::vector<std::array<std::size_t, 2>> near_pairs(const std::vector<FlatEdge>& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return edges[i].lo.x() < edges[j].lo.x(); });
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && edges[order[b]].lo.x() <= edges[order[a]].hi.x(); ++b) {
      const FlatEdge &e = edges[order[a]], &f = edges[order[b]];
      if (e.lo.y() <= f.hi.y() && f.lo.y() <= e.hi.y())
        pairs.push_back({std::min(order[a], order[b]), std::max(order[a], order[b])});
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// False: the view is not generic.
bool find_crossings(const Link& link, const std::vector<FlatEdge>& edges, double size, LinkDiagram& diagram) {
  const double room = least_room_rel * size;
  for (const auto& [i, j] : near_pairs(edges)) {
    const FlatEdge &e = edges[i], &f = edges[j];
    if (are_neighbours(e, f)) continue;
    const Sign fa = turn(e.a, e.b, f.a), fb = turn(e.a, e.b, f.b), ea = turn(f.a, f.b, e.a), eb = turn(f.a, f.b, e.b);
    if (fa * fb > 0 || ea * eb > 0) continue;
    if (fa * fb * ea * eb == 0) return false;
    const Vec2 de = e.b - e.a, df = f.b - f.a;
    const double cross = de.x() * df.y() - de.y() * df.x();
    if (cross == 0) return false;
    const Vec2 between = f.a - e.a;
    const double at_e = (between.x() * df.y() - between.y() * df.x()) / cross;
    const double at_f = (between.x() * de.y() - between.y() * de.x()) / cross;
    LinkDiagram::Crossing crossing;
    crossing.place = e.a + at_e * de;
    const auto height = [&](const FlatEdge& edge, double t) {
      const Positions& p = diagram.points[edge.component];
      return (1 - t) * p(2, edge.edge) + t * p(2, (edge.edge + 1) % edge.count);
    };
    const double gap = height(e, at_e) - height(f, at_f);
    crossing.gap = std::abs(gap);
    // On top is what exact arithmetic on the link's own points says; the frame may have rounded it away.
    const Sign side = orient3d(point_of(link, e.component, e.edge), point_of(link, e.component, e.edge + 1),
                               point_of(link, f.component, f.edge), point_of(link, f.component, f.edge + 1));
    const bool e_is_over = side * detail::sign_of(cross) > 0;
    if (side == 0 || crossing.gap < room || e_is_over != (gap > 0)) return false;
    const LinkDiagram::Strand of_e{e.component, e.edge, at_e}, of_f{f.component, f.edge, at_f};
    crossing.over = e_is_over ? of_e : of_f;
    crossing.under = e_is_over ? of_f : of_e;
    crossing.sign = (e_is_over ? cross : -cross) > 0 ? 1 : -1;
    crossing.radius = std::min(std::min(at_e, 1 - at_e) * de.norm(), std::min(at_f, 1 - at_f) * df.norm());
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (k != i && k != j)
        crossing.radius = std::min(crossing.radius, distance_to_edge(crossing.place, edges[k].a, edges[k].b));
    if (crossing.radius < room) return false;
    const auto slope = [&](const FlatEdge& edge) {
      const Positions& p = diagram.points[edge.component];
      return std::abs(p(2, (edge.edge + 1) % edge.count) - p(2, edge.edge)) / (edge.b - edge.a).norm();
    };
    crossing.band = band_of_room * crossing.radius;
    if (const double climb = crossing.band * (slope(e) + slope(f)); climb > climb_of_gap * crossing.gap)
      crossing.band *= climb_of_gap * crossing.gap / climb;
    crossing.beside = crossing.band * std::abs(cross) / (de.norm() * df.norm());
    const double longest = std::max(de.norm(), df.norm());
    if (std::min(crossing.gap, crossing.beside) * crossing.band / longest < least_nesting_rel * size) return false;
    diagram.crossings.push_back(crossing);
  }
  return true;
}

void order_passes(LinkDiagram& diagram) {
  struct Visit {
    LinkDiagram::Strand strand;
    LinkDiagram::Pass pass;
  };
  std::vector<std::vector<Visit>> visits(diagram.points.size());
  for (Index k = 0; k < static_cast<Index>(diagram.crossings.size()); ++k) {
    const LinkDiagram::Crossing& c = diagram.crossings[k];
    visits[c.over.component].push_back({c.over, {k, true}});
    visits[c.under.component].push_back({c.under, {k, false}});
  }
  diagram.passes.resize(visits.size());
  for (std::size_t c = 0; c < visits.size(); ++c) {
    std::stable_sort(visits[c].begin(), visits[c].end(), [](const Visit& a, const Visit& b) {
      return std::pair(a.strand.edge, a.strand.fraction) < std::pair(b.strand.edge, b.strand.fraction);
    });
    for (const Visit& visit : visits[c]) diagram.passes[c].push_back(visit.pass);
  }
}

/// Arcs between passes are joined at each crossing: what arrives above to what leaves below, and the other way.
void count_circles(LinkDiagram& diagram) {
  std::vector<Index> first(diagram.passes.size());
  Index arcs = 0;
  for (std::size_t c = 0; c < first.size(); ++c) {
    first[c] = arcs;
    arcs += std::max<Index>(1, static_cast<Index>(diagram.passes[c].size()));
  }
  struct Ends {
    Index in_over = 0, out_over = 0, in_under = 0, out_under = 0;
  };
  std::vector<Ends> ends(diagram.crossings.size());
  for (std::size_t c = 0; c < first.size(); ++c) {
    const auto n = static_cast<Index>(diagram.passes[c].size());
    for (Index k = 0; k < n; ++k) {
      const LinkDiagram::Pass& pass = diagram.passes[c][k];
      Ends& e = ends[pass.crossing];
      (pass.over ? e.in_over : e.in_under) = first[c] + k;
      (pass.over ? e.out_over : e.out_under) = first[c] + (k + 1) % n;
    }
  }
  UnionFind circles(arcs);
  for (const Ends& e : ends) {
    circles.unite(e.in_over, e.out_under);
    circles.unite(e.in_under, e.out_over);
  }
  for (Index a = 0; a < arcs; ++a) diagram.circles += circles.find(a) == a;
  for (const Ends& e : ends) circles.unite(e.in_over, e.in_under);  // the bands
  Index parts = 0;
  for (Index a = 0; a < arcs; ++a) parts += circles.find(a) == a;
  diagram.connected = parts == 1;
}

/// Rows: an orthogonal frame whose third axis is this.
Eigen::Matrix3d frame_along(const Vec3& axis) {
  int smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vec3 x = axis.cross(Vec3::Unit(smallest)).normalized();
  Eigen::Matrix3d frame;
  frame << x.transpose(), axis.cross(x).transpose(), axis.transpose();
  return frame;
}

std::vector<Eigen::Matrix3d> views(int count) {
  std::vector<Eigen::Matrix3d> frames(3);
  frames[0] = Eigen::Matrix3d::Identity();
  frames[1] << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  frames[2] << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  for (int k = 0; k < count - 3; ++k) {  // a half sphere, evenly: Fibonacci's lattice
    const double z = 1 - (k + 0.5) / (count - 3), r = std::sqrt(1 - z * z);
    const double angle = 2 * std::numbers::pi * k / std::numbers::phi;
    frames.push_back(frame_along(Vec3(r * portable::cos(angle), r * portable::sin(angle), z).normalized()));
  }
  return frames;
}

}  // namespace

std::optional<LinkDiagram> diagram_of(const Link& link, const Eigen::Matrix3d& frame) {
  LinkDiagram diagram;
  diagram.frame = frame;
  double size = 0;
  for (const std::vector<double>& component : link.components) {
    const Eigen::Map<const Positions> p(component.data(), 3, static_cast<Eigen::Index>(component.size() / 3));
    diagram.points.emplace_back(frame * p);
    size = std::max(size, diagram.points.back().cwiseAbs().maxCoeff());
  }
  const std::vector<FlatEdge> edges = edges_of(diagram);
  const double room = least_room_rel * size;
  for (const FlatEdge& e : edges) {
    if ((e.b - e.a).norm() < room) return {};
    const Positions& p = diagram.points[e.component];
    const Vec2 next = p.col((e.edge + 2) % e.count).head<2>();
    if (turn(e.a, e.b, next) == 0 && (next - e.b).dot(e.b - e.a) < 0) return {};
  }
  if (!find_crossings(link, edges, size, diagram)) return {};
  order_passes(diagram);
  count_circles(diagram);
  return diagram;
}

std::optional<LinkDiagram> best_diagram(const Link& link, int directions, const std::function<bool()>& stop) {
  std::optional<LinkDiagram> best;
  double best_room = 0;
  for (const Eigen::Matrix3d& frame : views(directions)) {
    if (best && stop && stop()) break;
    std::optional<LinkDiagram> diagram = diagram_of(link, frame);
    if (!diagram) continue;
    double room = std::numeric_limits<double>::infinity();
    for (const LinkDiagram::Crossing& c : diagram->crossings) room = std::min({room, c.gap, c.radius});
    const auto key = [](const LinkDiagram& d, double r) {
      return std::tuple(d.connected, d.euler_characteristic(), r);
    };
    if (best && key(*diagram, room) <= key(*best, best_room)) continue;
    best = std::move(diagram);
    best_room = room;
  }
  return best;
}

double narrowest_nesting(const LinkDiagram& diagram) {
  double least = std::numeric_limits<double>::infinity();
  for (const LinkDiagram::Crossing& c : diagram.crossings) least = std::min(least, std::min(c.gap, c.beside) * c.band);
  return least;
}

LinkDiagram roomier_diagram(const Link& link, LinkDiagram diagram, const std::function<bool()>& stop) {
  double room = narrowest_nesting(diagram);
  for (double turn = first_turn; turn >= last_turn; turn /= 2) {
    const Eigen::Matrix3d frame = diagram.frame;
    for (const int axis : {0, 1})
      for (const double sense : {1.0, -1.0}) {
        if (stop && stop()) return diagram;
        const Vec3 toward = (frame.row(2) + sense * turn * frame.row(axis)).transpose();
        std::optional<LinkDiagram> turned = diagram_of(link, frame_along(toward.normalized()));
        if (!turned || turned->connected != diagram.connected ||
            turned->euler_characteristic() != diagram.euler_characteristic())
          continue;
        if (const double its = narrowest_nesting(*turned); its > room) {
          room = its;
          diagram = std::move(*turned);
        }
      }
  }
  return diagram;
}

Polynomial alexander_polynomial(const LinkDiagram& diagram) {
  const auto crossings = static_cast<Index>(diagram.crossings.size());
  // Arcs run from one pass below to the next.
  std::vector<Index> over(crossings), in(crossings), out(crossings);
  Index arcs = 0;
  for (const auto& passes : diagram.passes) {
    const Index first = arcs;
    Index count = 0;
    for (const LinkDiagram::Pass& pass : passes) count += !pass.over;
    Index k = 0;
    for (const LinkDiagram::Pass& pass : passes) {
      if (pass.over) {
        over[pass.crossing] = first + (count > 0 ? k % count : 0);
      } else {
        in[pass.crossing] = first + k % count;
        out[pass.crossing] = first + (k + 1) % count;
        ++k;
      }
    }
    arcs += std::max<Index>(1, count);
  }
  const Index rank = arcs - 1;
  if (crossings < rank) return {};  // a component lies on top of all others, and another one too: split
  // Rows are relations, one of which follows from the others; columns are arcs, one of which may be left out.
  LinearMatrix matrix(rank);
  const Index skipped = crossings - rank;
  for (Index c = skipped; c < crossings; ++c) {
    const auto add = [&](Index arc, std::int64_t constant, std::int64_t slope) {
      if (arc == 0) return;
      matrix.constant[matrix.at(c - skipped, arc - 1)] += constant;
      matrix.slope[matrix.at(c - skipped, arc - 1)] += slope;
    };
    const bool positive = diagram.crossings[c].sign > 0;
    add(over[c], 1, -1);
    add(positive ? in[c] : out[c], 0, 1);
    add(positive ? out[c] : in[c], -1, 0);
  }
  return without_units(determinant(matrix));
}

}  // namespace unsnarl
