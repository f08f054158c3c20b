#include "gap_words.h"

#include <fmt/format.h>

namespace unsnarl::app {

std::string gap_in_words(const GapReport& gap, double diagonal) {
  const double asked = gap.asked_rel * diagonal;
  if (gap.faces[0] < 0) return fmt::format("smallest gap more than {:.3g}, asked for {:.3g}", 2 * asked, asked);
  return fmt::format("smallest gap {:.3g}, asked for {:.3g}: between faces {} and {}, at ({:.4g}, {:.4g}, {:.4g}){}",
                     gap.smallest_rel * diagonal, asked, gap.faces[0], gap.faces[1], gap.position[0], gap.position[1],
                     gap.position[2], gap.is_between_held ? "; neither may move" : "");
}

}  // namespace unsnarl::app
