#include "mesh/ear_clipper.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace unsnarl {

std::size_t EarClipper::clip(std::span<const Index> corners, std::span<const Vec3> points, const Vec3& normal,
                             std::vector<Triangle>& triangles) {
  const auto n = static_cast<Index>(corners.size());
  tree_.build(corners, points);
  before_.resize(n);
  after_.resize(n);
  for (Index i = 0; i < n; ++i) {
    before_[i] = (i + n - 1) % n;
    after_[i] = (i + 1) % n;
  }
  to_look_at_.resize(n);
  std::iota(to_look_at_.begin(), to_look_at_.end(), 0);
  is_no_ear_.assign(n, 0);
  first_waiting_.assign(n, -1);
  waiting_.clear();

  std::size_t forced = 0;
  Index first = 0;
  for (Index left = n; left > 3; --left) {
    Index ear = next_ear(points, normal);
    if (ear < 0) {
      ear = first;
      ++forced;
    }
    const Index before = before_[ear], after = after_[ear];
    triangles.push_back({before, ear, after});
    tree_.remove(ear);
    after_[before] = after;
    before_[after] = before;
    if (ear == first) first = after;
    look_at(before);
    look_at(after);
    for (Index i = first_waiting_[ear]; i >= 0; i = waiting_[i].next) look_at(waiting_[i].place);
  }
  triangles.push_back({first, after_[first], before_[first]});
  return forced;
}

/// -1: there is none.
Index EarClipper::next_ear(std::span<const Vec3> points, const Vec3& normal) {
  while (!to_look_at_.empty()) {
    const Index place = to_look_at_.front();
    std::pop_heap(to_look_at_.begin(), to_look_at_.end(), std::greater<>());
    to_look_at_.pop_back();
    if (tree_.holds(place) && !is_no_ear_[place] && is_ear(points, normal, place)) return place;
  }
  return -1;
}

bool EarClipper::is_ear(std::span<const Vec3> points, const Vec3& normal, Index place) {
  const Index before = before_[place], after = after_[place];
  is_no_ear_[place] = 1;
  if (!(turn(normal, points[before], points[place], points[after]) > 0)) return false;
  // Any witness will do; a late one will be there for long.
  const Index witness = tree_.find_inside(normal, before, place, after);
  if (witness < 0) return true;
  waiting_.push_back({place, first_waiting_[witness]});
  first_waiting_[witness] = static_cast<Index>(waiting_.size()) - 1;
  return false;
}

void EarClipper::look_at(Index place) {
  is_no_ear_[place] = 0;
  to_look_at_.push_back(place);
  std::push_heap(to_look_at_.begin(), to_look_at_.end(), std::greater<>());
}

}  // namespace unsnarl
