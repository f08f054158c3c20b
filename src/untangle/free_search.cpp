#include "untangle/free_search.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "contact/intersection_finder.h"
#include "geometry/portable_math.h"
#include "geometry/splitmix.h"
#include "mesh/adjacency.h"

namespace unsnarl {
namespace {

/// Patches of more active faces are left alone: the moves needed grow faster than their number [E209] (unit: faces)
constexpr Index most_faces = 100;
/// Tests of two faces whose boxes overlap in one search, at most [E209] (unit: tests)
constexpr std::int64_t most_tests = 2'000'000;
/// Searches from the start, at most: the first that resolves all is kept [E209] (unit: searches)
constexpr int searches = 8;
/// A move that adds a pair is accepted with the chance exp(-1 / temperature); this is the first one (unit: pairs)
constexpr double first_temperature = 0.7;
/// The temperature at the end of a search (unit: pairs)
constexpr double last_temperature = 0.1;
/// Longest moves. The logarithm of a move's length is uniform between those of the shortest and the longest (unit: h)
constexpr double longest_move = 2;
/// Moves are no shorter than this (unit: h)
constexpr double shortest_move = 0.02;
/// Share of moves of a vertex of an intersecting face; the others take any vertex (no unit)
constexpr double share_in_conflict = 0.8;
/// Rings freed around the intersecting faces of components that are larger, at most (unit: rings)
constexpr int most_rings = 3;
/// Bound of the motion (unit: h)
constexpr double reach_of_search = 20;
/// Sweeps over the vertices on the way back to rest (unit: sweeps)
constexpr int sweeps_back = 20;
/// A vertex goes back by the first of these shares of its way that brings no pair (no unit)
constexpr std::array<double, 3> shares_back = {1, 0.5, 0.125};

/// Random numbers, the same everywhere.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : state_(splitmix_step * (seed << 32)) {}
  double operator()() { return splitmix_number(state_ += splitmix_step); }  // in [0, 1)
  Index below(Index count) { return std::min(count - 1, static_cast<Index>((*this)() * count)); }
  Vec3 direction() {
    for (;;) {
      const double x = (*this)(), y = (*this)(), z = (*this)();
      const Vec3 at = 2 * Vec3(x, y, z) - Vec3::Ones();
      const double length = at.norm();
      if (length > 0 && length <= 1) return at / length;
    }
  }

 private:
  std::uint64_t state_;
};

/// The pairs of a patch's active faces while vertices move one by one.
class PairsOfFaces {
 public:
  PairsOfFaces(Patch& patch, const Task& task)
      : patch_(patch), tolerated_(task.tolerated), around_(triangles_of_vertices(patch.triangles, vertex_count())) {
    const auto count = static_cast<std::size_t>(face_count());
    meets_.assign(count * static_cast<std::size_t>(patch.active_count), 0);
    is_tolerated_ = meets_;
    for (const IntersectingPair& pair : tolerated_) {
      if (pair.a < patch.active_count) is_tolerated_[at(pair.a, pair.b)] = 1;
      if (pair.b < patch.active_count) is_tolerated_[at(pair.b, pair.a)] = 1;
    }
    const Passing passing = patch.passing();
    for (Index t = 0; t < patch.active_count; ++t)
      for (Index u = 0; u < face_count(); ++u)
        if (!passing.meet(patch.triangles, t, u)) is_tolerated_[at(t, u)] = 1;
    boxes_.resize(count);
    of_face_.assign(count, 0);
    for (Index t = 0; t < face_count(); ++t) boxes_[t] = box_of(patch_.x, patch_.triangles[t]);
    for (Index t = 0; t < patch.active_count; ++t) test(t);
  }

  Index total() const { return total_; }
  std::int64_t tests() const { return tests_; }

  /// Moves a free vertex.
  void move(Index v, const Vec3& to) {
    patch_.x.col(v) = to;
    for (const Index t : around_[v]) boxes_[t] = box_of(patch_.x, patch_.triangles[t]);
    for (const Index t : around_[v]) test(t);
  }

  /// A vertex of the k-th face that intersects another one, counted from a random one on; free or not.
  Index in_conflict(Numbers& random) const {
    const Index first = random.below(patch_.active_count);
    for (Index k = 0; k < patch_.active_count; ++k) {
      const Index t = (first + k) % patch_.active_count;
      if (of_face_[t] > 0) return patch_.triangles[t][random.below(3)];
    }
    return random.below(patch_.free_count);
  }

 private:
  Index vertex_count() const { return static_cast<Index>(patch_.x.cols()); }
  Index face_count() const { return static_cast<Index>(patch_.triangles.size()); }
  std::size_t at(Index active, Index other) const {
    return static_cast<std::size_t>(active) * patch_.triangles.size() + static_cast<std::size_t>(other);
  }

