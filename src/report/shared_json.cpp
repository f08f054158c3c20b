#include "report/shared_json.h"

namespace unsnarl {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json topology_json(const Topology& t) {
  return {{"vertices", t.vertices},
          {"faces", t.faces},
          {"triangles", t.triangles},
          {"components", t.components},
          {"closed_components", t.closed_components},
          {"non_orientable_components", t.non_orientable_components},
          {"boundary_edges", t.boundary_edges},
          {"non_manifold_edges", t.non_manifold_edges},
          {"non_manifold_vertices", t.non_manifold_vertices},
          {"duplicate_faces", t.duplicate_faces},
          {"zero_area_faces", t.zero_area_faces},
          {"duplicate_vertices", t.duplicate_vertices},
          {"unused_vertices", t.unused_vertices}};
}

Json pair_counts_json(const PairCounts& counts) {
  Json by_class = Json::object();
  for (std::size_t i = 0; i < pair_class_count; ++i) by_class[std::string(pair_class_names[i])] = counts.by_class[i];
  return {{"total", counts.total()}, {"by_class", by_class}};
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace unsnarl
