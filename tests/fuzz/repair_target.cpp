#include "unsnarl/repair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "fuzz/lattice_mesh.h"
#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "oracle/intersections_oracle.h"
#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"

namespace unsnarl::fuzz {
namespace {

std::vector<IntersectingPair> by_oracle(const PreparedSurface& prepared, std::span<const double> positions) {
  const Positions x = prepared.gather(positions);
  return pairs_of_faces(
      prepared.triangulation.polygon,
      oracle::intersections_by_cgal({x.data(), static_cast<std::size_t>(x.size())}, prepared.triangles()));
}

/// As the polygons of the input are cut, and as a program cuts them that reads these positions.
std::vector<IntersectingPair> by_oracle_in_both_cuts(const Surface& surface, const FindOptions& options,
                                                     std::span<const double> positions) {
  const PreparedSurface prepared = prepare(surface, options);
  std::vector<IntersectingPair> pairs = by_oracle(prepared, positions);
  const std::optional<PreparedSurface> read = cut_anew(surface, prepared, options, positions);
  return read ? unite_face_pairs(std::move(pairs), by_oracle(*read, positions)) : pairs;
}

bool is_named(const std::vector<Obstruction>& obstructions, const IntersectingPair& pair) {
  return std::any_of(obstructions.begin(), obstructions.end(), [&](const Obstruction& obstruction) {
    if (obstruction.kind == Obstruction::Kind::closed_non_orientable) return true;  // named by its first face
    const auto has = [&](std::int32_t face) {
      return std::find(obstruction.faces.begin(), obstruction.faces.end(), face) != obstruction.faces.end();
    };
    return has(pair.a) && has(pair.b);
  });
}

}  // namespace

void repair(Bytes bytes) {
  ByteReader reader(bytes);
  RepairOptions options;
  options.goal = reader.below(4) == 0 ? Goal::disjoint : Goal::all;
  const bool some_fixed = reader.below(4) == 0;
  const int fixed_bits = reader.below(256);
  const LatticeMesh mesh(reader, {.vertices = 12, .faces = 10, .largest_exponent = 20});
  options.find = mesh.find;
  const Surface& surface = mesh.surface;
  const std::size_t vertices = surface.view().vertex_count();
  for (std::size_t v = 0; v < vertices && some_fixed; ++v) options.fixed.push_back(fixed_bits >> v % 8 & 1);

  const RepairResult result = unsnarl::repair(surface, options);

  promise(result.positions.size() == surface.positions.size(), "the result has the vertices of the input");
  for (const double x : result.positions) promise(std::isfinite(x), "positions are finite");
  for (std::size_t i = 0; i < result.positions.size() && some_fixed; ++i)
    promise(!options.fixed[i / 3] || result.positions[i] == surface.positions[i], "fixed vertices are kept");

  const auto before = by_oracle_in_both_cuts(surface, options.find, surface.positions);
  const auto after = by_oracle_in_both_cuts(surface, options.find, result.positions);
  const PairCounts count_before = count_by_class(before), count_after = count_by_class(after);
  promise(result.report.before.by_class == count_before.by_class, "the pairs before are those the oracle finds");
  promise(result.report.after.by_class == count_after.by_class, "the pairs after are those the oracle finds");
  promise(count_after[PairClass::disjoint] <= count_before[PairClass::disjoint], "no more disjoint pairs");
  if (options.goal == Goal::all) promise(count_after.total() <= count_before.total(), "no more pairs");

  const Certificate certificate = certify(surface, result.positions, options.find);
  promise(certificate.seams_closed, "seams stay closed");
  if (result.status == Status::embedded && options.goal == Goal::all)
    promise(after.empty() && certificate.embedded(), "'embedded' is true");
  if (result.status == Status::embedded && options.goal == Goal::disjoint)
    promise(count_after[PairClass::disjoint] == 0, "no disjoint pair is left");
  if (result.status == Status::obstructed && options.goal == Goal::all)
    for (const IntersectingPair& pair : after)
      promise(is_named(result.report.obstructions, pair), "what is left is named as obstruction");
  if (before.empty() && certify(surface, surface.positions, options.find).float32_embedded())
    promise(result.positions == surface.positions && result.status == Status::embedded,
            "an embedded input is returned untouched");
}

}  // namespace unsnarl::fuzz