  /// Tests an active face against all others.
  void test(Index t) {
    for (Index u = 0; u < face_count(); ++u) {
      if (u == t || is_tolerated_[at(t, u)]) continue;
      PairClass kind;
      const bool is_near = boxes_[t].overlaps(boxes_[u]);
      const bool meets = is_near && intersects(patch_.x, patch_.triangles[t], patch_.triangles[u], kind);
      tests_ += is_near;
      std::uint8_t& known = meets_[at(t, u)];
      if (known == static_cast<std::uint8_t>(meets)) continue;
      known = meets;
      if (u < patch_.active_count) meets_[at(u, t)] = meets;
      const Index change = meets ? 1 : -1;
      total_ += change;
      of_face_[t] += change;
      of_face_[u] += change;
    }
  }

  Patch& patch_;
  std::span<const IntersectingPair> tolerated_;
  IndexLists around_;
  std::vector<std::uint8_t> meets_, is_tolerated_;  // per active face and face
  std::vector<Box> boxes_;
  std::vector<Index> of_face_;  // number of its pairs
  Index total_ = 0;
  std::int64_t tests_ = 0;
};

bool is_asked_to_stop(const Task& task) {
  return task.stop && task.stop();
}

/// Whether few faces have one of these vertices.
bool have_few_faces(const Scene& scene, std::span<const Index> vertices) {
  std::vector<Index> faces;
  for (const Index v : vertices) {
    faces.insert(faces.end(), scene.triangles_of_vertex[v].begin(), scene.triangles_of_vertex[v].end());
    if (faces.size() > 3 * most_faces) return false;
  }
  std::sort(faces.begin(), faces.end());
  return std::unique(faces.begin(), faces.end()) - faces.begin() <= most_faces;
}

/// The components of a region, or as many rings around it as leave few faces free; none: it has too many.
std::vector<Index> few_vertices_around(const Conflicts& conflicts, const ConflictRegion& region) {
  const Scene& scene = conflicts.scene;
  if (!have_few_faces(scene, region.core)) return {};
  std::vector<Index> free = free_vertices_of_components(scene, conflicts.parts(), region.core);
  for (int rings = most_rings; !have_few_faces(scene, free); --rings) free = dilate(scene, region.core, rings);
  return free;
}

/// Ends with the fewest pairs that it came to. Returns the number of moves.
int anneal(Patch& patch, PairsOfFaces& pairs, const Task& task, Numbers& random) {
  Positions best = patch.x;
  Index fewest = pairs.total();
  int moves = 0;
  for (; fewest > 0 && pairs.tests() < most_tests && !is_asked_to_stop(task); ++moves) {
    const double done = static_cast<double>(pairs.tests()) / static_cast<double>(most_tests);
    const double temperature = first_temperature * portable::pow(last_temperature / first_temperature, done);
    const Index v = random() < share_in_conflict ? pairs.in_conflict(random) : random.below(patch.free_count);
    const double length = shortest_move * portable::pow(longest_move / shortest_move, random());
    const Vec3 step = length * patch.edge_length * random.direction();
    const double chance = random();
    if (v >= patch.free_count) continue;
    const Vec3 before = patch.x.col(v);
    const Index total = pairs.total();
    pairs.move(v, before + step);
    if (pairs.total() > total && !(chance < portable::exp((total - pairs.total()) / temperature)))
      pairs.move(v, before);
    if (pairs.total() < fewest) {
      fewest = pairs.total();
      best = patch.x;
    }
  }
  patch.x = best;
  return moves;
}

/// Takes vertices back towards rest as far as no pair returns.
void go_back(Patch& patch, PairsOfFaces& pairs, const Task& task) {
  for (int sweep = 0; sweep < sweeps_back && !is_asked_to_stop(task); ++sweep) {
    for (Index v = 0; v < patch.free_count; ++v) {
      const Vec3 before = patch.x.col(v), way = patch.rest.col(v) - before;
      for (const double share : shares_back) {
        pairs.move(v, before + share * way);
        if (pairs.total() == 0) break;
        pairs.move(v, before);
      }
    }
  }
}

}  // namespace

int search_freely(Patch& patch, const Task& task) {
  if (patch.active_count > most_faces) return 0;
  const Positions start = patch.x;
  Positions best = start;
  Index fewest = PairsOfFaces(patch, task).total();
  int moves = 0;
  for (int search = 0; search < searches && fewest > 0 && !is_asked_to_stop(task); ++search) {
    patch.x = start;
    PairsOfFaces pairs(patch, task);
    Numbers random(static_cast<std::uint64_t>(search) + 1);
    moves += anneal(patch, pairs, task, random);
    PairsOfFaces reached(patch, task);
    if (reached.total() == 0) go_back(patch, reached, task);
    if (reached.total() >= fewest) continue;
    fewest = reached.total();
    best = patch.x;
  }
  patch.x = best;
  return moves;
}

Strategy free_search() {
  const auto select = [](const Conflicts& conflicts) {
    return select_regions(conflicts, any_valence, [&](const ConflictRegion&) {
      const auto free = [&](const ConflictRegion& region) { return few_vertices_around(conflicts, region); };
      return std::optional<Extent>({.free_vertices = free, .reach = reach_of_search});
    });
  };
  return {.name = "free_search", .select = select, .solve = search_freely};
}

}  // namespace unsnarl
