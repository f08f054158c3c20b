#include "pipeline/nesting.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "contact/closed_surface.h"
#include "contact/intersection_finder.h"
#include "geometry/parallel.h"
#include "geometry/sort_unique.h"
#include "mesh/areas.h"
#include "mesh/union_find.h"
#include "mesh/validity.h"

namespace unsnarl {
namespace {

using Pairs = std::set<std::array<Index, 2>>;

/// Inner and outer surface of all that the chains name, and of what follows from them.
Pairs checked_pairs(const Nesting& nesting, Index count) {
  Pairs pairs;
  for (const std::vector<std::int32_t>& chain : nesting.chains) {
    if (chain.size() < 2) throw std::invalid_argument("nested: a chain needs two surfaces, from the innermost out");
    for (auto inner = chain.begin(); inner != chain.end(); ++inner) {
      if (*inner < 0 || *inner >= count)
        throw std::invalid_argument("nested: there is no surface " + std::to_string(*inner) + "; there are " +
                                    std::to_string(count) + ", counted from 0");
      for (auto outer = inner + 1; outer != chain.end(); ++outer) pairs.insert({*inner, *outer});
    }
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b] : Pairs(pairs))
      for (auto next = pairs.lower_bound({b, 0}); next != pairs.end() && (*next)[0] == b; ++next)
        grows |= pairs.insert({a, (*next)[1]}).second;
  }
  for (const auto& [inner, outer] : pairs)
    if (inner == outer)
      throw std::invalid_argument("nested: " + nesting.name(inner) +
                                  " would have to lie inside itself; name it once in a chain, and in the same order "
                                  "in all chains");
  return pairs;
}

/// The vertices of the outer surface of a pair are all inside the inner one, none of the inner one's inside the outer.
bool is_the_other_way_round(const NestedSurfaces& nested, const std::array<Index, 2>& pair, const Positions& x) {
  const auto [inner, outer] = pair;
  if (!nested.closed[inner]) return false;
  const std::vector<Index> wrong = vertices_on_the_wrong_side(nested, pair, x);
  if (wrong.size() < nested.vertices[inner].size() + nested.vertices[outer].size()) return false;
  ClosedSurface surface(nested.triangles[inner]);
  surface.update(x);
  return surface.side_of(x.col(nested.vertices[outer].front())) == Side::inside;
}

/// Whether any faces of two surfaces meet.
bool meet(const NestedSurfaces& nested, const std::array<Index, 2>& pair, const Positions& x) {
  std::vector<Triangle> both = nested.triangles[pair[0]];
  const auto first_of_outer = static_cast<Index>(both.size());
  both.insert(both.end(), nested.triangles[pair[1]].begin(), nested.triangles[pair[1]].end());
  const std::vector<IntersectingPair> pairs = IntersectionFinder(both).find(x);
  return std::any_of(pairs.begin(), pairs.end(), [&](const IntersectingPair& found) {
    return found.a < first_of_outer && found.b >= first_of_outer;
  });
}

}  // namespace

std::string Nesting::name(std::int32_t surface) const {
  const auto s = static_cast<std::size_t>(surface);
  return s < names.size() ? names[s] : std::to_string(surface);
}

NestedSurfaces nested_surfaces(const SurfaceView& surface, const PreparedSurface& prepared, const Nesting& nesting) {
  if (nesting.surface_of_vertex.size() != surface.vertex_count())
    throw std::invalid_argument("nested: there are " + std::to_string(nesting.surface_of_vertex.size()) +
                                " numbers for " + std::to_string(surface.vertex_count()) + " vertices");
  Index count = static_cast<Index>(nesting.names.size());
  for (const std::int32_t s : nesting.surface_of_vertex) count = std::max(count, s + 1);
  const Pairs pairs = checked_pairs(nesting, count);

  NestedSurfaces nested;
  nested.pairs.assign(pairs.begin(), pairs.end());
  std::vector<std::uint8_t> is_named(count, 0);
  for (const auto& [inner, outer] : pairs) is_named[inner] = is_named[outer] = 1;
  nested.surface_of_vertex.assign(prepared.weld_map.count, -1);
  for (std::size_t v = 0; v < nesting.surface_of_vertex.size(); ++v) {
    const std::int32_t s = nesting.surface_of_vertex[v];
    if (s < 0 || !is_named[s]) continue;
    Index& own = nested.surface_of_vertex[prepared.weld_map.vertex_of[v]];
    if (own >= 0 && own != s)
      throw std::invalid_argument("nested: " + nesting.name(own) + " and " + nesting.name(s) +
                                  " are welded at vertex " + std::to_string(v) +
                                  ", so that neither can lie inside the other; weld less, or leave one of them out");
    own = s;
  }
  nested.triangles.resize(count);
  nested.vertices.resize(count);
  for (const Triangle& t : prepared.triangles()) {
    const Index s = nested.surface_of_vertex[t[0]];
    if (std::any_of(t.begin(), t.end(), [&](Index v) { return nested.surface_of_vertex[v] != s; }))
      throw std::invalid_argument("nested: a face has vertices of two surfaces; each has to be one of its own");
    if (s < 0) continue;
    nested.triangles[s].push_back(t);
    nested.vertices[s].insert(nested.vertices[s].end(), t.begin(), t.end());
  }
  nested.closed.assign(count, 0);
  for (Index s = 0; s < count; ++s) {
    std::vector<Index>& vertices = nested.vertices[s];
    sort_unique(vertices);
    const Edge open = first_open_edge(nested.triangles[s]);
    nested.closed[s] = open[0] < 0 && !vertices.empty();
    const auto is_outer = [&](const auto& pair) { return pair[1] == s; };
    if (nested.closed[s] || std::none_of(pairs.begin(), pairs.end(), is_outer)) continue;
    if (vertices.empty()) throw std::invalid_argument("nested: " + nesting.name(s) + " has no faces");
    throw std::invalid_argument("nested: " + nesting.name(s) + " is not closed, at the edge between vertices " +
                                std::to_string(prepared.weld_map.first[open[0]]) + " and " +
                                std::to_string(prepared.weld_map.first[open[1]]) +
                                ", so that nothing is inside it; close it, or leave it out");
  }
  return nested;
}

