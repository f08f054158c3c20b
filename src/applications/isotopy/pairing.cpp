#include "applications/isotopy/pairing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

namespace unsnarl {
namespace {

Vec2 point(const Curve& curve, std::size_t k) {
  return {curve.points[2 * k], curve.points[2 * k + 1]};
}

bool contains(const Curve& curve, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec2 a = point(curve, k), b = point(curve, (k + 1) % curve.size());
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

Vec2 middle_of(const Curve& curve) {
  Vec2 sum(0, 0);
  double length = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec2 a = point(curve, k), b = point(curve, (k + 1) % curve.size());
    sum += (b - a).norm() * 0.5 * (a + b);
    length += (b - a).norm();
  }
  return sum / length;
}

/// Rows to columns, as many, so that the sum is least (H. W. Kuhn, 1955, by shortest augmenting paths); infinite costs
/// are impossible. nullopt: there is no assignment.
std::optional<std::vector<Index>> assignment(const std::vector<std::vector<double>>& cost) {
  const auto n = static_cast<Index>(cost.size());
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> u(n + 1, 0), v(n + 1, 0);
  std::vector<Index> row_of(n + 1, n);  // of each column; column n is where a new row waits
  for (Index row = 0; row < n; ++row) {
    std::vector<double> least(n, infinite);
    std::vector<Index> from(n, n);
    std::vector<std::uint8_t> done(n + 1, 0);
    Index column = n;
    row_of[n] = row;
    do {
      done[column] = 1;
      const Index i = row_of[column];
      double step = infinite;
      Index next = n;
      for (Index j = 0; j < n; ++j) {
        if (done[j] != 0) continue;
        const double reduced = cost[i][j] - u[i] - v[j];
        if (reduced < least[j]) {
          least[j] = reduced;
          from[j] = column;
        }
        if (least[j] < step) {
          step = least[j];
          next = j;
        }
      }
      if (!(step < infinite)) return std::nullopt;
      for (Index j = 0; j <= n; ++j)
        if (done[j] != 0) {
          u[row_of[j]] += step;
          v[j] -= step;
        } else if (j < n) {
          least[j] -= step;
        }
      column = next;
    } while (row_of[column] != n);
    while (column != n) {
      const Index before = from[column];
      row_of[column] = row_of[before];
      column = before;
    }
    row_of[n] = n;
  }
  std::vector<Index> column_of(n);
  for (Index j = 0; j < n; ++j) column_of[row_of[j]] = j;
  return column_of;
}

class Pairing {
 public:
  Pairing(std::span<const Curve> start, std::span<const Curve> end, std::span<const std::array<std::int32_t, 2>> pairs)
      : start_(start),
        end_(end),
        start_parent_(parents_of(start)),
        end_parent_(parents_of(end)),
        wanted_(start.size(), -1),
        taken_(end.size(), -1) {
    for (const auto& [a, b] : pairs) {
      for (const auto& [side, number, curves] : {std::tuple("start", a, start), std::tuple("end", b, end)})
        if (number < 0 || static_cast<std::size_t>(number) >= curves.size())
          throw std::invalid_argument(
              fmt::format("a pair names curve {} of the {}, which has {}", number, side, curves.size()));
      if (wanted_[a] >= 0)
        throw std::invalid_argument(fmt::format("two pairs name {} of the start", name_of_curve(start[a], a)));
      if (taken_[b] >= 0)
        throw std::invalid_argument(fmt::format("two pairs name {} of the end", name_of_curve(end[b], b)));
      wanted_[a] = b;
      taken_[b] = a;
    }
    for (const auto& [a, b] : pairs) explain_pair(a, b);
    for (std::size_t c = 0; c < start.size(); ++c) start_middle_.push_back(middle_of(start[c]));
    for (std::size_t c = 0; c < end.size(); ++c) end_middle_.push_back(middle_of(end[c]));
  }

  std::vector<Index> made() {
    const std::optional<Matched> all = children_matched(-1, -1);
    if (!all) throw std::invalid_argument(why_none());
    std::vector<Index> partner(start_.size());
    for (const auto& [a, b] : all->pairs) partner[a] = b;
    return partner;
  }

 private:
  struct Matched {
    double cost = 0;
    std::vector<std::pair<Index, Index>> pairs;
  };

  static std::vector<Index> children(const std::vector<Index>& parent, Index of) {
    std::vector<Index> list;
    for (std::size_t c = 0; c < parent.size(); ++c)
      if (parent[c] == of) list.push_back(static_cast<Index>(c));
    return list;
  }

