#pragma once

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <vector>

#include "errors.h"
#include "handles.h"
#include "unsnarl/repair_file_steps.h"
#include "unsnarl/surface.h"

namespace unsnarl::c_interface {

/// Keys in the order in which they are written down.
using Json = nlohmann::ordered_json;

inline Context* context_of(unsnarl_context* context) {
  return context ? &context->context : nullptr;
}

/// The body of a function of the C interface that makes a result: `make` returns it or throws.
template <class Make>
int hand_out(unsnarl_result** result, const Make& make) noexcept {
  return guarded([&] {
    require(result, "result");
    *result = std::make_unique<unsnarl_result>(make()).release();
  });
}

/// Status, report and "positions" of a repair. `options` may refer to a document, of which nothing is kept.
unsnarl_result result_of_repair(RepairResult repaired, RepairFileOptions options, const ReportFiles& files);
/// Adds "points" and "offsets": polylines of points of so many numbers each.
void add_polylines(unsnarl_result& result, const std::vector<std::vector<double>>& polylines, std::size_t dimension);
/// Adds "positions" and "corners".
void add_triangles(unsnarl_result& result, Surface surface);

}  // namespace unsnarl::c_interface