void require_order_is_possible(const NestedSurfaces& nested, const Positions& x, const Nesting& nesting) {
  for (const std::array<Index, 2>& pair : nested.pairs)
    if (is_the_other_way_round(nested, pair, x) && !meet(nested, pair, x))
      throw std::invalid_argument("nested: " + nesting.name(pair[0]) + " is to lie inside " + nesting.name(pair[1]) +
                                  ", but holds all of it, and no faces of the two meet; a chain goes from the "
                                  "innermost out: is it the wrong way round?");
}

Nesting nesting_of_files(std::span<const SceneFile> files, std::vector<std::vector<std::int32_t>> chains) {
  Nesting nesting;
  nesting.chains = std::move(chains);
  for (const SceneFile& file : files) {
    const auto number = static_cast<std::int32_t>(nesting.names.size());
    nesting.surface_of_vertex.insert(nesting.surface_of_vertex.end(), file.vertices, number);
    nesting.names.push_back(file.name);
  }
  return nesting;
}

std::vector<std::string> check_nesting(const SurfaceView& surface, const Nesting& nesting, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(surface, options);
  const NestedSurfaces nested = nested_surfaces(surface, prepared, nesting);
  require_order_is_possible(nested, prepared.rest, nesting);
  const auto volume = [&](Index s) { return std::abs(signed_volume(prepared.rest, nested.triangles[s])); };
  std::vector<std::string> doubts;
  for (const auto& [inner, outer] : nested.pairs) {
    if (!nested.closed[inner] || !(volume(inner) > volume(outer))) continue;
    doubts.push_back(
        fmt::format("{} has {:.2g} times the volume of {}, which it is to lie inside of; a chain goes from "
                    "the innermost out: is it the wrong way round?",
                    nesting.name(inner), volume(inner) / volume(outer), nesting.name(outer)));
  }
  return doubts;
}

std::vector<NestedPair> nested_pairs(const SurfaceView& before, std::span<const double> after,
                                     std::span<const IntersectingPair> pairs_after, const Nesting& nesting,
                                     const FindOptions& options) {
  require_positions(before, after);
  const ThreadLimit threads(options.threads);
  const PreparedSurface prepared = prepare(before, options);
  const NestedSurfaces nested = nested_surfaces(before, prepared, nesting);
  const Positions x = prepared.gather(after);
  const auto vertex_of_face = [&](std::int32_t f) { return prepared.weld_map.vertex_of[before.face(f)[0]]; };
  std::set<std::array<Index, 2>> meet;             // surfaces
  std::set<std::array<Index, 2>> component_meets;  // a surface
  UnionFind components = vertices_joined_by(prepared.triangles(), prepared.weld_map.count);
  for (const IntersectingPair& pair : pairs_after) {
    const Index u = vertex_of_face(pair.a), v = vertex_of_face(pair.b);
    const Index a = nested.surface_of_vertex[u], b = nested.surface_of_vertex[v];
    meet.insert({std::min(a, b), std::max(a, b)});
    component_meets.insert({components.find(u), b});
    component_meets.insert({components.find(v), a});
  }
  std::vector<std::size_t> sizes(components.size());  // of the components, by their first vertices
  for (std::size_t v = 0; v < sizes.size(); ++v) ++sizes[components.find(static_cast<Index>(v))];
  std::vector<NestedPair> result;
  for (const std::vector<std::int32_t>& chain : nesting.chains)
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const std::array<Index, 2> pair = {chain[i], chain[i + 1]};
      NestedPair& entry = result.emplace_back();
      entry.inner = nesting.name(pair[0]);
      entry.outer = nesting.name(pair[1]);
      entry.wrong_before = vertices_on_the_wrong_side(nested, pair, prepared.rest).size();
      const std::vector<Index> wrong = vertices_on_the_wrong_side(nested, pair, x);
      entry.wrong_after = wrong.size();
      std::map<Index, std::size_t> wrong_in;  // the same by component
      for (const Index v : wrong) ++wrong_in[components.find(v)];
      for (const auto& [first, count] : wrong_in) {
        const Index other = nested.surface_of_vertex[first] == pair[0] ? pair[1] : pair[0];
        if (count == sizes[first] && !component_meets.count({first, other}))
          entry.apart.push_back(prepared.weld_map.first[first]);
      }
      std::sort(entry.apart.begin(), entry.apart.end());
      entry.is_nested = entry.wrong_after == 0 && !meet.count({std::min(pair[0], pair[1]), std::max(pair[0], pair[1])});
    }
  return result;
}

}  // namespace unsnarl
