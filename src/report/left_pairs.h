#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "mesh/components.h"
#include "scene/pair_census.h"
#include "scene/pair_policy.h"
#include "scene/prepared_surface.h"
#include "unsnarl/repair.h"
#include "untangle/attempt_log.h"

namespace unsnarl {

/// What a repair knows of its end, to say why pairs are left.
struct Ending {
  const PairPolicy& policy;
  const Components& components;
  const AttemptLog& attempts;
  std::span<const std::uint8_t> held;  ///< one flag a welded vertex: it was not to move, or a rigid part's
  Status limit;                        ///< the one that was reached, or Status::reduced
  const Positions& x;                  ///< the result
};

/// Fills the list of the pairs that are left and how many there are for each reason. `left`: of the result.
void explain_left_pairs(const SurfaceView& surface, const PreparedSurface& prepared, const Ending& ending,
                        const PairCensus::Pairs& left, RepairReport& report);

/// Why two faces that meet by another cut than the input's alone may stay; none: they have to be parted.
std::optional<LeftReason> reason_to_leave_faces(const SurfaceView& surface, const PreparedSurface& prepared,
                                                const Components& components, const PairPolicy& policy,
                                                const IntersectingPair& pair);

}  // namespace unsnarl
