#include "samples/regular_maps.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "samples/lattice_noise.h"
#include "samples/mesh_builder.h"
#include "samples/sample_maker.h"

namespace unsnarl {
namespace {

/// A vector of the plane over the field of seven elements, of the two that differ by sign the smaller one.
using Residues = std::array<int, 2>;

Residues up_to_sign(int a, int b) {
  const auto reduced = [](int k) { return ((k % 7) + 7) % 7; };
  return std::min(Residues{reduced(a), reduced(b)}, Residues{reduced(-a), reduced(-b)});
}

using Places = std::vector<std::array<int, 3>>;

/// An embedding of Klein's map that the rotations of a tetrahedron leave as it is, found by
/// `unsnarl_map_search klein --symmetry T --grid 20 --starts 30 --roomier 1500` (bench/map_search.cpp): the one with
/// the most clearance. The first of this symmetry is in E. Schulte, J. M. Wills: "A polyhedral realization of Felix
/// Klein's map {3,7}_8 on a Riemann surface of genus 3" (1985).
const Places klein_places = {{-11, 20, -20}, {20, -20, -11}, {-20, -11, 20}, {11, -20, -20}, {-7, 8, -18},
                             {7, 8, 18},     {-8, 18, -7},   {20, 20, 11},   {20, -11, -20}, {7, -8, -18},
                             {-20, 20, -11}, {-20, 11, -20}, {18, 7, 8},     {11, 20, 20},   {-18, 7, -8},
                             {-18, -7, 8},   {-7, -8, 18},   {20, 11, 20},   {-20, -20, 11}, {18, -7, -8},
                             {-8, -18, 7},   {8, 18, 7},     {-11, -20, 20}, {8, -18, -7}};

/// An embedding of Dyck's map that the rotations of a triangular prism leave as it is, found by
/// `unsnarl_map_search dyck --symmetry D3 --grid 20 --starts 40 --roomier 1500`. Others are in U. Brehm: "Maximally
/// symmetric polyhedral realizations of Dyck's regular map" (1987), and J. Bokowski: "A geometric realization without
/// self-intersections does exist for Dyck's regular map" (1989).
const Places dyck_places = {{5, 20, -12}, {-20, -5, 12}, {10, -5, 7},   {5, -10, -7}, {20, -12, 5}, {-5, 12, -20},
                            {-5, 7, 10},  {-10, -7, 5},  {12, -20, -5}, {7, 10, -5},  {-7, 5, -10}, {-12, 5, 20}};

/// Half the side of the box of both embeddings.
constexpr double half_side = 20;

/// The map at these places, shaken; or anywhere in the same box.
Surface regular_map(const std::vector<Triangle>& faces, const Places& places, const SampleValues& values) {
  const double reach = values["noise"] * 2 * half_side;
  const auto seed = static_cast<std::uint32_t>(values.whole("seed"));
  const bool is_random = values.whole("random") == 1;
  MeshBuilder builder;
  std::uint32_t number = 0;
  for (const auto& place : places) {
    Vec3 position;
    for (int k = 0; k < 3; ++k) {
      const double shift = 2 * hashed_unit(seed, number++) - 1;
      position[k] = (is_random ? half_side * shift : place[k] + reach * shift) / half_side;
    }
    builder.add_vertex(position);
  }
  for (const auto& [a, b, c] : faces) builder.add_face({a, b, c});
  return builder.take();
}

std::vector<SampleParameter> regular_map_parameters(double noise) {
  return {{"noise", noise, 0, 0.5, "largest shift along each axis, as a share of the side of the box; 0: embedded"},
          {"seed", 1, 0, 1e9, "which random numbers", true},
          {"random", 0, 0, 1, "1: the vertices are anywhere in the box instead", true}};
}

}  // namespace

std::vector<SampleMaker> regular_map_samples() {
  return {
      {{"klein_map", "Klein's regular map {3,7} (R3.1), an embedding of it shaken: genus 3, 24 vertices, 56 faces",
        regular_map_parameters(0.1)},
       56,
       [](int, const SampleValues& values) { return regular_map(klein_map_faces(), klein_places, values); }},
      {{"dyck_map", "Dyck's regular map {3,8} (R3.2), an embedding of it shaken: genus 3, 12 vertices, 32 faces",
        regular_map_parameters(0.1)},
       32,
       [](int, const SampleValues& values) { return regular_map(dyck_map_faces(), dyck_places, values); }},
  };
}

std::vector<Triangle> klein_map_faces() {
  std::map<Residues, Index> id;
  for (int a = 0; a < 7; ++a)
    for (int b = 0; b < 7; ++b)
      if (a != 0 || b != 0) id.emplace(up_to_sign(a, b), static_cast<Index>(id.size()));
  std::vector<Triangle> faces;
  std::set<Triangle> seen;
  for (const auto& [p, first] : id)
    for (const auto& [q, third] : id)
      for (const int sign : {1, -1}) {
        if (((sign * (p[0] * q[1] - p[1] * q[0])) % 7 + 7) % 7 != 1) continue;
        Triangle face = {first, id.at(up_to_sign(p[0] + sign * q[0], p[1] + sign * q[1])), third};
        while (face[0] > face[1] || face[0] > face[2]) face = {face[1], face[2], face[0]};
        if (seen.insert(face).second) faces.push_back(face);
      }
  return faces;
}

std::vector<Triangle> dyck_map_faces() {
  std::vector<Triangle> faces;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      faces.push_back({a, 4 + b, 8 + (8 - a - b) % 4});
      faces.push_back({a, 8 + (9 - a - b) % 4, 4 + b});
    }
  return faces;
}

}  // namespace unsnarl
