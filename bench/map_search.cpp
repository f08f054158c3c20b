// Looks for embeddings of the regular maps of the samples: whole-number coordinates, from random ones by simulated
// annealing of how often edges meet faces, with or without a group of rotations imposed. The coordinates of
// samples/regular_maps.cpp were found so, and docs/regular_maps.md has a table.
//   build/release/bench/unsnarl_map_search klein --symmetry T --grid 20 --starts 30 --roomier 1500 -o klein.obj
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/map_automorphisms.h"
#include "contact/distances.h"
#include "geometry/predicates.h"
#include "geometry/splitmix.h"
#include "samples/regular_maps.h"
#include "unsnarl/intersections.h"

namespace unsnarl {
namespace {

/// Rotations of the lattice of whole numbers.
using Rotation = Eigen::Matrix3i;

Rotation rotation(std::initializer_list<int> entries) {
  Rotation matrix;
  int k = 0;
  for (const int entry : entries) matrix(k / 3, k % 3) = entry, ++k;
  return matrix;
}

/// Generators of a group of rotations, by Schoenflies' name; none for "none".
std::vector<Rotation> generators(const std::string& name) {
  const Rotation third = rotation({0, 1, 0, 0, 0, 1, 1, 0, 0}), half = rotation({-1, 0, 0, 0, -1, 0, 0, 0, 1});
  const Rotation across = rotation({1, 0, 0, 0, -1, 0, 0, 0, -1}), diagonal = rotation({0, -1, 0, -1, 0, 0, 0, 0, -1});
  const std::map<std::string, std::vector<Rotation>> known = {
      {"none", {}},        {"C2", {half}}, {"C3", {third}}, {"D2", {half, across}}, {"D3", {third, diagonal}},
      {"T", {third, half}}};
  return known.at(name);
}

/// A group that acts on the vertices and on space alike.
struct Action {
  std::vector<VertexMap> vertices;
  std::vector<Rotation> rotations;
};

VertexMap after(const VertexMap& second, const VertexMap& first) {
  VertexMap both(first.size());
  for (std::size_t v = 0; v < first.size(); ++v) both[v] = second[first[v]];
  return both;
}

struct LessByEntries {
  bool operator()(const Rotation& a, const Rotation& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 9, b.data(), b.data() + 9);
  }
};

/// The group that pairs of an automorphism and a rotation generate, where it is the graph of an isomorphism.
std::optional<Action> generated(const std::vector<VertexMap>& automorphisms, const std::vector<Rotation>& rotations,
                                std::size_t vertex_count) {
  VertexMap identity(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) identity[v] = static_cast<Index>(v);
  std::map<VertexMap, Rotation> group = {{identity, Rotation::Identity()}};
  std::vector<VertexMap> open = {identity};
  while (!open.empty()) {
    const VertexMap element = open.back();
    open.pop_back();
    const Rotation turn = group.at(element);
    for (std::size_t k = 0; k < rotations.size(); ++k) {
      const VertexMap next = after(automorphisms[k], element);
      const auto [place, is_new] = group.emplace(next, rotations[k] * turn);
      if (!is_new && place->second != rotations[k] * turn) return {};
      if (is_new) open.push_back(next);
      if (group.size() > 12) return {};  // as many as the tetrahedron has
    }
  }
  Action action;
  std::set<Rotation, LessByEntries> distinct;
  for (const auto& [element, turn] : group) {
    action.vertices.push_back(element);
    action.rotations.push_back(turn);
    distinct.insert(turn);
  }
  if (distinct.size() != group.size()) return {};
  return action;
}

/// All ways of the rotations to act on the map, of those that an automorphism turns into each other the first.
std::vector<Action> actions(const std::vector<VertexMap>& automorphisms, const std::vector<Rotation>& rotations,
                            std::size_t vertex_count) {
  std::vector<Action> found;
  std::set<std::vector<VertexMap>> seen;
  std::vector<std::size_t> choice(rotations.size(), 0);
  for (bool more = true; more;) {
    std::vector<VertexMap> chosen;
    chosen.reserve(choice.size());
    for (const std::size_t k : choice) chosen.push_back(automorphisms[k]);
    if (const auto action = generated(chosen, rotations, vertex_count); action && !seen.contains(action->vertices)) {
      for (const VertexMap& a : automorphisms) {
        VertexMap back(vertex_count);
        for (std::size_t v = 0; v < vertex_count; ++v) back[a[v]] = static_cast<Index>(v);
        std::vector<VertexMap> conjugate;
        for (const VertexMap& element : action->vertices) conjugate.push_back(after(a, after(element, back)));
        std::sort(conjugate.begin(), conjugate.end());
        seen.insert(conjugate);
      }
      found.push_back(*action);
    }
    more = false;
    for (std::size_t k = 0; k < choice.size() && !more; ++k) {
      choice[k] = (choice[k] + 1) % automorphisms.size();
      more = choice[k] != 0;
    }
  }
  return found;
}

/// Numbers from SplitMix64.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x2545f4914f6cdd1dULL) {}
  double unit() { return splitmix_number(state_ += splitmix_step); }
  int within(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }

