#include "rigid/recover_bodies.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "contact/distances.h"
#include "geometry/rotation.h"

namespace unsnarl {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;  // translation, then rotation vector in radians
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Longest motion of a vertex in the first step (unit: largest displacement at the start)
constexpr double first_reach = 0.02;
/// Longest motion of a vertex in any step; the number of contacts within reach grows with its square (unit: largest
/// displacement at the start)
constexpr double largest_reach = 0.1;
/// The reach grows by this factor after a step that is kept (no unit)
constexpr double reach_growth = 1.5;
constexpr double reach_cut = 0.5;  ///< The reach is this share of a step that was not kept (no unit)
/// The way back ends where steps are shorter than this (unit: largest displacement at the start)
constexpr double least_reach = 1e-4;
/// The way back ends where a step lowers the sum of squared displacements by less than this share (no unit)
constexpr double least_gain = 1e-4;
/// Contacts are aimed at this much above the wanted gap: room for what linearisation leaves out, so that steps along a
/// contact need not be tiny (unit: largest displacement at the start)
constexpr double contact_share = 1e-3;
/// Steps of the way back, at most, where contacts let it creep (unit: steps)
constexpr int most_steps = 200;
constexpr int most_sweeps = 200;  ///< Sweeps over the contacts of a step, at most (unit: sweeps)
/// Sweeps end where no force changes by more than this (unit: largest force)
constexpr double sweep_tolerance = 1e-6;
/// Moment of inertia that is added where the vertices lie on a line (unit: trace of the moments)
constexpr double least_moment = 1e-9;

/// A distance that must not fall below `gap`, linearised: distance + sum of gradient . step over its bodies.
struct BodyContact {
  double distance = 0, gap = 0;
  std::array<Index, 2> body = {-1, -1};  // -1: does not move
  std::array<Vec6, 2> gradient = {Vec6::Zero(), Vec6::Zero()};
};

class BodyRecovery {
 public:
  BodyRecovery(Bodies& bodies, const RecoverBodiesOptions& options) : bodies_(bodies), options_(options) {
    // A vertex is listed as an edge from itself to itself. What has two owners is listed once for each.
    std::vector<std::array<Index, 5>> entries;  // edge, owner, triangle, bit
    for (Index t = 0; t < static_cast<Index>(bodies.triangles().size()); ++t)
      for (Index k = 0; k < 3; ++k) {
        const Triangle& corners = bodies.triangles()[t];
        const Edge edge = ordered(corners[k], corners[(k + 1) % 3]);
        entries.push_back({corners[k], corners[k], bodies.owner_of_triangle(t), t, k});
        entries.push_back({edge[0], edge[1], bodies.owner_of_triangle(t), t, 3 + k});
      }
    std::sort(entries.begin(), entries.end());
    owned_.assign(bodies.triangles().size(), 0);
    for (std::size_t e = 0; e < entries.size(); ++e)
      if (e == 0 || !std::equal(entries[e].begin(), entries[e].begin() + 3, entries[e - 1].begin()))
        owned_[entries[e][3]] |= static_cast<std::uint8_t>(1 << entries[e][4]);
  }

  void run() {
    double scale = largest_displacement();
    contact_gap_ = options_.min_gap;
    if (options_.opens_gaps_at_rest) scale = std::max(scale, lack_of_gap(contacts_within(0)));
    if (!(scale > 0)) return;
    contact_gap_ += contact_share * scale;
    double reach = first_reach * scale, cost = squared_displacement();
    std::vector<BodyContact> contacts = contacts_within(reach);
    for (int step = 0; step < most_steps && reach > least_reach * scale; ++step) {
      if (options_.stop && options_.stop()) return;
      const std::vector<Vec6> steps = steps_of(contacts, reach);
      const double length = longest(steps);
      if (!(length > least_reach * scale)) return;
      const std::vector<Body> before(bodies_.list().begin(), bodies_.list().end());
      take(steps);
      const double new_cost = squared_displacement();
      bool is_kept = largest_displacement() <= options_.most_motion && are_free(), is_done = false;
      if (is_kept) {
        const double new_reach = std::min(reach_growth * reach, largest_reach * scale);
        std::vector<BodyContact> new_contacts = contacts_within(new_reach);
        const double lack = lack_of_gap(contacts), new_lack = lack_of_gap(new_contacts);
        is_kept = new_lack < lack || (new_lack <= 0 && new_cost < cost);
        is_done = is_kept && lack <= 0 && cost - new_cost < least_gain * cost;
        if (is_kept) {
          cost = new_cost;
          reach = new_reach;
          contacts = std::move(new_contacts);
        }
      }
      if (is_done) return;
      if (is_kept) continue;
      go_back(before);
      reach = reach_cut * length;
    }
  }

