// The structs of unsnarl.h as the library takes them. All functions throw std::invalid_argument for what makes no
// sense.
#pragma once

#include <span>
#include <vector>

#include "unsnarl/curves.h"
#include "unsnarl/intersections.h"
#include "unsnarl/link.h"
#include "unsnarl/nesting.h"
#include "unsnarl/repair.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/surface.h"
#include "unsnarl/unsnarl.h"

namespace unsnarl::c_interface {

/// Throws unless `given` can be the size of a struct that has `known` bytes in this version of the library.
void check_size(std::size_t given, std::size_t known, const char* name);

/// Kinds of work that options are for; a function takes those of one or several.
enum class Work : unsigned {
  search = 1 << 0,  ///< whatever looks at a surface; takes what is meant for its repair too, and does not use it
  repair = 1 << 1,
  document = 1 << 2,  ///< repair of a file
  sequence = 1 << 3,
  curves = 1 << 4,
  seifert = 1 << 5,
  check_seifert = 1 << 6,
  isotopy = 1 << 7,
  routes = 1 << 8,
  knot_isotopy = 1 << 9,
  relaxed_wire = 1 << 10,
};

/// What the caller's struct says, and defaults for fields that it does not have yet. NULL: the defaults. Throws where
/// an option has another value than its default that `work` does not know.
unsnarl_options options_of(const unsnarl_options* given, Work work);
/// All defaults.
unsnarl_options default_options();
/// Throws where an option has another value than its default that `work` does not know.
void refuse_what_is_not_used(const unsnarl_options& options, Work work);
/// Every field, those that the caller's struct does not have yet as zero; arrays have the lengths they say.
unsnarl_surface surface_of(const unsnarl_surface* given);
unsnarl_page_content content_of(const unsnarl_page_content* given);  ///< NULL: nothing but the surface
unsnarl_curves curves_of(const unsnarl_curves* given, const char* name);

/// `surface`: whose pairs are allowed; they are of no other.
FindOptions find_options(const unsnarl_options& options, const unsnarl_surface& surface = {});
Goal goal_of(const unsnarl_options& options);
/// `options` for a repair of `surface`.
RepairOptions repair_options(const unsnarl_options& options, const unsnarl_surface& surface);
/// Goal, precision, welding and limits alone, what a sequence knows of. All lengths are relative.
RepairOptions frame_options(const unsnarl_options& options, const unsnarl_surface& surface);

SurfaceView view_of(const unsnarl_surface& surface);
/// The meshes that lie one after another in `surface`, called by their numbers, or as the files of its document;
/// empty where it is one.
std::vector<SceneFile> meshes_of(const unsnarl_surface& surface);
/// Which of `meshes`, or of the surfaces that `surface` numbers, are to lie inside which; no chains: it does not
/// matter.
Nesting nesting_of(const unsnarl_surface& surface, std::span<const SceneFile> meshes);
/// Throws where a face uses a vertex that does not exist.
void check_corners(const SurfaceView& surface);

std::vector<Curve> plane_curves(const unsnarl_curves& curves);
Link link_of(const unsnarl_curves& curves);

}  // namespace unsnarl::c_interface
