#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "applications/curves/files/path_data.h"

namespace unsnarl {

/// The positions at which the points of moved curves are written. Points at the same position (a joint) are written at
/// the same position: coordinates that a point of the file has kept stay as they are, the others are rounded.
class WrittenPlaces {
 public:
  /// own: the curves of the file; moved: as many, with points moved or inserted. rounding: a length; 0: all digits.
  WrittenPlaces(std::span<const Curve> own, std::span<const Curve> moved, double rounding);

  Vec2 operator()(const Vec2& moved) const;
  /// Has a point of the file this position before and after?
  bool is_kept(const Vec2& moved) const;

 private:
  using Place = std::array<double, 2>;
  std::map<Place, std::array<bool, 2>> kept_;
  double rounding_;
};

/// The same for points in elements of a drawing that have transforms of their own.
class TransformedPlaces {
 public:
  TransformedPlaces(std::span<const Curve> own, std::span<const Curve> moved, double rounding);

  /// A point of this position is to be written in an element of this transform. All of them, before the first local().
  void expect(const Vec2& moved, const Affine& transform);
  /// Its coordinates in the element. Points of one position are read back at one position wherever doubles of all
  /// elements allow it; the check of the written file finds where they do not.
  Vec2 local(const Vec2& moved, const Affine& transform);
  /// Are there several points of this position among those of the moved curves?
  bool is_shared(const Vec2& moved) const;
  /// The coordinates of a control in an element: rounded, whatever else is near.
  Vec2 control(const Vec2& at, const Affine& transform) const;
  /// Would coordinates in the element be read at the position that all points of this one are to be read at?
  bool is_read_as(const Vec2& moved, const Vec2& local, const Affine& transform);

 private:
  using Place = std::array<double, 2>;
  struct Use {
    std::vector<Affine> transforms;  ///< without doubles
    std::optional<Vec2> read;        ///< the position that all are to be read as
  };
  std::optional<Vec2> local_of(const Vec2& read, const Affine& transform) const;
  Vec2 choose(const Vec2& moved, const Use& use) const;

  WrittenPlaces kept_;
  std::map<Place, Use> uses_;
  std::map<Place, int> counts_;  ///< of the points of the moved curves
  double rounding_;
};

}  // namespace unsnarl
