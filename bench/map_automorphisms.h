#pragma once

#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "geometry/types.h"

namespace unsnarl {

/// Image of each vertex under an automorphism of a map.
using VertexMap = std::vector<Index>;

/// The automorphisms of a closed, connected, oriented triangulation that keep its orientation; with `mirrored`, those
/// that reverse it. One is fixed by the image of one directed edge, so that there are at most as many of either kind as
/// directed edges; as many is what makes the map regular (of either kind: reflexible).
/// Throws std::invalid_argument where a directed edge is used twice or its opposite is missing.
inline std::vector<VertexMap> map_automorphisms(std::span<const Triangle> faces, Index vertex_count,
                                                bool mirrored = false) {
  std::map<Edge, Index> left;  // of each directed edge the third vertex of the face to its left
  for (const Triangle& t : faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (!left.emplace(Edge{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]).second)
        throw std::invalid_argument("two faces use an edge in one direction");
  for (const auto& [edge, third] : left)
    if (!left.contains({edge[1], edge[0]})) throw std::invalid_argument("an edge has one face");
  std::vector<VertexMap> found;
  for (const auto& [target, unused] : left) {
    VertexMap image(static_cast<std::size_t>(vertex_count), -1);
    const Edge first = {faces[0][0], faces[0][1]};
    image[first[0]] = target[0];
    image[first[1]] = target[1];
    std::vector<Edge> open = {first};
    std::set<Edge> seen;
    bool fits = true;
    while (!open.empty() && fits) {
      const Edge edge = open.back();
      open.pop_back();
      if (!seen.insert(edge).second) continue;
      const Edge moved = mirrored ? Edge{image[edge[1]], image[edge[0]]} : Edge{image[edge[0]], image[edge[1]]};
      const auto place = left.find(moved);
      const Index third = left.at(edge);
      if (place == left.end() || (image[third] != -1 && image[third] != place->second)) {
        fits = false;
        break;
      }
      image[third] = place->second;
      open.push_back({edge[1], third});
      open.push_back({edge[1], edge[0]});
    }
    if (fits && std::set<Index>(image.begin(), image.end()).size() == image.size()) found.push_back(image);
  }
  return found;
}

}  // namespace unsnarl
