#include <vector>

#include "fuzz/lattice_mesh.h"
#include "fuzz/promise.h"
#include "fuzz/targets.h"
#include "oracle/intersections_oracle.h"
#include "scene/prepared_surface.h"
#include "unsnarl/certify.h"

namespace unsnarl::fuzz {

void intersections(Bytes bytes) {
  ByteReader reader(bytes);
  const LatticeMesh mesh(reader, {.vertices = 16, .faces = 24, .largest_exponent = 120});
  const std::vector<IntersectingPair> found = find_intersections(mesh.surface, mesh.find);

  const PreparedSurface prepared = prepare(mesh.surface, mesh.find);
  std::vector<std::int64_t> coordinates;
  for (const Index v : prepared.weld_map.first)
    for (int k = 0; k < 3; ++k) coordinates.push_back(mesh.coordinates[3 * static_cast<std::size_t>(v) + k]);
  const auto expected = pairs_of_faces(prepared.triangulation.polygon,
                                       oracle::intersections_by_brute_force(coordinates, prepared.triangles()));
  promise(found == expected, "find_intersections finds what brute force finds");

  const Certificate certificate = certify(mesh.surface, mesh.surface.positions, mesh.find);
  promise(certificate.pairs.by_class == count_by_class(found).by_class, "a certificate counts the pairs found");
  promise(certificate.new_zero_area_faces == 0 && certificate.seams_closed, "the input is as good as itself");
}

}  // namespace unsnarl::fuzz
