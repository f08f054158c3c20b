#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "unsnarl/exit_code.h"
#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"

namespace unsnarl {

/// Which surfaces of a scene are to lie inside which others. Inside a surface is what a ray to infinity leaves through
/// an odd number of its faces, whatever their orientation, so that all but the innermost have to be closed.
struct Nesting {
  /// One number a vertex: the surface that it belongs to, counted from 0; -1: none.
  std::vector<std::int32_t> surface_of_vertex;
  std::vector<std::string> names;  ///< of these surfaces, for messages and reports; missing ones are their numbers
  /// Surfaces from the innermost out, two at least in each chain: every one is to lie inside all that follow.
  std::vector<std::vector<std::int32_t>> chains;

  std::string name(std::int32_t surface) const;
};

/// The nesting of the files of a scene, each of which is a surface.
Nesting nesting_of_files(std::span<const SceneFile> files, std::vector<std::vector<std::int32_t>> chains);

/// Throws std::invalid_argument for a nesting that makes no sense: an outer surface is not closed, a surface is twice
/// in a chain, or inside itself by several chains, two have a vertex in common, or one that is to lie inside another
/// holds all of it without crossing it, so that nothing would move.
/// Returns a sentence for each surface that is to lie inside one of less volume: odd, but it may well be meant.
std::vector<std::string> check_nesting(const SurfaceView& surface, const Nesting& nesting,
                                       const FindOptions& options = {});

/// How one surface lies to the next one out in its chain.
struct NestedPair {
  std::string inner, outer;
  /// Vertices on the wrong side of the other surface, decided exactly: of the inner one, those not strictly inside the
  /// outer one; of the outer one, those not strictly outside the inner one (where that is closed).
  std::size_t wrong_before = 0, wrong_after = 0;
  bool is_nested = false;  ///< none of them after, and no face of one meets a face of the other
  /// The first vertex of each component of either that lies on the wrong side as a whole after, and meets no face of
  /// the other; ascending. Nothing moves it there: it has to be moved by hand, or left out.
  std::vector<std::int32_t> apart;
};

/// repair() that moves surfaces which cross apart in the sense of the nesting, the inner one in, the outer one out,
/// even where the other way is nearer. A component that crosses nothing but lies on the wrong side as a whole stays
/// there; nested_pairs() tells. Status::embedded says nothing of nesting.
///
/// Throws std::invalid_argument as repair() and check_nesting() do, and for FindOptions::allowed and
/// RepairOptions::rigid, each_component and paper, which know nothing of nesting.
RepairResult repair_nested(const SurfaceView& surface, const Nesting& nesting, const RepairOptions& options = {},
                           Context* context = nullptr);

/// For each surface and the next one out, chain after chain. `after`: 3 n doubles; `pairs_after`: of faces that
/// intersect there. Throws as check_nesting() does.
std::vector<NestedPair> nested_pairs(const SurfaceView& before, std::span<const double> after,
                                     std::span<const IntersectingPair> pairs_after, const Nesting& nesting,
                                     const FindOptions& options = {});

/// How it ended, as reports say it: the status, but "not_nested" where it is Status::embedded and some pair is not
/// nested.
std::string_view outcome(Status status, std::span<const NestedPair> pairs);
/// exit_code_of(status), but exit_obstructed for "not_nested".
ExitCode exit_code_of(Status status, std::span<const NestedPair> pairs);

}  // namespace unsnarl
