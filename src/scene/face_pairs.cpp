#include "scene/face_pairs.h"

namespace unsnarl {
namespace {

template <class T>
std::vector<T> joined(const std::vector<T>& a, const std::vector<T>& b) {
  if (b.empty()) return {};
  std::vector<T> both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

}  // namespace

FacePairFinder::FacePairFinder(const PreparedSurface& surface)
    : surface_(surface),
      triangles_(joined(surface.triangulation.triangles, surface.other_diagonals.triangles)),
      polygon_(joined(surface.triangulation.polygon, surface.other_diagonals.polygon)),
      finder_(triangles_.empty() ? surface.triangles() : triangles_) {}

bool FacePairFinder::are_of_one_quad(const IntersectingPair& pair) const {
  const auto first_other = static_cast<Index>(surface_.triangulation.triangles.size());
  return polygon_[pair.a] == polygon_[pair.b] && pair.a < first_other && pair.b >= first_other;
}

std::vector<IntersectingPair> FacePairFinder::find(const Positions& x) {
  std::vector<IntersectingPair> pairs = finder_.find(x);
  if (triangles_.empty()) return pairs_of_faces(surface_.triangulation.polygon, pairs);
  std::erase_if(pairs, [this](const IntersectingPair& pair) { return are_of_one_quad(pair); });
  return pairs_of_faces(polygon_, pairs);
}

}  // namespace unsnarl
