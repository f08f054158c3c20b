#pragma once

#include "samples/sample_maker.h"

namespace unsnarl {

/// A bust, and snakes instead of hair as components of their own, through the scalp and through each other: such a
/// scene as the paper's Fig. 1. Their spines wind around the bust without touching it or each other, which shows where
/// the snakes are thin; they are thickened, and pushed toward the bust.
Surface medusa(int resolution, const SampleValues& values);

}  // namespace unsnarl
