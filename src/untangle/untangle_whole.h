#pragma once

#include "unsnarl/paper.h"
#include "untangle/escalation.h"

namespace unsnarl {

/// Untangles the whole scene as one patch, as the paper does it (paper_untangle), until no disjoint pair is left; in
/// the place of escalate(). Of several groups each that has pairs is a patch. Of `options` only `stop`, `recorder` and
/// `first_region` count.
EscalationResult untangle_whole(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                                const PaperOptions& paper, const EscalationOptions& options);

}  // namespace unsnarl
