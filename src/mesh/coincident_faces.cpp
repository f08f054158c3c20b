#include "mesh/coincident_faces.h"

#include <algorithm>

#include "geometry/sort_unique.h"
#include "mesh/id_table.h"

namespace unsnarl {

CoincidentFaces::CoincidentFaces(const SurfaceView& surface, std::span<const Index> class_of)
    : set_of_(surface.face_count(), -1) {
  const auto list_classes = [&](std::size_t f, std::vector<Index>& classes) {
    classes.clear();
    for (Index v : surface.face(f)) classes.push_back(class_of[v]);
    sort_unique(classes);
  };
  std::vector<Index> classes, others;
  IdTable table(surface.face_count());
  Index sets = 0;
  for (std::size_t f = 0; f < surface.face_count(); ++f) {
    list_classes(f, classes);
    if (classes.size() < 3) continue;  // collapsed: it lies in an edge or a point of its neighbours anyway
    std::uint64_t hash = 0;
    for (Index c : classes) hash = mixed(hash + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(c + 1));
    const Index other = table.find_or_add(hash, static_cast<Index>(f), [&](Index g) {
      list_classes(static_cast<std::size_t>(g), others);
      return others == classes;
    });
    if (other < 0) continue;
    if (set_of_[other] < 0) set_of_[other] = sets++;
    set_of_[f] = set_of_[other];
  }
  for (std::size_t f = 0; sets > 0 && f < surface.face_count(); ++f)
    if (set_of_[f] >= 0)
      for (Index v : surface.face(f)) corners_.push_back({v, set_of_[f], static_cast<Index>(f)});
  std::sort(corners_.begin(), corners_.end());
}

std::span<const CoincidentFaces::Corner> CoincidentFaces::corners_at(Index vertex) const {
  const auto before = [](const Corner& corner, Index v) { return corner.vertex < v; };
  const auto first = std::lower_bound(corners_.begin(), corners_.end(), vertex, before);
  const auto last = std::lower_bound(first, corners_.end(), vertex + 1, before);
  return std::span(corners_).subspan(static_cast<std::size_t>(first - corners_.begin()),
                                     static_cast<std::size_t>(last - first));
}

}  // namespace unsnarl
