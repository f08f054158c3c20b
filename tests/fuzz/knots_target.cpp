#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "unsnarl/document.h"
#include "unsnarl/knot_isotopy.h"
#include "unsnarl/link.h"

namespace unsnarl::fuzz {
namespace {

/// Points up to which links and isotopies are examined too; the check of a link looks at all pairs of edges.
constexpr std::size_t most_knot_points = 300;

template <class Read>
auto read_knot(Read&& read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const FileError& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return std::nullopt;
  }
}

bool is_accepted(const Link& link) {
  try {
    check_link(link);
    return true;
  } catch (const std::invalid_argument& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
    return false;
  }
}

void check_slices(const KnotIsotopy& isotopy) {
  for (const double time : {0.0, 0.3, 1.0})
    for (const std::vector<double>& component : knot_isotopy_slice(isotopy, time).components)
      for (const double x : component) promise(std::isfinite(x), "cuts are finite");
}

}  // namespace

void link(Bytes bytes) {
  const std::optional<Link> read = read_knot([&] { return parse_link(std::string(bytes.begin(), bytes.end())); });
  if (!read) return;
  for (const std::vector<double>& component : read->components) {
    promise(component.size() % 3 == 0, "three coordinates a point");
    for (const double x : component) promise(std::isfinite(x), "coordinates are finite");
  }
  if (read->point_count() > most_knot_points || !is_accepted(*read)) return;
  promise(parse_link(link_text(*read)).components == read->components, "a link comes back as it was written");
}

void knot_isotopy(Bytes bytes) {
  const std::string text(bytes.begin(), bytes.end());
  const std::optional<KnotIsotopy> read = read_knot([&] { return parse_knot_isotopy(text); });
  if (!read) return;
  const std::string written = knot_isotopy_json(*read, {});
  promise(knot_isotopy_json(parse_knot_isotopy(written), {}) == written, "an isotopy comes back as it was written");
  std::size_t points = 0;
  for (const KnotRing& ring : read->rings) points += ring.points.size() / 3;
  if (read->rings.empty() || points > most_knot_points) return;
  const Link start{{read->rings.front().points}}, end{{read->rings.back().points}};
  try {
    const KnotIsotopyFindings findings = check_knot_isotopy(*read, start, end);
    promise(!findings.hold() || (is_accepted(start) && is_accepted(end)), "the ends of what holds are knots");
    check_slices(*read);
  } catch (const std::invalid_argument& refusal) {
    promise(refusal.what()[0] != '\0', "a refusal has a reason");
  }
}

}  // namespace unsnarl::fuzz
