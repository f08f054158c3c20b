#include "repair/cuts.h"

#include <algorithm>
#include <utility>

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

}  // namespace

std::vector<IntersectingPair> add_cut(Triangulation& all, const Triangulation& cut) {
  if (all.triangles == cut.triangles) return {};
  const std::vector<Piece> known = sorted_pieces(all), wanted = sorted_pieces(cut);
  const auto first_new = static_cast<Index>(all.triangles.size());
  std::vector<std::pair<Index, Index>> added;  // polygon, triangle; by polygon
  for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
    if (std::binary_search(known.begin(), known.end(), piece(cut, t))) continue;
    added.emplace_back(cut.polygon[t], static_cast<Index>(all.triangles.size()));
    all.triangles.push_back(cut.triangles[t]);
    all.polygon.push_back(cut.polygon[t]);
  }
  std::vector<IntersectingPair> strangers;
  for (Index s = 0; s < first_new; ++s) {
    auto it = std::lower_bound(added.begin(), added.end(), std::pair(all.polygon[s], Index{0}));
    if (it == added.end() || it->first != all.polygon[s]) continue;
    if (std::binary_search(wanted.begin(), wanted.end(), piece(all, static_cast<std::size_t>(s)))) continue;
    for (; it != added.end() && it->first == all.polygon[s]; ++it)
      strangers.push_back({s, it->second, PairClass::folded});
  }
  return strangers;
}

}  // namespace unsnarl
