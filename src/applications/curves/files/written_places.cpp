#include "applications/curves/files/written_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "applications/curves/files/curve_file.h"

namespace unsnarl {
namespace {

using WrittenPlace = std::array<double, 2>;

/// A coordinate that is read as wanted is looked for among this many neighbouring doubles to either side: a rotation
/// reaches a given position from about one of them (unit: units in the last place)
constexpr int neighbours_looked_at = 3;

WrittenPlace place_at(const Curve& curve, std::size_t k) {
  return {curve.points[2 * k], curve.points[2 * k + 1]};
}

Vec2 into_element(const Vec2& p, const Affine& transform) {
  return transform.is_identity() ? p : Vec2(transform.linear.inverse() * (p - transform.offset));
}

Vec2 rounded_point(const Vec2& p, double rounding) {
  return {rounded(p.x(), rounding), rounded(p.y(), rounding)};
}

double stepped(double value, int steps) {
  const double to = steps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int k = 0; k < std::abs(steps); ++k) value = std::nextafter(value, to);
  return value;
}

/// p and the doubles around it, until `is_found` takes one of them.
template <class Found>
bool look_around(const Vec2& p, Found&& is_found) {
  for (int reach = 0; reach <= neighbours_looked_at; ++reach)
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j)
        if (std::max(std::abs(i), std::abs(j)) == reach && is_found(Vec2(stepped(p.x(), i), stepped(p.y(), j))))
          return true;
  return false;
}

bool is_same(const Affine& a, const Affine& b) {
  return a.linear == b.linear && a.offset == b.offset;
}

/// Divisors are kept above this, so that none is zero (fixed by float64)
constexpr double least_transform_scale = 1e-300;

double rounding_within(const Affine& transform, double rounding) {
  return rounding / std::max(transform.scale(), least_transform_scale);
}

}  // namespace

WrittenPlaces::WrittenPlaces(std::span<const Curve> own, std::span<const Curve> moved, double rounding)
    : rounding_(rounding) {
  for (std::size_t c = 0; c < moved.size(); ++c) {
    const bool is_as_long = moved[c].size() == own[c].size();
    std::set<WrittenPlace> places;
    for (std::size_t k = 0; !is_as_long && k < own[c].size(); ++k) places.insert(place_at(own[c], k));
    for (std::size_t k = 0; k < moved[c].size(); ++k) {
      const WrittenPlace now = place_at(moved[c], k);
      std::array<bool, 2>& kept = kept_[now];
      for (std::size_t axis = 0; axis < 2; ++axis)
        kept[axis] |= is_as_long ? now[axis] == place_at(own[c], k)[axis] : places.contains(now);
    }
  }
}

Vec2 WrittenPlaces::operator()(const Vec2& moved) const {
  const auto found = kept_.find({moved.x(), moved.y()});
  Vec2 result = rounded_point(moved, rounding_);
  for (int axis = 0; found != kept_.end() && axis < 2; ++axis)
    if (found->second[axis]) result[axis] = moved[axis];
  return result;
}

bool WrittenPlaces::is_kept(const Vec2& moved) const {
  const auto found = kept_.find({moved.x(), moved.y()});
  return found != kept_.end() && found->second[0] && found->second[1];
}

TransformedPlaces::TransformedPlaces(std::span<const Curve> own, std::span<const Curve> moved, double rounding)
    : kept_(own, moved, rounding), rounding_(rounding) {
  for (const Curve& curve : moved)
    for (std::size_t k = 0; k < curve.size(); ++k) ++counts_[place_at(curve, k)];
}

bool TransformedPlaces::is_shared(const Vec2& moved) const {
  const auto found = counts_.find({moved.x(), moved.y()});
  return found != counts_.end() && found->second > 1;
}

Vec2 TransformedPlaces::control(const Vec2& at, const Affine& transform) const {
  return rounded_point(into_element(at, transform), rounding_within(transform, rounding_));
}

void TransformedPlaces::expect(const Vec2& moved, const Affine& transform) {
  std::vector<Affine>& known = uses_[{moved.x(), moved.y()}].transforms;
  if (std::none_of(known.begin(), known.end(), [&](const Affine& other) { return is_same(other, transform); }))
    known.push_back(transform);
}

std::optional<Vec2> TransformedPlaces::local_of(const Vec2& read, const Affine& transform) const {
  const Vec2 near = into_element(read, transform);
  std::optional<Vec2> result;
  const auto is_read_so = [&](const Vec2& p) {
    if (transform(p) == read) result = p;
    return result.has_value();
  };
  if (!is_read_so(rounded_point(near, rounding_within(transform, rounding_)))) look_around(near, is_read_so);
  return result;
}

Vec2 TransformedPlaces::choose(const Vec2& moved, const Use& use) const {
  const auto is_expressed_by = [&](const Affine& transform) { return local_of(moved, transform).has_value(); };
  if (kept_.is_kept(moved) &&
      (use.transforms.size() == 1 || std::all_of(use.transforms.begin(), use.transforms.end(), is_expressed_by)))
    return moved;
  // Around the coordinates in each element, for one of these that the other elements can express too.
  const auto near_in = [&](const Affine& transform) {
    return rounded_point(into_element(moved, transform), rounding_within(transform, rounding_));
  };
  Vec2 result = use.transforms.front()(near_in(use.transforms.front()));
  if (use.transforms.size() == 1) return result;
  for (const Affine& base : use.transforms) {
    const bool is_found = look_around(near_in(base), [&](const Vec2& p) {
      const Vec2 read = base(p);
      const bool fits = std::all_of(use.transforms.begin(), use.transforms.end(),
                                    [&](const Affine& other) { return local_of(read, other).has_value(); });
      if (fits) result = read;
      return fits;
    });
    if (is_found) break;
  }
  return result;
}

bool TransformedPlaces::is_read_as(const Vec2& moved, const Vec2& local, const Affine& transform) {
  Use& use = uses_.at({moved.x(), moved.y()});
  if (!use.read) use.read = choose(moved, use);
  return transform(local) == *use.read;
}

Vec2 TransformedPlaces::local(const Vec2& moved, const Affine& transform) {
  Use& use = uses_.at({moved.x(), moved.y()});
  if (!use.read) use.read = choose(moved, use);
  return local_of(*use.read, transform)
      .value_or(rounded_point(into_element(*use.read, transform), rounding_within(transform, rounding_)));
}

}  // namespace unsnarl
