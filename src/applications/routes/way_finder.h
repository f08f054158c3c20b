#pragma once

#include <optional>
#include <vector>

#include "applications/routes/route_chains.h"
#include "applications/routes/segments.h"

namespace unsnarl {

/// Finds ways past obstacles: straight where that is clear, else the shortest on a grid (A*), pulled straight.
class WayFinder {
 public:
  /// plane: all ways have this z; nothing: any.
  WayFinder(const RoutePlan& plan, const ObstacleTriangles& triangles, std::optional<double> plane = {});

  /// A way from one place to another, at least `distance` from all obstacles. Steps near earlier ways, see avoid(),
  /// count as longer. Nothing if there is none on the grid.
  std::optional<std::vector<Vec3>> find(const Vec3& from, const Vec3& to, double distance);
  /// Makes later ways prefer to stay `distance` away from this one.
  void avoid(std::span<const Vec3> way, double distance);

 private:
  using Node = std::int64_t;
  std::array<Index, 3> place_of(Node node) const;
  Node offset_of(std::uint8_t step) const;
  Vec3 position(Node node) const;
  Node node_at(const std::array<Index, 3>& place) const;
  /// Distance of a node from the obstacles, up to `far_`.
  double distance_of(Node node);
  bool is_clear(Node a, Node b, double distance);
  std::vector<Node> nodes_around(const Vec3& p, double distance);
  std::vector<Vec3> pulled(const std::vector<Vec3>& way, double distance) const;

  const ObstacleTriangles& triangles_;
  Vec3 corner_;
  double cell_ = 0, far_ = 0;
  std::array<Index, 3> size_{};
  std::vector<float> distance_;      // of nodes that were asked for; below 0: not yet
  std::vector<std::uint8_t> crowd_;  // number of ways near each node
  std::vector<float> cost_;          // of the way to each node; infinite: not reached
  std::vector<std::uint8_t> step_;   // that led there
};

}  // namespace unsnarl
