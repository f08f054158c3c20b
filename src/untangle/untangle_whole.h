#pragma once

#include "unsnarl/paper.h"
#include "untangle/escalation.h"

namespace unsnarl {

/// Untangles the whole scene as one patch, as the paper does (paper_untangle), until no disjoint pair is left. In place
/// of escalate(). If the scene has groups, each one that has pairs is a patch. Of `options` only `stop`, `recorder` and
/// `first_region` are used.
EscalationResult untangle_whole(Scene& scene, SceneIndex& index, std::span<const IntersectingPair> ignored,
                                const PaperOptions& paper, const EscalationOptions& options);

}  // namespace unsnarl
