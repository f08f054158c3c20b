#include "io/vtk_cells.h"

#include <fmt/format.h>

#include <array>

namespace unsnarl {
namespace {

/// Types of cells of points and faces (fixed by the format)
namespace vtk_cell {
enum : std::uint8_t {
  vertex = 1,
  poly_vertex,
  line,
  poly_line,
  triangle,
  triangle_strip,
  polygon,
  pixel,
  quad,
};
}  // namespace vtk_cell

std::string wrong_size(const char* kind, std::size_t size) {
  return fmt::format("has {} points, but is a {}", size, kind);
}

}  // namespace

std::string add_vtk_cell(PointFile& file, std::int64_t type, std::span<const std::int64_t> points) {
  switch (type) {
    case vtk_cell::vertex:
    case vtk_cell::poly_vertex:
    case vtk_cell::line:
    case vtk_cell::poly_line: return {};
    case vtk_cell::triangle: return points.size() == 3 ? file.add_face(points) : wrong_size("triangle", points.size());
    case vtk_cell::quad: return points.size() == 4 ? file.add_face(points) : wrong_size("quad", points.size());
    case vtk_cell::polygon: return file.add_face(points);
    case vtk_cell::triangle_strip: return file.add_strip(points);
    case vtk_cell::pixel:
      if (points.size() != 4) return wrong_size("pixel", points.size());
      return file.add_face(std::array{points[0], points[1], points[3], points[2]});
  }
  return fmt::format(
      "is of type {}: only triangles, quads, polygons and strips are read; extract the surface first (in ParaView: "
      "Filters > Extract Surface)",
      type);
}

}  // namespace unsnarl
