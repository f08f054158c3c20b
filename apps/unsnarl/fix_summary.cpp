#include "fix_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gap_words.h"
#include "mesh_input.h"
#include "pair_class_words.h"
#include "unsnarl/visible_text.h"

namespace unsnarl::app {
namespace {

std::string in_words(const PairCounts& pairs) {
  if (pairs.total() == 0) return "none";
  std::string text;
  for (std::size_t i = 0; i < pair_class_count; ++i)
    if (pairs.by_class[i] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", pairs.by_class[i], pair_class_words[i]);
  return text;
}

std::string_view explanation(Status status, Goal goal) {
  switch (status) {
    case Status::embedded:
      return goal == Goal::all ? "embedded: no self-intersection is left"
                               : "no intersections are left between faces that share no vertex";
    case Status::reduced: return "reduced: some self-intersections are left";
    case Status::no_progress: return "no progress: nothing better than the input was found";
    case Status::obstructed: return "obstructed: with these options the remaining intersections cannot be removed";
    case Status::allowed: return "allowed: no self-intersection is left but those of parts that may pass (--allow)";
    case Status::time_limit: return "stopped at the time limit";
    case Status::memory_limit: return "stopped at the memory limit";
    case Status::displacement_exceeded:
      return "displacement exceeded: the remaining intersections need a vertex to move farther than allowed";
    case Status::cancelled: return "interrupted";
    case Status::gap_not_met:
      return "gap not met: no self-intersection is left, but surfaces are closer than --min-gap asks";
  }
  return "unknown status";
}

std::string_view float32_remark(const RepairResult& result, const RepairOptions& options) {
  if (result.report.float32_embedded || result.report.after.total() > 0) return "";
  if (is_resolved(result.status)) return " (in double precision; programs that use 32-bit numbers may find some)";
  return options.precision == Precision::float32 ? " (in 32 bits, as asked for; none in double precision)" : "";
}

std::string fate_of_output(const RepairResult& result, const ReportFiles& files) {
  if (files.output == standard_stream) return "written to standard output";
  if (!files.output.empty()) return "wrote " + files.output;
  if (result.status == Status::obstructed) return "no file written: there was nothing else to repair";
  if (result.status == Status::no_progress) return "no file written: nothing better than the input was found";
  return "no file written; --keep-partial writes the incomplete result";
}

/// "0.19 (7.6 % of the diagonal)": a length in the units of the file. `of` follows the percent sign.
std::string length_in_words(double rel, double diagonal, std::string_view of = " of the diagonal") {
  return fmt::format("{:.2g} ({:.2g} %{})", rel * diagonal, 100 * rel, of);
}

/// Displacement, in diagonals, beyond which a region is named: programs that mesh volumes reject larger ones.
constexpr double far_rel = 0.01;
constexpr std::size_t most_far_regions = 3;  // lines

/// The regions with the largest displacements: where, and how deep the surfaces overlapped there.
std::vector<std::string> far_regions(const RepairReport& report) {
  std::vector<RegionReport> regions;
  for (const RegionReport& region : report.regions)
    if (region.displacement_rel > far_rel) regions.push_back(region);
  std::stable_sort(regions.begin(), regions.end(),
                   [](const auto& a, const auto& b) { return a.displacement_rel > b.displacement_rel; });
  // A region that continues another one has the same farthest vertex.
  std::vector<std::string> lines;
  std::vector<std::int32_t> named;
  for (const RegionReport& region : regions) {
    if (lines.size() == most_far_regions) break;
    if (std::find(named.begin(), named.end(), region.farthest_vertex) != named.end()) continue;
    named.push_back(region.farthest_vertex);
    lines.push_back(fmt::format("{}: {} at vertex {}, where the surfaces overlapped by {:.2g}",
                                lines.empty() ? "largest move" : "next largest move",
                                length_in_words(region.displacement_rel, report.diagonal), region.farthest_vertex,
                                region.depth_rel * report.diagonal));
  }
  return lines;
}

/// Lines about the files of a scene: their pairs before and after, and how far they moved.
std::vector<std::string> by_file(const SceneReport& scene, double diagonal) {
  std::vector<std::string> lines;
  for (const ScenePairs& pairs : scene.pairs) {
    const SceneFileReport& file = scene.files[pairs.a];
    std::string counts = fmt::format("{} before, {} after", pairs.before.total(), pairs.after.total());
    if (pairs.allowed_before.total() + pairs.allowed_after.total() > 0)
      counts += fmt::format(" (besides {} and {} that may intersect)", pairs.allowed_before.total(),
                            pairs.allowed_after.total());
    if (pairs.a != pairs.b) {
      lines.push_back(fmt::format("between {} and {}: {}", file.file.name, scene.files[pairs.b].file.name, counts));
      continue;
    }
    lines.push_back(fmt::format("within {}: {}", file.file.name, counts));
    if (file.untouched_share < 1)
      lines.back() += fmt::format("; moved {:.3g} % of its vertices, by {} at most", 100 * (1 - file.untouched_share),
                                  length_in_words(file.displacement_max_rel, diagonal));
  }
  return lines;
}

std::string nested_in_words(const NestedPair& pair) {
  std::string words = fmt::format("{} {} {}: {} vertices on the wrong side before, {} after", pair.inner,
                                  pair.is_nested ? "lies inside" : "does not lie inside", pair.outer, pair.wrong_before,
                                  pair.wrong_after);
  if (pair.apart.size() == 1)
    words += fmt::format(
        "; one component (at vertex {}) is entirely on the wrong side: it intersects nothing and is "
        "not moved",
        pair.apart[0]);
  if (pair.apart.size() > 1)
    words += fmt::format(
        "; {} components (the first at vertex {}) are entirely on the wrong side: they intersect nothing and are not "
        "moved",
        pair.apart.size(), pair.apart[0]);
  return words;
}

std::string rigid_part_in_words(const RigidPartReport& part, double diagonal) {
  if (part.translation_rel == 0 && part.rotation_deg == 0) return fmt::format("rigid {}: stays", part.name);
  return fmt::format("rigid {}: shifted by {}, turned by {:.2g} degrees, residual {:.1g}", part.name,
                     length_in_words(part.translation_rel, diagonal), part.rotation_deg, part.residual_rel);
}

constexpr std::size_t most_changed_components = 5;  // lines

/// The components that are no longer what they were, most changed first.
std::vector<std::string> changed_in_words(const RepairReport& report) {
  std::vector<std::string> lines;
  for (const ChangedComponent& component : report.changed_components) {
    if (lines.size() == most_changed_components) break;
    lines.push_back(describe(component, report.diagonal));
  }
  if (report.changed_components.size() > lines.size())
    lines.push_back(fmt::format("and {} more; --report lists all", report.changed_components.size() - lines.size()));
  return lines;
}

std::string dihedral_in_words(const Clearance& clearance, double wanted_deg) {
  const std::string angle = fmt::format("  smallest dihedral angle: {:.3g} degrees", clearance.dihedral_deg);
  if (clearance.dihedral_deg >= wanted_deg) return angle;
  return angle + fmt::format(", smaller than --min-dihedral, between faces {} and {}", clearance.dihedral_faces[0],
                             clearance.dihedral_faces[1]);
}

/// The messages of the first few obstructions of each kind, and how many more there are.
std::vector<std::string> obstructions_in_words(std::span<const Obstruction> obstructions) {
  constexpr std::size_t most_of_a_kind = 5;
  std::map<Obstruction::Kind, std::size_t> count;
  std::vector<std::string> words;
  for (const Obstruction& obstruction : obstructions)
    if (++count[obstruction.kind] <= most_of_a_kind) words.push_back(obstruction.message);
  for (const auto& [kind, of_kind] : count)
    if (of_kind > most_of_a_kind)
      words.push_back(
          fmt::format("{} more of this kind ({}); --report lists all", of_kind - most_of_a_kind, to_string(kind)));
  return words;
}

}  // namespace

std::string fix_summary(const RepairResult& result, const RepairOptions& options, const ReportFiles& files,
                        const std::vector<std::string>& other_outputs) {
  const RepairReport& r = result.report;
  std::string text;
  const auto line = [&text](const std::string& words) { text += visible_text(words) + "\n"; };
  const auto counted = [](std::size_t n, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  line(fmt::format("{}: {}, {}, {}",
                   files.scene.files.empty() ? (files.input == standard_stream ? "mesh" : files.input)
                                             : fmt::format("{} files", files.scene.files.size()),
                   counted(files.vertices, "vertex", "vertices"), counted(files.faces, "face", "faces"),
                   counted(r.topology.components, "component", "components")));
  line(fmt::format("  intersecting pairs before: {}", in_words(r.before)));
  line(fmt::format("  intersecting pairs after:  {}", in_words(r.after)));
  if (!options.find.allowed.empty())
    line(fmt::format("  pairs that may intersect:  {} before, {} after", r.allowed_before.total(),
                     r.allowed_after.total()));
  for (const std::string& words : by_file(files.scene, r.diagonal)) line("    " + words);
  for (std::size_t i = 0; i < left_reason_count; ++i)
    if (r.left_by_reason[i] > 0)
      line(fmt::format("    {} {}", r.left_by_reason[i], describe(static_cast<LeftReason>(i))));
  if (r.untouched_share < 1)
    line(fmt::format("  moved {:.3g} % of the vertices, by {} at most, {} on average, {} by area",
                     100 * (1 - r.untouched_share), length_in_words(r.displacement_max_rel, r.diagonal),
                     length_in_words(r.displacement_mean_rel, r.diagonal, ""),
                     length_in_words(r.displacement_area_rms_rel, r.diagonal, "")));
  if (r.before_recovery)
    line(fmt::format("  before recovery: {}, vertices moved by {} at most, {} on average",
                     r.before_recovery->is_clean ? "clean" : "not clean",
                     length_in_words(r.before_recovery->displacement_max_rel, r.diagonal),
                     length_in_words(r.before_recovery->displacement_mean_rel, r.diagonal, "")));
  for (const NestedPair& pair : files.nested) line("  " + nested_in_words(pair));
  for (const RigidPartReport& part : r.rigid_parts) line("  " + rigid_part_in_words(part, r.diagonal));
  for (const std::string& words : far_regions(r)) line("  " + words);
  for (const std::string& words : changed_in_words(r)) line("  " + words);
  if (!r.overlapping_components.empty()) line("  advice: " + advice_on_overlaps(r.overlapping_components));
  if (r.gap) line("  " + gap_in_words(*r.gap, r.diagonal));
  if (options.min_dihedral_deg > 0 && files.clearance_after)
    line(dihedral_in_words(*files.clearance_after, options.min_dihedral_deg));
  if (result.status == Status::displacement_exceeded && r.displacement_lower_bound_rel > options.max_displacement_rel)
    line(fmt::format("  any repair has to move some vertex by at least {}",
                     length_in_words(r.displacement_lower_bound_rel, r.diagonal)));
  for (const std::string& words : obstructions_in_words(r.obstructions)) line("  not repaired: " + words);
  const bool is_as_asked = outcome(result.status, files.nested) == to_string(result.status);
  line(fmt::format("  {}{}{}; {:.2f} s, {:.0f} MB", is_as_asked ? "" : "not nested as asked with --nested; ",
                   explanation(result.status, options.goal), float32_remark(result, options), files.whole.seconds,
                   files.whole.peak_memory_mb));
  if (files.partial.empty()) line("  " + fate_of_output(result, files));
  for (const std::string& path : other_outputs) line("  wrote " + path);
  if (!files.partial.empty())
    line(fmt::format("  not repaired completely: the best result so far is in {} ({} intersecting pairs, before {})",
                     fmt::join(files.partial, ", "), r.after.total(), r.before.total()));
  return text;
}

}  // namespace unsnarl::app
