#pragma once

#include "samples/sample_maker.h"

namespace unsnarl {

/// A figure with its arms out, to be fixed, and a tunic on it: one layer of cloth, open at the neck, the hem and the
/// cuffs, in folds that go through the figure here and there.
Surface dressed_figure(int resolution, const SampleValues& values);

}  // namespace unsnarl
