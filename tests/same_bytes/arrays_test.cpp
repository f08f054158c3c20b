#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "same_bytes/known_hashes.h"
#include "unsnarl/curves.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/repair.h"
#include "unsnarl/routes.h"
#include "unsnarl/samples.h"
#include "unsnarl/seifert.h"
#include "unsnarl/sequence.h"

/// The same input gives the same bytes on every processor, by every compiler and with every standard library that the
/// project is built for.
namespace unsnarl {
namespace {

using same_bytes::Bytes;
using same_bytes::expect_known;

constexpr int coarse = 14, finer = 20;  // resolutions; small, since an emulator may run this

Bytes repaired(const Surface& surface, const RepairOptions& options) {
  const RepairResult result = repair(surface, options);
  return Bytes() << surface.positions << surface.corners << result.status << result.report.before.total()
                 << result.report.after.total() << result.positions;
}

class Samples : public testing::TestWithParam<std::string> {};

TEST_P(Samples, repaired) {
  const std::string name = GetParam();
  expect_known(name, repaired(make_sample(name, coarse), {}));
}

std::vector<std::string> analytic_samples() {
  std::vector<std::string> names;
  for (const Sample& sample : all_samples().first(analytic_sample_count)) names.push_back(sample.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(same_bytes, Samples, testing::ValuesIn(analytic_samples()),
                         [](const auto& which) { return which.param; });

TEST(same_bytes_of_arrays, other_resolutions) {
  for (const char* name : {"book", "swallowtail", "hair_cards", "overlapping_quads", "medusa"})
    expect_known(std::string(name) + ", finer", repaired(make_sample(name, finer), {}));
}

TEST(same_bytes_of_arrays, options) {
  std::map<std::string, std::pair<std::string, RepairOptions>> cases;
  const auto with = [&](const std::string& name, const std::string& sample, const auto& set) {
    RepairOptions options;
    set(options);
    cases[name] = {sample, options};
  };
  with("gap", "crossing_tubes", [](RepairOptions& o) { o.min_gap_rel = 0.002; });
  with("dihedral angles", "overlapping_quads", [](RepairOptions& o) { o.min_dihedral_deg = 5; });
  with("goal of the paper", "overlapping_quads", [](RepairOptions& o) { o.goal = Goal::disjoint; });
  with("method of the paper", "crossing_tubes", [](RepairOptions& o) { o.paper.emplace(); });
  with("each component", "hair_cards", [](RepairOptions& o) { o.each_component = true; });
  with("float64", "crossing_tubes", [](RepairOptions& o) { o.precision = Precision::float64; });
  with("largest displacement", "intersecting_spheres", [](RepairOptions& o) { o.max_displacement_rel = 0.02; });
  with("without going back", "crossing_tubes", [](RepairOptions& o) { o.recover = false; });
  for (const auto& [name, of] : cases) expect_known(name, repaired(make_sample(of.first, finer), of.second));
}

TEST(same_bytes_of_arrays, rigid_parts) {
  const Surface surface = make_sample("intersecting_spheres", coarse);
  RepairOptions options;
  options.rigid.assign(SurfaceView(surface).vertex_count(), -1);
  const std::size_t half = SurfaceView(surface).vertex_count() / 2;
  for (std::size_t v = 0; v < half; ++v) options.rigid[v] = 0;
  for (std::size_t v = half; v < SurfaceView(surface).vertex_count(); ++v) options.rigid[v] = 1;
  expect_known("rigid parts", repaired(surface, options));
}

/// Two tubes that move through each other.
TEST(same_bytes_of_arrays, sequence) {
  const Surface surface = make_sample("crossing_tubes", coarse);
  SequenceSource source;
  source.corners = surface.corners;
  source.offsets = surface.offsets;
  source.frames = 9;
  source.positions = [&](std::size_t frame) {
    std::vector<double> positions = surface.positions;
    for (std::size_t k = 0; k < positions.size() / 2; k += 3) positions[k] += 0.03 * static_cast<double>(frame);
    return positions;
  };
  Bytes bytes;
  const auto reports =
      repair_sequence(source, {}, [&](FrameResult&& frame) { bytes << frame.report.status << frame.positions; });
  for (const FrameReport& report : reports)
    if (report.jitter) bytes << report.jitter->mean_rel << report.jitter->max_rel;
  expect_known("sequence", bytes);
}

TEST(same_bytes_of_arrays, curves) {
  for (const std::string_view kind : random_curve_kinds()) {
    const std::vector<Curve> curves{random_closed_curve(kind, 7, 60)};
    const CurveResult result = untangle_curves(curves);
    expect_known("curve, " + std::string(kind), Bytes()
                                                    << curves[0].points << result.status << result.curves[0].points);
  }
}

TEST(same_bytes_of_arrays, planar_isotopy) {
  const auto star = [](int corners, double phase) {
    Curve curve;
    curve.closed = true;
    for (int k = 0; k < corners; ++k) {  // on a square, so that no function of the C library is due
      const double t = (4.0 * k / corners) + phase, part = t - std::floor(t);
      const int side = static_cast<int>(std::floor(t)) % 4;
      const double r = k % 2 == 0 ? 1 : 0.4;
      const double x[] = {1, 1 - 2 * part, -1, 2 * part - 1}, y[] = {2 * part - 1, 1, 1 - 2 * part, -1};
      curve.points.push_back(r * x[side]);
      curve.points.push_back(r * y[side]);
    }
    return curve;
  };
  const std::vector<Curve> start{star(12, 0.1)}, end{star(20, 0.3)};
  const Isotopy made = planar_isotopy(start, end);
  Bytes bytes;
  bytes << made.status;
  for (const IsotopyRing& ring : made.rings) bytes << ring.time << ring.curves[0];
  expect_known("planar isotopy", bytes);
}

TEST(same_bytes_of_arrays, knot_isotopy) {
  const std::vector<int> braid{1, 1, 1};
  KnotIsotopyOptions options;
  options.points = 60;
  const KnotIsotopy made = knot_isotopy(knot_of_table("3_1"), braid_closure(2, braid, 6), options);
  Bytes bytes;
  bytes << made.status;
  for (const KnotRing& ring : made.rings) bytes << ring.time << ring.points;
  expect_known("knot isotopy", bytes);
}

TEST(same_bytes_of_arrays, seifert_surface) {
  const SeifertResult made = seifert_surface(knot_of_table("4_1"));
  expect_known("Seifert surface", Bytes() << made.status << made.surface.positions << made.surface.corners);
}

TEST(same_bytes_of_arrays, routes) {
  const RoutePlan plan = sample_route_plan(route_plan_samples().front().name);
  const RoutesResult made = plan_routes(plan);
  Bytes bytes;
  bytes << made.status;
  for (const Route& route : made.routes) bytes << route.points;
  expect_known("routes", bytes);
}

}  // namespace
}  // namespace unsnarl
