// The stages of a repair, one by one, for research: diagnosis, untangling, recovery, certificate; and other criteria.
#include <unsnarl/certify.h>
#include <unsnarl/repair.h>

#include <cstdio>
#include <string>

#include "crossing_sheets.h"

namespace {

/// Root mean square and largest displacement, and what every region took.
void print(const char* title, const unsnarl::RepairResult& result) {
  std::printf("%-24s %s, displacement rms %.2e, max %.2e of the diagonal\n", title,
              std::string(to_string(result.status)).c_str(), result.report.displacement_rms_rel,
              result.report.displacement_max_rel);
  for (const unsnarl::RegionReport& region : result.report.regions)
    std::printf("  region: %zu pairs, %zu faces free, strategy %s, %d iterations\n", region.pairs, region.faces,
                region.strategy.c_str(), region.iterations);
}

}  // namespace

int main() {
  const unsnarl::Surface surface = crossing_sheets();

  // Diagnosis: every pair, by class.
  const unsnarl::PairCounts counts = unsnarl::count_by_class(unsnarl::find_intersections(surface));
  for (std::size_t i = 0; i < unsnarl::pair_class_count; ++i)
    std::printf("%-12s %zu pairs\n", std::string(unsnarl::pair_class_names[i]).c_str(), counts.by_class[i]);

  // Untangling alone, then with recovery.
  unsnarl::RepairOptions options;
  options.precision = unsnarl::Precision::float64;
  options.recover = false;
  const unsnarl::RepairResult untangled = unsnarl::repair(surface, options);
  print("untangled", untangled);
  options.recover = true;
  const unsnarl::RepairResult recovered = unsnarl::repair(surface, options);
  print("and recovered", recovered);

  // The configuration of the paper, which looks at faces without a common vertex only.
  options.paper.emplace();
  options.goal = unsnarl::Goal::disjoint;
  print("as in the paper", unsnarl::repair(surface, options));

  // The certificate of any positions, your own method's too, against the input.
  const unsnarl::Certificate certificate = unsnarl::certify(surface, recovered.positions);
  std::printf("embedded: %s, in float32: %s\n", certificate.embedded() ? "yes" : "no",
              certificate.float32_embedded() ? "yes" : "no");
  return untangled.status == unsnarl::Status::embedded && certificate.embedded() ? 0 : 1;
}
