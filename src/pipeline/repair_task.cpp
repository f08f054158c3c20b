#include "pipeline/repair_task.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/nesting.h"
#include "untangle/paper_untangle.h"
#include "untangle/strategies.h"

namespace unsnarl {
namespace {

void check_ranges(const RepairOptions& options) {
  if (!(options.min_gap_rel >= 0) || !(options.max_displacement_rel >= 0) || !(options.time_limit_s >= 0) ||
      !(options.memory_limit_mb >= 0))
    throw std::invalid_argument("RepairOptions: gaps, displacements and limits must not be negative");
  if (!(options.min_dihedral_deg >= 0 && options.min_dihedral_deg < 90))
    throw std::invalid_argument("RepairOptions::min_dihedral_deg is " + std::to_string(options.min_dihedral_deg) +
                                "; give degrees from 0 to less than 90");
  if (options.paper) check_paper_options(*options.paper);
  for (const std::string& name : options.without_strategies)
    if (strategy_number(name) < 0)
      throw std::invalid_argument("RepairOptions::without_strategies: there is no strategy '" + name + "'");
}

/// `n`: number of vertices.
void check_rigid_parts(const RepairOptions& options, std::size_t n) {
  if (options.rigid.empty()) return;
  if (options.rigid.size() != n)
    throw std::invalid_argument("RepairOptions::rigid has " + std::to_string(options.rigid.size()) + " numbers for " +
                                std::to_string(n) + " vertices");
  if (options.each_component)
    throw std::invalid_argument(
        "RepairOptions: rigid parts move among all components, but each_component repairs each as if alone; leave "
        "one of the two out");
  const auto wrong = std::find_if(options.rigid.begin(), options.rigid.end(),
                                  [&](std::int32_t part) { return part < -1 || part >= static_cast<Index>(n); });
  if (wrong != options.rigid.end())
    throw std::invalid_argument("RepairOptions::rigid: vertex " + std::to_string(wrong - options.rigid.begin()) +
                                " is of part " + std::to_string(*wrong) +
                                "; give -1 for none, or a number from 0, less than that of the vertices");
}

void check_allowed_pairs(const RepairOptions& options, const Nesting* nesting) {
  if (options.find.allowed.empty()) return;
  if (nesting || options.paper)
    throw std::invalid_argument(
        "FindOptions::allowed: neither surfaces inside each other nor the method of the paper know of pairs that may "
        "pass through each other; leave one of the two out");
}

/// The options, where they make sense.
const RepairOptions& checked(const SurfaceView& surface, const RepairOptions& options, const Nesting* nesting) {
  if (nesting && (!options.rigid.empty() || options.each_component || options.paper))
    throw std::invalid_argument(
        "RepairOptions: rigid, each_component and paper know nothing of surfaces inside each other; leave them or the "
        "nesting out");
  if (!options.fixed.empty() && options.fixed.size() != surface.vertex_count())
    throw std::invalid_argument("RepairOptions::fixed has " + std::to_string(options.fixed.size()) + " flags for " +
                                std::to_string(surface.vertex_count()) + " vertices");
  check_ranges(options);
  check_rigid_parts(options, surface.vertex_count());
  check_allowed_pairs(options, nesting);
  return options;
}

std::vector<std::uint8_t> fixed_flags(const RepairOptions& options, const WeldMap& weld_map) {
  std::vector<std::uint8_t> fixed(weld_map.count, 0);
  for (std::size_t v = 0; v < options.fixed.size(); ++v)
    if (options.fixed[v]) fixed[weld_map.vertex_of[v]] = 1;
  return fixed;
}

RigidParts rigid_parts(const RepairOptions& options, const WeldMap& weld_map, const std::vector<std::uint8_t>& fixed) {
  RigidParts parts;
  if (options.rigid.empty()) return parts;
  parts.of_vertex.assign(weld_map.count, -1);
  parts.names = options.rigid_names;
  for (std::size_t v = 0; v < options.rigid.size(); ++v) {
    const std::int32_t part = options.rigid[v];
    if (part < 0) continue;
    parts.count = std::max(parts.count, part + 1);
    Index& own = parts.of_vertex[weld_map.vertex_of[v]];
    if (own >= 0 && own != part)
      throw std::invalid_argument("vertex " + std::to_string(v) + " is of two rigid parts, " + parts.name(own) +
                                  " and " + parts.name(part) + "; name them as one, or leave one of them out");
    if (fixed[weld_map.vertex_of[v]])
      throw std::invalid_argument("vertex " + std::to_string(v) + " is fixed and of the rigid part " +
                                  parts.name(part) + ", so that this cannot move; leave one of the two out");
    own = part;
  }
  parts.count = std::max(parts.count, static_cast<Index>(options.rigid_names.size()));
  return parts;
}

PreparedSurface at_positions_of(const SurfaceView& surface, PreparedSurface prepared) {
  prepared.rest = prepared.gather(surface.positions);
  return prepared;
}

PairPolicy policy_of(const RepairOptions& options, const PreparedSurface& prepared, const Components& components) {
  PairPolicy policy(components, options.goal, options.each_component);
  const std::vector<std::uint8_t> fixed = fixed_flags(options, prepared.weld_map);
  policy.hold(fixed, prepared.rest);
  policy.hold_shape(rigid_parts(options, prepared.weld_map, fixed), prepared.rest);
  return policy;
}

}  // namespace

RepairTask::RepairTask(const SurfaceView& of, const RepairOptions& asked, const Nesting* nesting)
    : surface(of),
      options(checked(of, asked, nesting)),
      prepared(prepare(of, asked.find)),
      diagnosis(diagnose_topology(surface, prepared)),
      diagonal(prepared.diagonal_of(of.positions)),
      policy(policy_of(options, prepared, diagnosis.components)) {
  if (!nesting) return;
  nested = nested_surfaces(surface, prepared, *nesting);
  require_order_is_possible(*nested, prepared.rest, *nesting);
}

RepairTask::RepairTask(const SurfaceView& of, const RepairOptions& asked, const PreparedSurface& known,
                       const Diagnosis& topology, std::optional<Positions> from)
    : surface(of),
      options(checked(of, asked, nullptr)),
      prepared(at_positions_of(of, known)),
      diagnosis(topology),
      diagonal(prepared.diagonal_of(of.positions)),
      policy(policy_of(options, prepared, diagnosis.components)),
      start(std::move(from)) {}

void RepairTask::diagnose(IntersectionFinder& finder, const std::function<bool()>& stop) {
  diagnose_intersections(prepared, policy, finder, diagnosis, stop);
}

}  // namespace unsnarl
