#pragma once

#include <optional>

#include "scene/diagnose.h"
#include "scene/finders.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"

namespace unsnarl {

/// The parts of a surface's preparation that several repairs of it share.
struct KnownSurface {
  PreparedSurface prepared;
  Diagnosis topology;  ///< diagnose_topology()

  /// Throws as prepare() does.
  KnownSurface(const SurfaceView& surface, const FindOptions& options)
      : prepared(prepare(surface, options)), topology(diagnose_topology(surface, prepared)) {}
};

/// repair() of a known surface whose vertices have moved since: `surface` is what it is now. Welding and triangulation
/// stay those of `known`. `finders`: of its triangles; what they have decided is not decided again. `options.find`: as
/// it was made with. `start`: positions of the welded vertices near which the result is looked for, such as what a
/// surface like this one came to; fixed vertices are where they are in the surface. None: those of the surface.
RepairResult repair_from(const SurfaceView& surface, const KnownSurface& known, Finders& finders,
                         const RepairOptions& options, Context* context, std::optional<Positions> start = {});

}  // namespace unsnarl