 private:
  bool moves(Index b) const { return b >= 0 && bodies_.list()[b].is_placed && !bodies_.list()[b].vertices.empty(); }

  double largest_displacement() const {
    double largest = 0;
    for (const Body& body : bodies_.list()) largest = std::max(largest, bodies_.largest_displacement(body));
    return largest;
  }
  double squared_displacement() const {
    double sum = 0;
    for (const Body& body : bodies_.list()) sum += body.squared_displacement();
    return sum;
  }
  bool are_free() const {
    return std::all_of(bodies_.list().begin(), bodies_.list().end(),
                       [&](const Body& body) { return !body.is_placed || bodies_.is_free(body); });
  }

  /// By how much a contact falls short of the gap that was asked for.
  double lack_of_gap(std::span<const BodyContact> contacts) const {
    double lack = 0;
    for (const BodyContact& contact : contacts)
      lack = std::max(lack, std::min(options_.min_gap, contact.gap) - contact.distance);
    return lack;
  }

  /// The contacts that steps of this length could bring below the gap.
  std::vector<BodyContact> contacts_within(double reach) const {
    const double radius = contact_gap_ + 2 * reach;
    std::vector<Stencil> stencils;
    for (const Body& body : bodies_.list()) {
      if (!body.is_placed) continue;
      bodies_.near_triangles(body, radius, [&](Index t, Index u) {
        // A pair of two bodies is visited from both sides.
        if (bodies_.owner_of_triangle(u) < 0 || t < u) add_stencils(t, u, stencils);
      });
    }
    std::vector<BodyContact> contacts;
    for (const Stencil& stencil : stencils) {
      if (!(squared_distance(stencil, bodies_.x()) < radius * radius)) continue;
      contacts.push_back(linearised(stencil, closest(stencil, bodies_.x())));
    }
    return contacts;
  }

  void add_stencils(Index t, Index u, std::vector<Stencil>& stencils) const {
    const Triangle &a = bodies_.triangles()[t], &b = bodies_.triangles()[u];
    for (int i = 0; i < 3; ++i) {
      if (looks_after(t, i)) stencils.push_back({StencilKind::vertex_face, {a[i], b[0], b[1], b[2]}});
      if (looks_after(u, i)) stencils.push_back({StencilKind::vertex_face, {b[i], a[0], a[1], a[2]}});
      for (int j = 0; j < 3; ++j) {
        if (!looks_after(t, 3 + i) || !looks_after(u, 3 + j)) continue;
        stencils.push_back({StencilKind::edge_edge, {a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]}});
      }
    }
  }

  /// Whether t is the first triangle at its corner k, or at its edge from corner k - 3: no stencil is met twice.
  bool looks_after(Index t, int k) const { return (owned_[t] >> k & 1) != 0; }

  static Edge ordered(Index a, Index b) { return a < b ? Edge{a, b} : Edge{b, a}; }

  BodyContact linearised(const Stencil& stencil, const Closest& nearest) const {
    BodyContact contact;
    contact.distance = nearest.distance;
    bool are_at_rest = true;
    for (int i = 0; i < 4; ++i) {
      const Index b = bodies_.body_of_vertex(stencil.v[i]);
      if (b < 0) continue;
      const Body& body = bodies_.list()[b];
      are_at_rest &= body.is_at_rest();
      if (!moves(b)) continue;
      const int side = contact.body[0] < 0 || contact.body[0] == b ? 0 : 1;
      contact.body[side] = b;
      const Vec3 force = nearest.weights[i] * nearest.direction;
      contact.gradient[side].head<3>() += force;
      contact.gradient[side].tail<3>() += Vec3(bodies_.x().col(stencil.v[i]) - body.centre).cross(force);
    }
    contact.gap = are_at_rest && !options_.opens_gaps_at_rest ? std::min(contact_gap_, contact.distance) : contact_gap_;
    return contact;
  }

