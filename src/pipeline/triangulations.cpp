#include "pipeline/triangulations.h"

#include <algorithm>
#include <utility>

#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

/// A triangle of a polygon, whatever its first corner.
using Piece = std::pair<Index, Triangle>;

Piece piece(const Triangulation& cut, std::size_t t) {
  Triangle corners = cut.triangles[t];
  std::sort(corners.begin(), corners.end());
  return {cut.polygon[t], corners};
}

std::vector<Piece> sorted_pieces(const Triangulation& cut) {
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) pieces.push_back(piece(cut, t));
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

/// Adds to `all` the triangles that `cut` has besides.
void add(const Triangulation& cut, UnitedTriangulations& united) {
  Triangulation& all = united.all;
  if (all.triangles == cut.triangles) return;
  const std::vector<Piece> known = sorted_pieces(all), wanted = sorted_pieces(cut);
  const auto first_new = static_cast<Index>(all.triangles.size());
  std::vector<std::pair<Index, Index>> added;  // polygon, triangle; by polygon
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    if (std::binary_search(known.begin(), known.end(), piece(cut, t))) continue;
    added.emplace_back(cut.polygon[t], static_cast<Index>(all.triangles.size()));
    all.triangles.push_back(cut.triangles[t]);
    all.polygon.push_back(cut.polygon[t]);
  }
  for (Index s = 0; s < first_new; ++s) {
    auto it = std::lower_bound(added.begin(), added.end(), std::pair(all.polygon[s], Index{0}));
    if (it == added.end() || it->first != all.polygon[s]) continue;
    if (std::binary_search(wanted.begin(), wanted.end(), piece(all, static_cast<std::size_t>(s)))) continue;
    for (; it != added.end() && it->first == all.polygon[s]; ++it)
      united.exclusive.push_back({s, it->second, PairClass::folded});
  }
}

}  // namespace

UnitedTriangulations unite(const std::vector<Triangulation>& cuts) {
  UnitedTriangulations united;
  united.of_first = cuts.front().triangles.size();
  for (const Triangulation& cut : cuts) add(cut, united);
  std::sort(united.exclusive.begin(), united.exclusive.end());
  return united;
}

std::vector<Index> polygons_on_new_duplicates(const Triangulation& cut, std::size_t known,
                                              std::span<const IntersectingPair> pairs) {
  std::vector<Index> polygons;
  for (const IntersectingPair& pair : pairs)
    if (pair.kind == PairClass::duplicate && static_cast<std::size_t>(std::max(pair.a, pair.b)) >= known)
      polygons.insert(polygons.end(), {cut.polygon[pair.a], cut.polygon[pair.b]});
  sort_unique(polygons);
  return polygons;
}

}  // namespace unsnarl
