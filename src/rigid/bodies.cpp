#include "rigid/bodies.h"

#include <algorithm>
#include <cmath>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"

namespace unsnarl {

double Body::squared_displacement() const {
  const Eigen::Matrix3d turn = rotation - Eigen::Matrix3d::Identity();
  return static_cast<double>(vertices.size()) * (centre - rest_centre).squaredNorm() +
         (turn * moments * turn.transpose()).trace();
}

Bodies::Bodies(const Positions& rest, std::span<const Triangle> triangles, std::span<const Index> body_of, Index count,
               std::span<const std::uint8_t> fixed, Passing passing)
    : rest_(rest),
      x_(rest),
      triangles_(triangles),
      passing_(passing),
      bodies_(count),
      body_of_(body_of.begin(), body_of.end()),
      is_present_(count, 1) {
  for (Index v = 0; v < static_cast<Index>(body_of.size()); ++v)
    if (body_of[v] >= 0) bodies_[body_of[v]].vertices.push_back(v);
  owner_.resize(triangles.size(), soft);
  boxes_.resize(triangles.size());
  for (Index t = 0; t < static_cast<Index>(triangles.size()); ++t) {
    const Triangle& corners = triangles[t];
    const auto any_of_body = [&](Index v) { return body_of[v] >= 0; };
    if (std::any_of(corners.begin(), corners.end(), any_of_body)) {
      const Index body = body_of[corners[0]];
      const bool is_whole = body_of[corners[1]] == body && body_of[corners[2]] == body;
      owner_[t] = is_whole ? body : mixed;
      if (is_whole) bodies_[body].triangles.push_back(t);
    } else if (std::all_of(corners.begin(), corners.end(), [&](Index v) { return !fixed.empty() && fixed[v]; })) {
      owner_[t] = obstacle;
    }
    boxes_[t] = box_of(x_, corners);
  }
  tree_.build(boxes_);
  for (Body& body : bodies_) {
    if (body.vertices.empty()) continue;
    Box box;
    for (Index v : body.vertices) {
      body.rest_centre += rest.col(v);
      box.extend(Vec3(rest.col(v)));
    }
    body.rest_centre /= static_cast<double>(body.vertices.size());
    for (Index v : body.vertices) {
      const Vec3 q = rest.col(v) - body.rest_centre;
      body.moments += q * q.transpose();
    }
    for (Index t : body.triangles) body.area += triangle_area(rest, triangles[t]);
    body.diagonal = box.diagonal();
    body.centre = body.rest_centre;
  }
}

void Bodies::move(const Body& body) {
  const bool rests = body.is_at_rest();
  for (Index v : body.vertices)
    x_.col(v) = rests ? Vec3(rest_.col(v)) : Vec3(body.rotation * (rest_.col(v) - body.rest_centre) + body.centre);
}

void Bodies::settle(const Body& body) {
  for (Index t : body.triangles) boxes_[t] = box_of(x_, triangles_[t]);
  tree_.refit(boxes_, body.triangles);
}

double Bodies::largest_displacement(const Body& body) const {
  double largest = 0;
  for (Index v : body.vertices) largest = std::max(largest, (x_.col(v) - rest_.col(v)).squaredNorm());
  return std::sqrt(largest);
}

bool Bodies::is_obstacle_to(const Body& body, Index u) const {
  const Index owner = owner_[u];
  if (owner >= 0) return &bodies_[owner] != &body && is_present_[owner];
  return owner == obstacle || (owner == soft && body.avoids_soft);
}

bool Bodies::is_free(const Body& body) const {
  // Positions are not finite if squares of coordinates beyond 2^500 overflowed on the way.
  for (Index v : body.vertices)
    if (!x_.col(v).allFinite()) return false;
  const auto count = static_cast<Index>(body.triangles.size());
  // The triangle that made the last place not free is tested first: it often does so at places nearby too.
  const Index first = last_hit_ < count ? last_hit_ : 0;
  for (Index k = 0; k < count; ++k) {
    const Index i = (first + k) % count, t = body.triangles[i];
    const bool meets = tree_.find(box_of(x_, triangles_[t]), [&](Index u) {
      PairClass kind;
      return is_obstacle_to(body, u) && passing_.meet(triangles_, t, u) &&
             intersects(x_, triangles_[t], triangles_[u], kind);
    });
    if (!meets) continue;
    last_hit_ = i;
    return false;
  }
  return true;
}

std::vector<IntersectingPair> Bodies::contacts_of(const Body& body) const {
  std::vector<IntersectingPair> contacts;
  near_triangles(body, 0, [&](Index t, Index u) {
    PairClass kind;
    if (intersects(x_, triangles_[t], triangles_[u], kind)) contacts.push_back({t, u, kind});
  });
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace unsnarl
