#pragma once

#include "scene/shapes.h"

namespace unsnarl::shapes {

/// A box around the origin, each side of n x n cells.
inline Shape box(const Vec3& size, Index n) {
  Shape shape;
  const auto side = [&](int axis, double sign) {
    return grid(n, n, false, [=](double i, double j) {
      Vec3 p;
      p[axis] = 0.5 * sign * size[axis];
      p[(axis + 1) % 3] = size[(axis + 1) % 3] * (i / n - 0.5);
      p[(axis + 2) % 3] = size[(axis + 2) % 3] * (sign > 0 ? j / n - 0.5 : 0.5 - j / n);
      return p;
    });
  };
  Shape sides;
  for (int axis = 0; axis < 3; ++axis) sides.add(side(axis, 1)).add(side(axis, -1));
  std::vector<Index> name;  // of each point of the sides in the box
  for (const Vec3& p : sides.points) {
    const auto same = [&](const Vec3& q) { return (p - q).norm() < 1e-9 * size.norm(); };
    const auto known = std::find_if(shape.points.begin(), shape.points.end(), same);
    name.push_back(static_cast<Index>(known - shape.points.begin()));
    if (known == shape.points.end()) shape.points.push_back(p);
  }
  for (const Triangle& t : sides.triangles) shape.triangles.push_back({name[t[0]], name[t[1]], name[t[2]]});
  return shape;
}

/// It about the z axis.
inline Shape turned(Shape shape, double radians) {
  for (Vec3& p : shape.points) p = Eigen::AngleAxisd(radians, Vec3::UnitZ()) * p;
  return shape;
}

/// The number of the shape, of several added one after another, that each vertex is of.
inline std::vector<Index> parts_of(std::initializer_list<const Shape*> shapes) {
  std::vector<Index> part;
  Index number = 0;
  for (const Shape* shape : shapes) part.insert(part.end(), shape->points.size(), number++);
  return part;
}

}  // namespace unsnarl::shapes
