#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "scene/patch.h"
#include "unsnarl/paper.h"

namespace unsnarl {

struct PaperResult {
  bool clean = false;  ///< no two faces that share no vertex intersect: the paper's criterion
  int iterations = 0;
  int evaluations = 0;
  std::size_t disjoint_left = 0;
  double mean_bandwidth = 0;  ///< of the free vertices, length, at the end
};

/// The untangling phase as the paper describes it (§3.1-3.3, §3.5), so that its experiments can be repeated; the
/// default is escalate(). Starts from patch.rest, and ends as soon as no disjoint pair is left; patch.x is the last
/// iterate. If the line search ends below 1e-10 (§3.5.1), its last trial is taken and L-BFGS forgets its steps: the
/// penalty has kinks, at which no direction descends.
///
/// face_of: the face that each triangle of the *scene* is a piece of, for PaperOptions::whole_polygons; empty: all are
/// triangles.
PaperResult paper_untangle(Patch& patch, const PaperOptions& options = {}, std::span<const Index> face_of = {},
                           const std::function<bool()>& stop = {});

/// Throws std::invalid_argument where an option is out of its range.
void check_paper_options(const PaperOptions& options);

}  // namespace unsnarl
