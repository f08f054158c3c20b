#include "peer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "contact/intersection_finder.h"
#include "mesh/areas.h"
#include "recovery.h"
#include "scene/prepared_surface.h"
#include "unsnarl/samples.h"

namespace unsnarl::peers {
namespace {

constexpr double pi = std::numbers::pi;

/// A surface and what a method makes of it.
struct Try {
  PreparedSurface prepared;
  Outcome outcome;

  Try(std::string_view method, const Surface& surface, int most_iterations = 0) : prepared(prepare(surface, {})) {
    const Start start{prepared.rest, prepared.triangles()};
    const std::unique_ptr<Peer> peer = method_named(method).make(start);
    outcome = run(*peer, start, most_iterations, [] { return false; });
  }
  std::size_t pairs_before() const { return pairs(prepared.rest); }
  std::size_t pairs_after() const { return pairs(outcome.x); }
  double farthest() const { return (outcome.x - prepared.rest).colwise().norm().maxCoeff(); }
  double volume_ratio() const {
    return signed_volume(outcome.x, prepared.triangles()) / signed_volume(prepared.rest, prepared.triangles());
  }

 private:
  std::size_t pairs(const Positions& x) const { return IntersectionFinder(prepared.triangles()).find(x).size(); }
};

/// A surface of revolution around z with poles; `profile(s)`, s in [0, 1]: radius and height.
template <class Profile>
void add_revolved(Surface& surface, int steps, const Vec3& centre, double turn, Profile profile) {
  const int sides = 2 * steps, first = static_cast<int>(surface.positions.size() / 3);
  const auto add = [&](double radius, double height, double angle) {
    for (double c : {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle), centre[2] + height})
      surface.positions.push_back(c);
  };
  for (int i = 1; i < steps; ++i)
    for (int j = 0; j < sides; ++j) {
      const auto [radius, height] = profile(double(i) / steps);
      add(radius, height, turn + 2 * pi * j / sides);
    }
  const int south = first + (steps - 1) * sides, north = south + 1;
  add(0, profile(0.0).second, 0);
  add(0, profile(1.0).second, 0);
  const auto at = [&](int i, int j) { return first + i * sides + j % sides; };
  for (int j = 0; j < sides; ++j) {
    surface.corners.insert(surface.corners.end(), {south, at(0, j + 1), at(0, j)});
    surface.corners.insert(surface.corners.end(), {north, at(steps - 2, j), at(steps - 2, j + 1)});
    for (int i = 0; i + 1 < steps - 1; ++i) {
      surface.corners.insert(surface.corners.end(), {at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      surface.corners.insert(surface.corners.end(), {at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
}

/// Two balls of radius 1 whose caps overlap by this much.
Surface shallow_caps(double overlap) {
  Surface surface;
  const auto circle = [](double s) { return std::pair(std::sin(pi * s), -std::cos(pi * s)); };
  add_revolved(surface, 10, Vec3::Zero(), 0, circle);
  add_revolved(surface, 10, Vec3(2 - overlap, 0.03, 0.05), 0.1, circle);
  return surface;
}

/// Two balls on a thin neck, bent until they run through each other: closed, of genus zero.
Surface bent_dumbbell() {
  Surface surface;
  add_revolved(surface, 20, Vec3::Zero(), 0, [](double s) {
    const double z = -2 * std::cos(pi * s), from_ball = std::abs(z) - 1.4;
    return std::pair(std::max(0.15, std::sqrt(std::max(0.0, 0.36 - from_ball * from_ball))), z);
  });
  const double curvature = 1.6;
  for (std::size_t v = 0; v < surface.positions.size(); v += 3) {  // along z, bent around an axis along y
    const double angle = curvature * surface.positions[v + 2], radius = 1 / curvature - surface.positions[v];
    surface.positions[v] = 1 / curvature - radius * std::cos(angle);
    surface.positions[v + 2] = radius * std::sin(angle);
  }
  return surface;
}

/// A square of 12 x 12 cells: origin + i/12 along + j/12 across.
void add_square(Surface& surface, const Vec3& origin, const Vec3& along, const Vec3& across) {
  const int cells = 12, first = static_cast<int>(surface.positions.size() / 3);
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const Vec3 p = origin + along * i / cells + across * j / cells;
      surface.positions.insert(surface.positions.end(), {p[0], p[1], p[2]});
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int v = first + i * (cells + 1) + j, w = v + cells + 1;
      surface.corners.insert(surface.corners.end(), {v, w, w + 1, v, w + 1, v + 1});
    }
}

/// Moves the second of two balls along x, by a step of a list an iteration.
class Mover : public Peer {
 public:
  explicit Mover(std::vector<double> steps) : steps_(std::move(steps)) {}
  int most_iterations() const override { return 3; }
  bool step(const std::vector<IntersectingPair>& pairs, Positions& x) override {
    EXPECT_FALSE(pairs.empty());
    if (made_ == steps_.size()) return false;
    x.row(0).tail(x.cols() / 2).array() += steps_[made_++];
    return true;
  }

 private:
  std::vector<double> steps_;
  std::size_t made_ = 0;
};

TEST(Peers, TheStateWithTheFewestPairsIsKept) {
  const Surface caps = shallow_caps(0.8);
  const PreparedSurface prepared = prepare(caps, {});
  const Start start{prepared.rest, prepared.triangles()};
  const auto moved = [&](std::vector<double> steps, int most_iterations = 0, bool stop = false) {
    Mover mover(std::move(steps));
    return run(mover, start, most_iterations, [=] { return stop; });
  };
  const auto second_ball = [&](const Outcome& outcome) {
    return (outcome.x - prepared.rest).row(0)[prepared.rest.cols() - 1];
  };
  const Outcome better_then_worse = moved({0.6, -0.3, -0.3});
  EXPECT_EQ(better_then_worse.ended, "iterations");
  EXPECT_EQ(better_then_worse.iterations, 3);
  EXPECT_NEAR(second_ball(better_then_worse), 0.6, 1e-12);
  EXPECT_GT(better_then_worse.pairs_left, 0U);
  EXPECT_EQ(moved({1.0}).ended, "goal");
  EXPECT_EQ(moved({1.0}).pairs_left, 0U);
  EXPECT_EQ(moved({0.1}).ended, "own rule");
  EXPECT_EQ(moved({0.1, 0.1}, 1).iterations, 1);
  EXPECT_EQ(moved({0.1}, 0, true).ended, "time");
  const Outcome lost = moved({std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(lost.ended, "diverged");
  EXPECT_EQ(second_ball(lost), 0);
}

TEST(Peers, ContourMinimisationPartsShallowCaps) {
  for (const char* method : {"contours", "contours_whole"}) {
    const Try caps(method, shallow_caps(0.1));
    EXPECT_GT(caps.pairs_before(), 10U);
    EXPECT_EQ(caps.pairs_after(), 0U) << method;
    EXPECT_EQ(caps.outcome.ended, "goal");
    EXPECT_LT(caps.farthest(), 0.5) << "caps that overlap by 0.1";
    EXPECT_NEAR(caps.volume_ratio(), 1, 0.1);
  }
}

TEST(Peers, ColouringPartsShallowCaps) {
  const Try caps("colouring", shallow_caps(0.1));
  EXPECT_EQ(caps.pairs_after(), 0U);
  EXPECT_LT(caps.farthest(), 0.5);
}

TEST(Peers, ColouringEndsWhereNothingIsCutOut) {
  Surface crossed;  // two squares that run into each other from the side: the curve ends within both
  add_square(crossed, Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0));
  add_square(crossed, Vec3(0.03, -3, -1.03), Vec3(0, 2.8, 0.01), Vec3(0.01, 0, 2));
  const Try open("colouring", crossed);
  EXPECT_GT(open.pairs_before(), 0U);
  EXPECT_EQ(open.outcome.iterations, 0);
  EXPECT_EQ(open.outcome.ended, "own rule");
  EXPECT_EQ(open.farthest(), 0);
}

TEST(Peers, ConformalisedFlowEndsWhereADumbbellIsEmbedded) {
  const Try flowed("cmcf", bent_dumbbell());
  EXPECT_GT(flowed.pairs_before(), 10U);
  EXPECT_EQ(flowed.pairs_after(), 0U);
  EXPECT_EQ(flowed.outcome.ended, "goal");
}

TEST(Peers, ConformalisedFlowTurnsADumbbellIntoABall) {
  Surface dumbbell;
  add_revolved(dumbbell, 24, Vec3::Zero(), 0, [](double s) {
    const double z = 2 * s - 1;
    return std::pair(std::sin(pi * s) * (0.25 + 0.75 * z * z) + 0.02, 2 * z);
  });
  const PreparedSurface prepared = prepare(dumbbell, {});
  const Start start{prepared.rest, prepared.triangles()};
  const std::unique_ptr<Peer> peer = method_named("cmcf").make(start);
  Positions x = prepared.rest;
  const auto roundness = [&] {  // 1 for a sphere, by the isoperimetric inequality
    const double area = total_area(x, prepared.triangles());
    return 36 * pi * std::pow(signed_volume(x, prepared.triangles()), 2) / std::pow(area, 3);
  };
  EXPECT_LT(roundness(), 0.4);
  for (int k = 0; k < 250; ++k) ASSERT_TRUE(peer->step({}, x));
  EXPECT_GT(roundness(), 0.9);
  EXPECT_NEAR(total_area(x, prepared.triangles()), total_area(prepared.rest, prepared.triangles()), 1e-9);
}

TEST(Peers, ConformalisedFlowLeavesBallsWhereTheyAre) {
  const Try caps("cmcf", shallow_caps(0.1), 30);
  EXPECT_GT(caps.pairs_after(), 0U) << "nothing moves one ball away from the other";
}

TEST(Peers, RecoveryGoesBackFromTheFlow) {
  Try flowed("cmcf", bent_dumbbell());
  ASSERT_EQ(flowed.pairs_after(), 0U);
  const double before = flowed.farthest();
  recover_towards_rest(flowed.prepared, flowed.outcome.x, [] { return false; });
  EXPECT_EQ(flowed.pairs_after(), 0U);
  EXPECT_LT(flowed.farthest(), 0.7 * before);
}

TEST(Peers, SmoothingShrinksWhatIntersects) {
  const Try caps("smoothing", shallow_caps(0.1));
  EXPECT_EQ(caps.pairs_after(), 0U);
  EXPECT_LT(caps.volume_ratio(), 1);
  // Far from the caps nothing moves.
  Index still = 0;
  for (Index v = 0; v < caps.prepared.rest.cols(); ++v) still += caps.outcome.x.col(v) == caps.prepared.rest.col(v);
  EXPECT_GT(still, caps.prepared.rest.cols() / 4);
}

TEST(Peers, InstantRepairPartsTubes) {
  const Try tubes("isir", make_sample("crossing_tubes", 24));
  EXPECT_GT(tubes.pairs_before(), 0U);
  EXPECT_EQ(tubes.outcome.pairs_left, 0U);
  EXPECT_LE(tubes.outcome.iterations, 60);
}

TEST(Peers, ACleanSurfaceStays) {
  for (const Method& method : methods()) {
    const Try apart(method.name, shallow_caps(-0.1));
    EXPECT_EQ(apart.outcome.iterations, 0) << method.name;
    EXPECT_EQ(apart.farthest(), 0) << method.name;
  }
}

TEST(Peers, UnknownMethodsAreNamed) {
  try {
    method_named("contour");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("contours"), std::string::npos);
  }
}

}  // namespace
}  // namespace unsnarl::peers
