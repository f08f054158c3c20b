#include "samples/parameter_grid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace unsnarl {

Surface sample_grid(const ParameterGrid& grid, const std::function<Vec3(double u, double v)>& f) {
  const ParameterRange &u = grid.u, &v = grid.v;
  const int columns = u.seam == Seam::open ? u.steps + 1 : u.steps;
  const int rows = v.seam == Seam::open ? v.steps + 1 : v.steps;
  const double u_shift = u.seam == Seam::open ? 0 : u.shift;
  const double v_shift = v.seam == Seam::open ? 0 : u.seam == Seam::mirrored ? 0.5 : v.shift;
  MeshBuilder builder;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      builder.add_vertex(f(u.minimum + (i + u_shift) * u.step(), v.minimum + (j + v_shift) * v.step()));
  const auto vertex = [&](int i, int j) {
    if (i == columns && u.seam == Seam::mirrored) j = v.seam == Seam::open ? v.steps - j : 2 * rows - 1 - j;
    return static_cast<Index>((i % columns) * rows + j % rows);
  };
  for (int i = 0; i < u.steps; ++i)
    for (int j = 0; j < v.steps; ++j) {
      if (grid.keep &&
          !grid.keep(u.minimum + (i + 0.5 + u_shift) * u.step(), v.minimum + (j + 0.5 + v_shift) * v.step()))
        continue;
      builder.add_cell(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1), vertex(i + 1, j), grid.faces,
                       (i + j) % 2 != 0);
    }
  return builder.take();
}

int steps_for(double length, int reference, double reference_length, int minimum) {
  return std::max(minimum, static_cast<int>(std::lround(length / reference_length * reference)));
}

}  // namespace unsnarl
