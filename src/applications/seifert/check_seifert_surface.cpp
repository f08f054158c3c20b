#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "applications/seifert/link_diagram.h"
#include "applications/seifert/seifert_matrix.h"
#include "mesh/union_find.h"
#include "unsnarl/seifert.h"

namespace unsnarl {
namespace {

struct Mesh {
  std::vector<Vec3> x;
  std::vector<Triangle> faces;
};

Mesh mesh_of(const SurfaceView& surface) {
  Mesh mesh;
  for (std::size_t v = 0; v < surface.vertex_count(); ++v)
    mesh.x.emplace_back(surface.positions[3 * v], surface.positions[3 * v + 1], surface.positions[3 * v + 2]);
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    const auto corners = surface.face(f);
    if (corners.size() != 3)
      throw std::invalid_argument(fmt::format("face {} has {} corners; a triangle mesh is due", f, corners.size()));
    mesh.faces.push_back({corners[0], corners[1], corners[2]});
  }
  return mesh;
}

/// The directed edges of all faces, each with its face: none twice where faces agree on a side.
using Sides = std::map<Edge, Index>;

/// False: an edge is used twice in one direction.
bool collect_sides(const Mesh& mesh, Sides& sides) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k)
      if (!sides.try_emplace({mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]}, static_cast<Index>(f)).second)
        return false;
  return true;
}

/// The faces around every vertex form one fan.
bool has_single_fans(const Mesh& mesh, const Sides& sides) {
  std::vector<std::size_t> corners(mesh.x.size(), 0), links(mesh.x.size(), 0), ends(mesh.x.size(), 0);
  for (const Triangle& t : mesh.faces)
    for (const Index v : t) ++corners[v];
  UnionFind fans(3 * mesh.faces.size());
  for (const auto& [edge, face] : sides) {
    const auto other = sides.find({edge[1], edge[0]});
    if (other == sides.end()) {
      ++ends[edge[0]];
      continue;
    }
    for (const Index v : edge) {
      const auto corner = [&](Index f) {
        const Triangle& t = mesh.faces[f];
        return 3 * f + (t[0] == v ? 0 : t[1] == v ? 1 : 2);
      };
      links[v] += fans.unite(corner(face), corner(other->second));
    }
  }
  for (std::size_t v = 0; v < mesh.x.size(); ++v)
    if (corners[v] == 0 || links[v] + 1 != corners[v] || ends[v] > 1) return false;
  return true;
}

