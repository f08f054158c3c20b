#pragma once

#include "samples/sample_maker.h"

namespace unsnarl {

/// A ship's anchor, to be fixed; a link through its eye, a hoop around its shank, a crate and a barrel on its arms, to
/// be rigid; a buoy and a ribbon, which are soft. The link, hoop, crate and barrel stick in the anchor, the buoy and
/// the ribbon in all that they meet. A place for each is near.
Surface anchor_scene(int resolution, const SampleValues& values);

}  // namespace unsnarl
