#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

/// What is fuzzed. A target takes any bytes and ends the process, with a message, where a promise is broken; libFuzzer
/// runs them on bytes that it makes up (libfuzzer_main.cpp), the tests on bytes that are kept (replay_main.cpp).
namespace unsnarl::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A file of this format: read or refused; and what was read keeps the promises of Document.
void obj(Bytes bytes);
void off(Bytes bytes);
void ply(Bytes bytes);
void stl(Bytes bytes);
void gltf(Bytes bytes);  ///< also GLB: whatever starts with 'glTF'
void surf(Bytes bytes);
void gii(Bytes bytes);
void vtk(Bytes bytes);
void vtp(Bytes bytes);
void msh(Bytes bytes);
void inp(Bytes bytes);
void threemf(Bytes bytes);
/// A point cache: read or refused; what was read keeps the promises of PointCache.
void pc2(Bytes bytes);
void mdd(Bytes bytes);
/// A file of curves: read or refused; what was read keeps the promises of CurveDocument and, where it is small, those
/// of untangle_curves.
void curves_svg(Bytes bytes);
void curves_json(Bytes bytes);
/// A plan of routes: read or refused; what was read comes back as it was written, and is judged without failing.
void routes_plan(Bytes bytes);
/// A knot or link as points, code or braid: read or refused; what was read comes back as it was written.
void link(Bytes bytes);
/// An isotopy of a knot: the same, and it is certified or refused without failing.
void knot_isotopy(Bytes bytes);
/// The first bytes of any file: they are refused as every format but the one that they tell.
void content(Bytes bytes);
/// A small mesh on a lattice: the pairs found are those that brute force finds.
void intersections(Bytes bytes);
/// A small mesh on a lattice: what `repair` returns is what it promises.
void repair(Bytes bytes);

struct Target {
  std::string_view name;
  void (*run)(Bytes bytes);
};
inline constexpr std::array<Target, 22> targets = {{{"obj", obj},
                                                    {"off", off},
                                                    {"ply", ply},
                                                    {"stl", stl},
                                                    {"gltf", gltf},
                                                    {"surf", surf},
                                                    {"gii", gii},
                                                    {"vtk", vtk},
                                                    {"vtp", vtp},
                                                    {"msh", msh},
                                                    {"inp", inp},
                                                    {"threemf", threemf},
                                                    {"pc2", pc2},
                                                    {"mdd", mdd},
                                                    {"curves_svg", curves_svg},
                                                    {"curves_json", curves_json},
                                                    {"routes_plan", routes_plan},
                                                    {"link", link},
                                                    {"knot_isotopy", knot_isotopy},
                                                    {"content", content},
                                                    {"intersections", intersections},
                                                    {"repair", repair}}};

}  // namespace unsnarl::fuzz
