#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/point_file.h"

namespace unsnarl {

/// Adds a cell of an unstructured grid of VTK (vtkCellType.h), by the 0-based ids of its points: triangles, quads,
/// pixels, polygons and strips are faces, points and lines are passed on. Returns what is wrong with it, to follow
/// "cell 7"; empty: nothing.
std::string add_vtk_cell(PointFile& file, std::int64_t type, std::span<const std::int64_t> points);

}  // namespace unsnarl