 private:
  std::uint64_t state_;
};

/// True where the segment meets the closed triangle, or is in a special position to it.
bool meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (orient3d(a, b, c, p) * orient3d(a, b, c, q) > 0) return false;
  const Sign ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c), ca = orient3d(p, q, c, a);
  return !((ab > 0 || bc > 0 || ca > 0) && (ab < 0 || bc < 0 || ca < 0));
}

Edge edge_between(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The map with an action of a group, and where its vertices are: those of an orbit where the first one's place says.
class Placement {
 public:
  Placement(std::vector<Triangle> faces, Index vertex_count, Action action)
      : faces_(std::move(faces)), action_(std::move(action)), x_(3, vertex_count) {
    orbit_of_.assign(static_cast<std::size_t>(vertex_count), -1);
    mover_.assign(orbit_of_.size(), 0);
    for (Index v = 0; v < vertex_count; ++v) {
      if (orbit_of_[v] >= 0) continue;
      stabiliser_.emplace_back();
      for (std::size_t g = 0; g < action_.vertices.size(); ++g) {
        const Index image = action_.vertices[g][v];
        if (image == v) stabiliser_.back().push_back(g);
        if (orbit_of_[image] >= 0) continue;
        orbit_of_[image] = static_cast<Index>(stabiliser_.size()) - 1;
        mover_[image] = g;
      }
    }
    place_.assign(stabiliser_.size(), Eigen::Vector3i::Zero());
    list_tests();
  }

  int orbits() const { return static_cast<int>(place_.size()); }
  const Eigen::Vector3i& place(int orbit) const { return place_[orbit]; }
  const Positions& x() const { return x_; }
  const std::vector<Triangle>& faces() const { return faces_; }
  /// How often edges meet faces that they do not belong to, or two faces at an edge are in one plane. 0: embedded.
  int conflicts() const { return conflicts_; }

  /// Puts an orbit's first vertex to a place, or the nearest that what fixes the vertex allows.
  void put(int orbit, const Eigen::Vector3i& wanted) {
    Eigen::Vector3i sum = Eigen::Vector3i::Zero();
    for (const std::size_t g : stabiliser_[orbit]) sum += action_.rotations[g] * wanted;
    place_[orbit] = sum / static_cast<int>(stabiliser_[orbit].size());
    for (Index v = 0; v < x_.cols(); ++v)
      if (orbit_of_[v] == orbit) x_.col(v) = (action_.rotations[mover_[v]] * place_[orbit]).cast<double>();
    for (const std::size_t t : tests_of_orbit_[orbit]) {
      const bool now = is_conflict(tests_[t]);
      conflicts_ += (now - is_hit_[t]) * tests_[t].images;
      is_hit_[t] = now;
    }
  }

  /// Least distance of an edge and an edge or of a vertex and a face that share no vertex, over the diagonal of the
  /// box.
  double clearance() const {
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Stencil& stencil) {
      for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
          if (stencil.v[i] == stencil.v[j]) return;
      least = std::min(least, squared_distance(stencil, x_));
    };
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (std::size_t f = e + 1; f < edges_.size(); ++f)
        consider({StencilKind::edge_edge, {edges_[e][0], edges_[e][1], edges_[f][0], edges_[f][1]}});
    for (const Triangle& t : faces_)
      for (Index v = 0; v < x_.cols(); ++v) consider({StencilKind::vertex_face, {v, t[0], t[1], t[2]}});
    return std::sqrt(least) / (x_.rowwise().maxCoeff() - x_.rowwise().minCoeff()).norm();
  }

 private:
  /// An edge (v[0], v[1]) against a face; or against the two others, v[2] and v[3], of its own two faces.
  struct Test {
    std::array<Index, 4> v;
    Triangle face;  // {-1, -1, -1}: of its own faces
    int images;     // under the group
  };

  bool is_conflict(const Test& t) const {
    const auto at = [&](Index v) { return Vec3(x_.col(v)); };
    if (t.face[0] < 0) return orient3d(at(t.v[0]), at(t.v[1]), at(t.v[2]), at(t.v[3])) == 0;
    return meets(at(t.v[0]), at(t.v[1]), at(t.face[0]), at(t.face[1]), at(t.face[2]));
  }

  void list_tests() {
    std::map<Edge, std::vector<Index>> opposite;
    for (const Triangle& t : faces_)
      for (std::size_t k = 0; k < 3; ++k) opposite[edge_between(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
    std::set<std::array<Index, 5>> seen;  // of the images of tests: edge, then face or the two others
    const auto add = [&](const Edge& edge, const Triangle& face, Index third, Index fourth) {
      Test test{{edge[0], edge[1], third, fourth}, face, 0};
      for (const VertexMap& g : action_.vertices) {
        const Edge e = edge_between(g[edge[0]], g[edge[1]]);
        std::array<Index, 3> others = {third < 0 ? g[face[0]] : -1, third < 0 ? g[face[1]] : g[third],
                                       third < 0 ? g[face[2]] : g[fourth]};
        std::sort(others.begin(), others.end());
        test.images += seen.insert({e[0], e[1], others[0], others[1], others[2]}).second;
      }
      if (test.images > 0) tests_.push_back(test);
    };
    for (const auto& [edge, others] : opposite) {
      edges_.push_back(edge);
      add(edge, {-1, -1, -1}, others[0], others[1]);
      for (const Triangle& face : faces_)
        if (std::none_of(face.begin(), face.end(), [&, e = edge](Index v) { return v == e[0] || v == e[1]; }))
          add(edge, face, -1, -1);
    }
    is_hit_.assign(tests_.size(), 0);
    tests_of_orbit_.resize(place_.size());
    for (std::size_t t = 0; t < tests_.size(); ++t) {
      std::set<Index> of;
      for (const Index v : tests_[t].v)
        if (v >= 0) of.insert(orbit_of_[v]);
      for (const Index v : tests_[t].face)
        if (v >= 0) of.insert(orbit_of_[v]);
      for (const Index orbit : of) tests_of_orbit_[orbit].push_back(t);
    }
  }

  std::vector<Triangle> faces_;
  Action action_;
  std::vector<Edge> edges_;
  std::vector<Index> orbit_of_;                       // of each vertex
  std::vector<std::size_t> mover_;                    // the element that takes the orbit's first vertex there
  std::vector<std::vector<std::size_t>> stabiliser_;  // of each orbit's first vertex
  std::vector<Eigen::Vector3i> place_;                // of each orbit's first vertex
  Positions x_;
  std::vector<Test> tests_;
  std::vector<int> is_hit_;
  std::vector<std::vector<std::size_t>> tests_of_orbit_;
  int conflicts_ = 0;
};

struct SearchOptions {
  std::string map, symmetry = "none", output;
  int grid = 12;              ///< coordinates are within [-grid, grid]
  int starts = 20, seed = 1;  ///< the seed of the first start; every other has the next
  long long moves = 100000;   ///< of each start
  double heat = 3;            ///< conflicts that a move may bring with a chance of 1/e, at first
  int roomier = 0;            ///< further moves of each start that is embedded, towards clearance
};

/// Somewhere anywhere, or nearby.
Eigen::Vector3i moved(const Eigen::Vector3i& from, int grid, Dice& dice) {
  Eigen::Vector3i to;
  const bool is_jump = dice.unit() < 0.2;
  const int step = is_jump ? grid : dice.within(1, 1 + grid / 3);
  for (int k = 0; k < 3; ++k)
    to[k] = is_jump ? dice.within(-grid, grid) : std::clamp(from[k] + dice.within(-step, step), -grid, grid);
  return to;
}

/// Anneals from random positions until there are no conflicts. Returns the number of moves.
long long anneal(Placement& placement, const SearchOptions& options, Dice& dice, int& first, int& least) {
  for (int k = 0; k < placement.orbits(); ++k)
    placement.put(k, {dice.within(-options.grid, options.grid), dice.within(-options.grid, options.grid),
                      dice.within(-options.grid, options.grid)});
  first = least = placement.conflicts();
  long long move = 0;
  for (; move < options.moves && placement.conflicts() > 0; ++move) {
    // Down to 3 % of the first heat, geometrically.
    const double heat = options.heat * std::pow(0.03, static_cast<double>(move) / static_cast<double>(options.moves));
    const int orbit = dice.within(0, placement.orbits() - 1), before = placement.conflicts();
    const Eigen::Vector3i from = placement.place(orbit);
    placement.put(orbit, moved(from, options.grid, dice));
    const int worse = placement.conflicts() - before;
    if (worse > 0 && dice.unit() >= std::exp(-worse / heat)) placement.put(orbit, from);
    least = std::min(least, placement.conflicts());
  }
  return move;
}

/// Takes moves that keep the surface embedded and do not lessen its clearance.
double make_room(Placement& placement, const SearchOptions& options, Dice& dice) {
  double best = placement.clearance();
  for (int move = 0; move < options.roomier; ++move) {
    const int orbit = dice.within(0, placement.orbits() - 1);
    const Eigen::Vector3i from = placement.place(orbit);
    placement.put(orbit, moved(from, options.grid, dice));
    const double now = placement.conflicts() > 0 ? 0 : placement.clearance();
    if (now < best)
      placement.put(orbit, from);
    else
      best = now;
  }
  return best;
}

Surface as_surface(const Positions& x, const std::vector<Triangle>& faces) {
  Surface surface;
  surface.positions.assign(x.data(), x.data() + x.size());
  for (const Triangle& t : faces) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
  return surface;
}

void write_obj(const std::string& path, const Positions& x, const std::vector<Triangle>& faces) {
  std::ofstream file(path);
  for (Index v = 0; v < x.cols(); ++v) file << fmt::format("v {} {} {}\n", x(0, v), x(1, v), x(2, v));
  for (const Triangle& t : faces) file << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}

void search(const SearchOptions& options) {
  const std::vector<Triangle> faces = options.map == "klein" ? klein_map_faces() : dyck_map_faces();
  const Index vertex_count = options.map == "klein" ? 24 : 12;
  const auto automorphisms = map_automorphisms(faces, vertex_count);
  const auto ways = actions(automorphisms, generators(options.symmetry), static_cast<std::size_t>(vertex_count));
  fmt::print("{}: {} automorphisms that keep the orientation; {} acts in {} ways\n", options.map, automorphisms.size(),
             options.symmetry, ways.size());
  double widest = 0;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    int found = 0;
    const std::clock_t begin = std::clock();
    for (int start = 0; start < options.starts; ++start) {
      Dice dice(static_cast<std::uint64_t>(options.seed + start));
      Placement placement(faces, vertex_count, ways[way]);
      int first = 0, least = 0;
      const long long moves = anneal(placement, options, dice, first, least);
      std::string line = fmt::format("way {}, seed {}: {} conflicts, then {}", way, options.seed + start, first, least);
      if (placement.conflicts() == 0) {
        if (!find_intersections(as_surface(placement.x(), faces)).empty())
          throw std::logic_error("no conflicts, but faces intersect");
        ++found;
        const double room = make_room(placement, options, dice);
        line += fmt::format(": embedded after {} moves, clearance {:.4f}:", moves, room);
        for (int k = 0; k < placement.orbits(); ++k)
          line += fmt::format(" {{{}, {}, {}}}", placement.place(k)[0], placement.place(k)[1], placement.place(k)[2]);
        if (room > widest && !options.output.empty()) write_obj(options.output, placement.x(), faces);
        widest = std::max(widest, room);
      }
      fmt::print("{}\n", line);
    }
    fmt::print("way {}, {} unknowns at most: {} of {} starts embedded, {:.3g} s of CPU each\n", way,
               3 * Placement(faces, vertex_count, ways[way]).orbits(), found, options.starts,
               static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / options.starts);
  }
}

}  // namespace
}  // namespace unsnarl

int main(int argc, char** argv) {
  CLI::App app("Looks for embeddings of regular maps of genus 3.");
  unsnarl::SearchOptions options;
  app.add_option("MAP", options.map)->required()->check(CLI::IsMember({"klein", "dyck"}));
  app.add_option("--symmetry", options.symmetry, "Rotations to impose")
      ->check(CLI::IsMember({"none", "C2", "C3", "D2", "D3", "T"}));
  app.add_option("--grid", options.grid, "Coordinates are whole numbers up to it")->check(CLI::Range(1, 1000));
  app.add_option("--starts", options.starts)->check(CLI::PositiveNumber);
  app.add_option("--seed", options.seed)->check(CLI::PositiveNumber);
  app.add_option("--moves", options.moves)->check(CLI::PositiveNumber);
  app.add_option("--heat", options.heat)->check(CLI::PositiveNumber);
  app.add_option("--roomier", options.roomier, "Moves towards clearance after a find")->check(CLI::NonNegativeNumber);
  app.add_option("-o", options.output, "Where the one with the most clearance goes, OBJ");
  CLI11_PARSE(app, argc, argv);
  try {
    unsnarl::search(options);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
}
