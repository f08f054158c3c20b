#include "applications/seifert/gauss_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "applications/seifert/planar_embedding.h"
#include "mesh/union_find.h"
#include "unsnarl/document.h"

namespace unsnarl {
namespace {

/// Where a crossing is met: the edge that arrives there and the one that leaves, from 1 along the components.
struct Passage {
  int in = 0, out = 0;
  bool over = false;
};

[[noreturn]] void refuse_code(const std::string& what) {
  throw FileError("Gauss or Dowker-Thistlethwaite code: " + what);
}

/// The two of each crossing, as they are met.
std::vector<std::array<Passage, 2>> passages_of(const GaussCode& code) {
  std::size_t visits = 0;
  for (const auto& component : code.components) visits += component.size();
  std::vector<std::array<Passage, 2>> passages(visits / 2);
  std::vector<int> count(visits / 2, 0);
  int edge = 1;
  for (const auto& component : code.components) {
    const int first = edge, n = static_cast<int>(component.size());
    for (int k = 0; k < n; ++k, ++edge) {
      const auto [crossing, over] = component[k];
      if (crossing < 0 || crossing >= static_cast<int>(passages.size()) || count[crossing] == 2)
        refuse_code(fmt::format("crossing {} is not met twice; {} numbers name the crossings 1 to {}, each twice",
                                crossing + 1, visits, visits / 2));
      passages[crossing][count[crossing]++] = {edge, first + (k + 1) % n, over};
    }
  }
  for (std::size_t c = 0; c < passages.size(); ++c)
    if (count[c] != 2 || passages[c][0].over == passages[c][1].over)
      refuse_code(fmt::format("crossing {} is not met once above and once below", c + 1));
  return passages;
}

/// Every crossing becomes a wheel whose rim keeps the four edges in turn: in any drawing the strands cross.
std::vector<int> signs_of(const std::vector<std::array<Passage, 2>>& passages) {
  const int n = static_cast<int>(passages.size());
  const auto hub = [](int c) { return 5 * c; };
  std::vector<int> end_of(2 * n + 1), start_of(2 * n + 1);  // rim nodes, by edge
  std::vector<std::array<int, 2>> edges;
  UnionFind parts(n);
  std::vector<int> crossing_of_end(2 * n + 1), crossing_of_start(2 * n + 1);
  for (int c = 0; c < n; ++c) {
    for (int k = 0; k < 4; ++k) {
      edges.push_back({hub(c), hub(c) + 1 + k});
      edges.push_back({hub(c) + 1 + k, hub(c) + 1 + (k + 1) % 4});
    }
    for (int strand = 0; strand < 2; ++strand) {
      end_of[passages[c][strand].in] = hub(c) + 1 + strand;
      start_of[passages[c][strand].out] = hub(c) + 3 + strand;
      crossing_of_end[passages[c][strand].in] = c;
      crossing_of_start[passages[c][strand].out] = c;
    }
  }
  for (int e = 1; e <= 2 * n; ++e) {
    edges.push_back({start_of[e], 5 * n + e - 1});
    edges.push_back({5 * n + e - 1, end_of[e]});
    parts.unite(crossing_of_start[e], crossing_of_end[e]);
  }
  for (int c = 1; c < n; ++c)
    if (parts.find(c) != parts.find(0)) refuse_code("it falls into several diagrams; lay them out one by one");
  const auto faces = planar_faces(7 * n, edges, {hub(0), hub(0) + 1, hub(0) + 2});
  if (!faces) refuse_code("no diagram in the plane has it");
  std::vector<int> signs(n, 0);
  for (const std::vector<int>& face : *faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const int before = face[k], at = face[(k + 1) % face.size()], after = face[(k + 2) % face.size()];
      if (at >= 5 * n || at % 5 != 0 || before != at + 1) continue;
      // The way in of the first strand, and next to it that of the second one, or its way out.
      signs[at / 5] = (after == at + 2) == passages[at / 5][0].over ? 1 : -1;
    }
  return signs;
}

}  // namespace

PlanarCode planar_code(GaussCode code) {
  const std::vector<std::array<Passage, 2>> passages = passages_of(code);
  if (passages.empty()) refuse_code("it has no crossings");
  if (code.signs.empty()) {
    code.signs = signs_of(passages);
    if (code.signs[code.components[0][0].crossing] < 0)
      for (int& sign : code.signs) sign = -sign;
  }
  if (code.signs.size() != passages.size())
    refuse_code(fmt::format("{} signs for {} crossings", code.signs.size(), passages.size()));
  PlanarCode result;
  for (std::size_t c = 0; c < passages.size(); ++c) {
    const Passage &under = passages[c][passages[c][0].over ? 1 : 0], &over = passages[c][passages[c][0].over ? 0 : 1];
    if (code.signs[c] > 0)
      result.push_back({under.in, over.out, under.out, over.in});
    else
      result.push_back({under.in, over.in, under.out, over.out});
  }
  return result;
}

GaussCode gauss_code(const std::vector<std::vector<int>>& dowker_thistlethwaite) {
  std::size_t n = 0;
  for (const std::vector<int>& component : dowker_thistlethwaite) n += component.size();
  std::vector<GaussCode::Visit> visits(2 * n);
  std::vector<bool> is_set(2 * n, false);
  int crossing = 0;
  for (const std::vector<int>& component : dowker_thistlethwaite)
    for (const int even : component) {
      const std::size_t at = static_cast<std::size_t>(std::abs(std::int64_t{even}));
      if (at % 2 != 0 || at < 2 || at > 2 * n || is_set[at - 1])
        refuse_code(fmt::format("{} is not one of the even numbers 2 to {}, each of which stands once", even, 2 * n));
      is_set[at - 1] = true;
      visits[2 * static_cast<std::size_t>(crossing)] = {crossing, even > 0};
      visits[at - 1] = {crossing, even < 0};
      ++crossing;
    }
  GaussCode code;
  auto at = visits.begin();
  for (const std::vector<int>& component : dowker_thistlethwaite) {
    const auto end = at + static_cast<std::ptrdiff_t>(2 * component.size());
    code.components.emplace_back(at, end);
    at = end;
  }
  return code;
}

}  // namespace unsnarl
