#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>

namespace unsnarl {

/// Vertex, face, corner and edge ids: 0-based, never negative.
using Index = std::int32_t;
using Vec3 = Eigen::Vector3d;
/// One column per vertex: x, y, z contiguous in memory.
using Positions = Eigen::Matrix3Xd;
/// The three vertices of a triangle, in order.
using Triangle = std::array<Index, 3>;
/// It covers a segment or a point.
inline bool uses_a_vertex_twice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}
/// Two vertices, smaller id first.
using Edge = std::array<Index, 2>;

}  // namespace unsnarl