std::vector<std::vector<Index>> boundary_loops(const Sides& sides) {
  std::map<Index, Index> next;
  for (const auto& [edge, face] : sides)
    if (!sides.contains({edge[1], edge[0]})) next[edge[0]] = edge[1];
  std::vector<std::vector<Index>> loops;
  while (!next.empty()) {
    std::vector<Index>& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back(at->first);
      const Index to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

int euler_characteristic_of(const Mesh& mesh, const Sides& sides) {
  std::size_t edges = 0;
  for (const auto& [edge, face] : sides) edges += edge[0] < edge[1] || !sides.contains({edge[1], edge[0]});
  return static_cast<int>(mesh.x.size()) - static_cast<int>(edges) + static_cast<int>(mesh.faces.size());
}

/// Every loop runs through the points of a component of its own, in their order.
bool runs_along(const std::vector<std::vector<Index>>& loops, const Mesh& mesh, const Link& link) {
  if (loops.size() != link.components.size()) return false;
  std::vector<bool> used(loops.size(), false);
  for (const std::vector<double>& points : link.components) {
    const std::size_t n = points.size() / 3;
    const auto at = [&](std::size_t k) { return Vec3(points[3 * k], points[3 * k + 1], points[3 * k + 2]); };
    bool found = false;
    for (std::size_t l = 0; l < loops.size() && !found; ++l) {
      if (used[l] || loops[l].size() != n) continue;
      for (std::size_t shift = 0; shift < n && !found; ++shift) {
        std::size_t k = 0;
        while (k < n && mesh.x[loops[l][(k + shift) % n]] == at(k)) ++k;
        found = k == n;
      }
      used[l] = found;
    }
    if (!found) return false;
  }
  return true;
}

std::vector<std::string> as_text(const Polynomial& polynomial) {
  std::vector<std::string> text;
  for (const Integer& c : polynomial) text.push_back(c.str());
  return text;
}

}  // namespace

SpanningBoundary spanning_boundary(const SurfaceView& surface) {
  const Mesh mesh = mesh_of(surface);
  Sides sides;
  if (!collect_sides(mesh, sides))
    throw std::invalid_argument("its faces do not agree on a side: a Seifert surface is oriented");
  if (!has_single_fans(mesh, sides)) throw std::invalid_argument("it is not a manifold, or has vertices without faces");
  SpanningBoundary found;
  for (const std::vector<Index>& loop : boundary_loops(sides)) {
    std::vector<double>& points = found.link.components.emplace_back();
    for (const Index v : loop) {
      points.insert(points.end(), mesh.x[v].data(), mesh.x[v].data() + 3);
      found.vertices.push_back(v);
    }
  }
  if (found.vertices.empty()) throw std::invalid_argument("it has no boundary");
  found.euler_characteristic = euler_characteristic_of(mesh, sides);
  return found;
}

SeifertFindings check_seifert_surface(const SurfaceView& surface, const Link& link, int views, int handles,
                                      std::optional<int> euler_characteristic) {
  check_link(link);
  const Mesh mesh = mesh_of(surface);
  SeifertFindings found;
  FindOptions every_vertex_by_itself;
  every_vertex_by_itself.weld = Weld::none;
  found.intersecting_pairs = find_intersections(surface, every_vertex_by_itself).size();
  const std::optional<LinkDiagram> diagram = best_diagram(link, views);
  if (!diagram) throw std::invalid_argument("no view of the link tells its strands apart");
  found.expected_euler_characteristic =
      euler_characteristic.value_or(static_cast<int>(diagram->euler_characteristic()) - 2 * handles);
  found.alexander_of_link = as_text(alexander_polynomial(*diagram));
  Sides sides;
  found.oriented = collect_sides(mesh, sides) && has_single_fans(mesh, sides);
  if (!found.oriented) return found;
  const std::vector<std::vector<Index>> loops = boundary_loops(sides);
  found.spans_link = runs_along(loops, mesh, link);
  found.euler_characteristic = euler_characteristic_of(mesh, sides);
  UnionFind parts = vertices_joined_by(mesh.faces, static_cast<Index>(mesh.x.size()));
  for (std::size_t v = 0; v < mesh.x.size(); ++v)
    found.components += parts.find(static_cast<Index>(v)) == static_cast<Index>(v);
  std::vector<bool> is_bounded(mesh.x.size(), false);
  for (const std::vector<Index>& loop : loops) is_bounded[parts.find(loop[0])] = true;
  found.closed_components = found.components - static_cast<int>(std::count(is_bounded.begin(), is_bounded.end(), true));
  found.genus = (2 * found.components - found.euler_characteristic - static_cast<int>(loops.size())) / 2;
  if (found.intersecting_pairs > 0 || !found.spans_link) return found;
  const SeifertMatrix matrix = seifert_matrix(mesh.x, mesh.faces);
  // Tubes that join its components would add loops that link none: the signature stays, and the polynomial is zero.
  found.signature = signature(matrix);
  if (found.components > 1) return found;
  const Polynomial polynomial = alexander_polynomial(matrix);
  found.alexander_of_surface = as_text(polynomial);
  found.determinant = Integer(abs(value_at(polynomial, -1))).str();
  // The degree is at most 1 - Euler characteristic, whatever connected surface the link has.
  found.genus_is_least =
      !polynomial.empty() && static_cast<int>(polynomial.size()) - 1 == 1 - found.euler_characteristic;
  return found;
}

std::string seifert_faults(const SeifertFindings& f) {
  std::string text;
  if (f.intersecting_pairs > 0) text += fmt::format("{} pairs of faces intersect\n", f.intersecting_pairs);
  if (!f.oriented) text += "it is not an oriented manifold with boundary\n";
  if (f.oriented && !f.spans_link) text += "its boundary is not the link\n";
  if (f.closed_components > 0) text += fmt::format("{} of its components have no boundary\n", f.closed_components);
  if (f.oriented && f.euler_characteristic != f.expected_euler_characteristic)
    text += "its Euler characteristic is not the expected one\n";
  if (f.oriented && f.spans_link && f.intersecting_pairs == 0 && f.alexander_of_surface != f.alexander_of_link)
    text += "its Alexander polynomial is not that of the diagram\n";
  return text;
}

std::string polynomial_text(std::span<const std::string> coefficients) {
  Polynomial polynomial;
  for (const std::string& c : coefficients) polynomial.emplace_back(c);
  return to_text(polynomial);
}

}  // namespace unsnarl
