#pragma once

#include <span>
#include <vector>

#include "scene/pair_census.h"
#include "scene/prepared_surface.h"
#include "scene/recorder.h"
#include "unsnarl/recording.h"

namespace unsnarl {

/// The frames of a recorded repair, in vertices and faces of the input; the last one is `result` (3 a vertex of the
/// input). Empty where none were asked for.
std::vector<RecordedFrame> recorded_frames(const Recorder& recorder, const SurfaceView& surface,
                                           const PreparedSurface& prepared, std::span<const double> result,
                                           PairCensus& census);

}  // namespace unsnarl
