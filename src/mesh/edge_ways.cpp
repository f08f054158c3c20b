#include "mesh/edge_ways.h"

#include <algorithm>
#include <limits>

namespace unsnarl {
namespace {

/// The length of a way that does not exist (unit: length)
constexpr double no_way = std::numeric_limits<double>::infinity();

}  // namespace

EdgeWays::EdgeWays(const Positions& x, const IndexLists& neighbours)
    : x_(x), neighbours_(neighbours), length_(static_cast<std::size_t>(x.cols()), no_way) {}

void EdgeWays::start(std::span<const Index> from) {
  for (const Index v : met_) length_[v] = no_way;
  met_.clear();
  front_ = {};
  for (const Index v : from) {
    if (length_[v] == 0) continue;
    length_[v] = 0;
    met_.push_back(v);
    front_.emplace(0.0, v);
  }
}

double EdgeWays::next() const {
  return front_.empty() ? no_way : front_.top().first;
}

void EdgeWays::follow_next() {
  const auto [length, v] = front_.top();
  front_.pop();
  if (length > length_[v]) return;
  for (const Index w : neighbours_[v]) {
    const double through = length + (x_.col(v) - x_.col(w)).norm();
    if (!(through < length_[w])) continue;
    if (length_[w] == no_way) met_.push_back(w);
    length_[w] = through;
    front_.emplace(through, w);
  }
}

std::vector<Index> EdgeWays::within(double length) {
  while (next() <= length && !front_.empty()) follow_next();
  std::vector<Index> vertices;
  for (const Index v : met_)
    if (length_[v] <= length) vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace unsnarl
