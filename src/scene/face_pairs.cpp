#include "scene/face_pairs.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace unsnarl {
namespace {

/// Two faces with at most this many pairs of pieces have all of these decided to find the one that stands for the
/// faces; two quads cut along both diagonals have 16 (unit: pairs)
constexpr std::size_t few_piece_pairs = 64;

template <class T>
std::vector<T> joined(const std::vector<T>& a, const std::vector<T>& b) {
  if (b.empty()) return {};
  std::vector<T> both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

/// The triangles of each polygon, ascending.
IndexLists pieces_of_polygons(std::span<const Index> polygon) {
  const Index count = polygon.empty() ? 0 : 1 + *std::max_element(polygon.begin(), polygon.end());
  IndexLists pieces;
  pieces.offsets.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const Index p : polygon) ++pieces.offsets[p + 1];
  std::partial_sum(pieces.offsets.begin(), pieces.offsets.end(), pieces.offsets.begin());
  pieces.items.resize(polygon.size());
  std::vector<Index> next(pieces.offsets.begin(), pieces.offsets.end() - 1);
  for (std::size_t t = 0; t < polygon.size(); ++t) pieces.items[next[polygon[t]]++] = static_cast<Index>(t);
  return pieces;
}

}  // namespace

FacePairFinder::FacePairFinder(const PreparedSurface& surface, Which which)
    : surface_(surface),
      triangles_(joined(surface.triangulation.triangles, surface.other_diagonals.triangles)),
      polygon_(joined(surface.triangulation.polygon, surface.other_diagonals.polygon)),
      part_of_(surface.allowed.of_triangles(polygon())),
      finder_(triangles(), which == Which::to_resolve ? passing() : passing().only_what_passes()) {}

bool FacePairFinder::are_of_one_quad(const IntersectingPair& pair) const {
  if (triangles_.empty()) return false;
  const auto first_other = static_cast<Index>(surface_.triangulation.triangles.size());
  return polygon_[pair.a] == polygon_[pair.b] && pair.a < first_other && pair.b >= first_other;
}

std::vector<IntersectingPair> FacePairFinder::find(const Positions& x) {
  std::vector<IntersectingPair> pairs = finder_.find(x);
  if (triangles_.empty()) return pairs_of_faces(surface_.triangulation.polygon, pairs);
  std::erase_if(pairs, [this](const IntersectingPair& pair) { return are_of_one_quad(pair); });
  return pairs_of_faces(polygon_, pairs);
}

bool FacePairFinder::stands_for_its_faces(const Positions& x, const IndexLists& pieces,
                                          const IntersectingPair& pair) const {
  const auto order = [](const IntersectingPair& p) { return std::tuple(p.kind, p.a, p.b); };
  for (const Index i : pieces[polygon()[pair.a]])
    for (const Index j : pieces[polygon()[pair.b]]) {
      IntersectingPair other{std::min(i, j), std::max(i, j)};
      if (i == j || (other.a == pair.a && other.b == pair.b) || are_of_one_quad(other)) continue;
      if (intersects(x, triangles()[other.a], triangles()[other.b], other.kind) && order(other) < order(pair))
        return false;
    }
  return true;
}

void FacePairFinder::visit(const Positions& x, const std::function<bool()>& stop,
                           const std::function<void(std::span<const IntersectingPair>)>& take) {
  const IndexLists pieces = pieces_of_polygons(polygon());
  const auto has_few_pieces = [&](const IntersectingPair& pair) {
    const std::size_t a = pieces[polygon()[pair.a]].size(), b = pieces[polygon()[pair.b]].size();
    return a * b <= few_piece_pairs;
  };
  std::vector<IntersectingPair> faces;
  std::map<std::pair<Index, Index>, PairClass> of_large_faces;
  IntersectionFinder::PairVisitor visitor;
  visitor.stop = stop;
  visitor.keep = [&](const IntersectingPair& pair) {
    return !are_of_one_quad(pair) && (!has_few_pieces(pair) || stands_for_its_faces(x, pieces, pair));
  };
  visitor.take = [&](std::span<const IntersectingPair> pairs) {
    faces.clear();
    for (const IntersectingPair& pair : pairs) {
      const std::pair<Index, Index> ids = std::minmax(polygon()[pair.a], polygon()[pair.b]);
      if (has_few_pieces(pair)) {
        faces.push_back({ids.first, ids.second, pair.kind});
      } else {
        PairClass& kind = of_large_faces.try_emplace(ids, pair.kind).first->second;
        kind = std::min(kind, pair.kind);
      }
    }
    take(faces);
  };
  finder_.visit(x, visitor);
  faces.clear();
  for (const auto& [ids, kind] : of_large_faces) faces.push_back({ids.first, ids.second, kind});
  take(faces);
}

std::vector<IntersectingPair> find_allowed_pairs(const PreparedSurface& surface,
                                                 const std::optional<PreparedSurface>& read, const Positions& x) {
  if (!surface.allowed.any()) return {};
  const auto find = [&](const PreparedSurface& cut) {
    return FacePairFinder(cut, FacePairFinder::Which::allowed).find(x);
  };
  std::vector<IntersectingPair> pairs = find(surface);
  return read ? unite_face_pairs(std::move(pairs), find(*read)) : pairs;
}

}  // namespace unsnarl
