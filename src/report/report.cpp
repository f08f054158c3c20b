#include "unsnarl/report.h"

#include "geometry/box.h"

namespace unsnarl {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::embedded: return "embedded";
    case Status::reduced: return "reduced";
    case Status::no_progress: return "no_progress";
    case Status::obstructed: return "obstructed";
    case Status::allowed: return "allowed";
    case Status::time_limit: return "time_limit";
    case Status::memory_limit: return "memory_limit";
    case Status::displacement_exceeded: return "displacement_exceeded";
    case Status::cancelled: return "cancelled";
    case Status::gap_not_met: return "gap_not_met";
  }
  return "unknown";
}

std::string_view to_string(Obstruction::Kind kind) {
  switch (kind) {
    case Obstruction::Kind::closed_non_orientable: return "closed_non_orientable";
    case Obstruction::Kind::duplicate_faces: return "duplicate_faces";
    case Obstruction::Kind::fixed_faces: return "fixed_faces";
    case Obstruction::Kind::between_components: return "between_components";
    case Obstruction::Kind::rigid_faces: return "rigid_faces";
  }
  return "unknown";
}

std::string_view to_string(Precision precision) {
  return precision == Precision::float32 ? "float32" : "float64";
}

double diagonal_of(const SurfaceView& surface) {
  const Scale scale(surface.positions);
  return scale.out(diagonal_of_box(surface.positions, scale));
}

}  // namespace unsnarl
