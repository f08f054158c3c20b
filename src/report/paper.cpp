#include "unsnarl/paper.h"

namespace unsnarl {

std::string_view to_string(PaperBandwidth bandwidth) {
  switch (bandwidth) {
    case PaperBandwidth::global: return "global";
    case PaperBandwidth::independent: return "independent";
    case PaperBandwidth::symmetric: return "symmetric";
  }
  return "unknown";
}

std::string_view to_string(PaperMeshEnergy energy) {
  return energy == PaperMeshEnergy::penetration_depth ? "depth" : "length";
}

}  // namespace unsnarl