  /// The best steps under the linearised contacts, all shortened so that no vertex moves farther than `reach`.
  std::vector<Vec6> steps_of(std::span<const BodyContact> contacts, double reach) const {
    const std::span<const Body> list = bodies_.list();
    std::vector<Vec6> steps(list.size(), Vec6::Zero());
    std::vector<Mat6> inverse(list.size(), Mat6::Zero());
    for (std::size_t b = 0; b < list.size(); ++b) {
      const Body& body = list[b];
      if (!moves(static_cast<Index>(b)) || !(body.moments.trace() > 0)) continue;
      const auto count = static_cast<double>(body.vertices.size());
      const Eigen::Matrix3d moments = body.rotation * body.moments * body.rotation.transpose();
      const Eigen::Matrix3d inertia = (1 + least_moment) * body.moments.trace() * Eigen::Matrix3d::Identity() - moments;
      inverse[b].topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / count;
      inverse[b].bottomRightCorner<3, 3>() = inertia.inverse();
      // The gradient of half the sum of squared displacements.
      const Eigen::Matrix3d turned = body.rotation * body.moments;
      Vec6 gradient;
      gradient.head<3>() = count * (body.centre - body.rest_centre);
      gradient.tail<3>() = -Vec3(turned(1, 2) - turned(2, 1), turned(2, 0) - turned(0, 2), turned(0, 1) - turned(1, 0));
      steps[b] = -inverse[b] * gradient;
    }
    std::vector<double> force(contacts.size(), 0);
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      double largest = 0, change = 0;
      for (std::size_t k = 0; k < contacts.size(); ++k) {
        const BodyContact& contact = contacts[k];
        double response = 0, reached = contact.distance;
        for (int side = 0; side < 2; ++side) {
          if (contact.body[side] < 0) continue;
          const Vec6& g = contact.gradient[side];
          response += g.dot(inverse[contact.body[side]] * g);
          reached += g.dot(steps[contact.body[side]]);
        }
        if (!(response > 0)) continue;
        const double wanted = std::max(0.0, force[k] + (contact.gap - reached) / response);
        const double more = wanted - force[k];
        force[k] = wanted;
        largest = std::max(largest, wanted);
        change = std::max(change, std::abs(more));
        if (more == 0) continue;
        for (int side = 0; side < 2; ++side)
          if (const Index b = contact.body[side]; b >= 0) steps[b] += more * (inverse[b] * contact.gradient[side]);
      }
      if (change <= sweep_tolerance * largest) break;
    }
    if (const double length = longest(steps); length > reach)
      for (Vec6& step : steps) step *= reach / length;
    return steps;
  }

  /// How far a vertex goes, at most.
  double longest(std::span<const Vec6> steps) const {
    double longest = 0;
    for (std::size_t b = 0; b < steps.size(); ++b) {
      if (steps[b] == Vec6::Zero()) continue;
      const Body& body = bodies_.list()[b];
      for (Index v : body.vertices) {
        const Vec3 arm = bodies_.x().col(v) - body.centre;
        longest = std::max(longest, (steps[b].head<3>() + steps[b].tail<3>().cross(arm)).norm());
      }
    }
    return longest;
  }

  void take(std::span<const Vec6> steps) {
    for (std::size_t b = 0; b < steps.size(); ++b) {
      if (steps[b] == Vec6::Zero()) continue;
      Body& body = bodies_.list()[b];
      body.centre += steps[b].head<3>();
      body.rotation = rotation_by(steps[b].tail<3>()) * body.rotation;
      bodies_.move(body);
      bodies_.settle(body);
    }
  }

  void go_back(std::span<const Body> before) {
    for (std::size_t b = 0; b < before.size(); ++b) {
      Body& body = bodies_.list()[b];
      if (body.centre == before[b].centre && body.rotation == before[b].rotation) continue;
      body.centre = before[b].centre;
      body.rotation = before[b].rotation;
      bodies_.move(body);
      bodies_.settle(body);
    }
  }

  Bodies& bodies_;
  const RecoverBodiesOptions& options_;
  std::vector<std::uint8_t> owned_;  // per triangle: bit k: it is the first at its corner k; bit 3 + k: at its edge k
  double contact_gap_ = 0;           // gap that contacts are aimed at, a length
};

}  // namespace

void recover_bodies(Bodies& bodies, const RecoverBodiesOptions& options) {
  BodyRecovery(bodies, options).run();
}

}  // namespace unsnarl