  void explain_pair(Index a, Index b) const {
    const Index p = start_parent_[a], q = end_parent_[b];
    const std::string pair = fmt::format("{} of the start cannot become {} of the end", name_of_curve(start_[a], a),
                                         name_of_curve(end_[b], b));
    if ((p < 0) != (q < 0))
      throw std::invalid_argument(fmt::format("{}: only {} lies in another curve, and no curve can leave one", pair,
                                              q < 0 ? "the former" : "the latter"));
    if (p >= 0 && wanted_[p] >= 0 && wanted_[p] != q)
      throw std::invalid_argument(fmt::format("{}: the curves in which they lie do not become each other", pair));
  }

  const std::optional<Matched>& matched(Index a, Index b) {
    const auto known = known_.find({a, b});
    if (known != known_.end()) return known->second;
    std::optional<Matched> made;
    if ((wanted_[a] < 0 || wanted_[a] == b) && (taken_[b] < 0 || taken_[b] == a)) made = children_matched(a, b);
    if (made) {
      made->cost += (start_middle_[a] - end_middle_[b]).norm();
      made->pairs.emplace_back(a, b);
    }
    return known_.emplace(std::pair(a, b), std::move(made)).first->second;
  }

  std::optional<Matched> children_matched(Index a, Index b) {
    const std::vector<Index> in_a = children(start_parent_, a), in_b = children(end_parent_, b);
    if (in_a.size() != in_b.size()) return std::nullopt;
    std::vector<std::vector<double>> cost;
    for (const Index c : in_a) {
      std::vector<double>& row = cost.emplace_back();
      for (const Index d : in_b) {
        const std::optional<Matched>& both = matched(c, d);
        row.push_back(both ? both->cost : std::numeric_limits<double>::infinity());
      }
    }
    const auto columns = assignment(cost);
    if (!columns) return std::nullopt;
    Matched made;
    for (std::size_t k = 0; k < in_a.size(); ++k) {
      const Matched& both = *matched(in_a[k], in_b[(*columns)[k]]);
      made.cost += both.cost;
      made.pairs.insert(made.pairs.end(), both.pairs.begin(), both.pairs.end());
    }
    return made;
  }

  /// A curve in which `others` lie, "2 within curve 0, 1 within none", for all curves that have any, most first.
  static std::string nesting_of(std::span<const Curve> curves, const std::vector<Index>& parent) {
    std::string text = fmt::format("{} in none", children(parent, -1).size());
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (const auto inside = children(parent, static_cast<Index>(c)); !inside.empty())
        text += fmt::format(", {} in {}", inside.size(), name_of_curve(curves[c], c));
    return text;
  }

  std::string why_none() const {
    const std::string sides =
        fmt::format("at the start {}; at the end {}", nesting_of(start_, start_parent_), nesting_of(end_, end_parent_));
    if (std::any_of(wanted_.begin(), wanted_.end(), [](Index b) { return b >= 0; })) {
      if (is_matched_without_pairs())
        return fmt::format(
            "the pairs that were given leave no way to pair the others so that curves lie in each other "
            "alike on both sides: {}",
            sides);
    }
    return fmt::format(
        "curves lie in each other differently at the start and at the end, and none can enter or leave "
        "another: {}",
        sides);
  }
  bool is_matched_without_pairs() const {
    try {
      Pairing(start_, end_, {}).made();
    } catch (const std::invalid_argument&) {
      return false;
    }
    return true;
  }

  std::span<const Curve> start_, end_;
  std::vector<Index> start_parent_, end_parent_, wanted_, taken_;
  std::vector<Vec2> start_middle_, end_middle_;
  std::map<std::pair<Index, Index>, std::optional<Matched>> known_;
};

}  // namespace

std::vector<Index> parents_of(std::span<const Curve> curves) {
  std::vector<Index> parent(curves.size(), -1);
  std::vector<double> area;
  for (const Curve& curve : curves) area.push_back(std::abs(signed_area(curve)));
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (std::size_t d = 0; d < curves.size(); ++d) {
      if (c == d || !contains(curves[d], point(curves[c], 0))) continue;
      if (parent[c] < 0 || area[d] < area[parent[c]]) parent[c] = static_cast<Index>(d);
    }
  return parent;
}

double signed_area(const Curve& curve) {
  double area = 0;
  const Vec2 origin = point(curve, 0);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Vec2 a = point(curve, k) - origin, b = point(curve, (k + 1) % curve.size()) - origin;
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

std::vector<Index> pair_curves(std::span<const Curve> start, std::span<const Curve> end,
                               std::span<const std::array<std::int32_t, 2>> pairs) {
  return Pairing(start, end, pairs).made();
}

}  // namespace unsnarl
