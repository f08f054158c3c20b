#pragma once

#include <unsnarl/surface.h>

#include <cmath>

/// Two square sheets of quads. The lower one bulges through the upper, flat one.
inline unsnarl::Surface crossing_sheets(int n = 12) {
  unsnarl::Surface surface;
  surface.offsets = {0};
  for (int sheet = 0; sheet < 2; ++sheet) {
    const int first = sheet * (n + 1) * (n + 1);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        const double x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
        const double z = sheet == 0 ? 0 : 0.3 * std::exp(-4 * (x * x + y * y)) - 0.15;
        surface.positions.insert(surface.positions.end(), {x, y, z});
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int corner = first + i * (n + 1) + j;
        surface.corners.insert(surface.corners.end(), {corner, corner + n + 1, corner + n + 2, corner + 1});
        surface.offsets.push_back(static_cast<int>(surface.corners.size()));
      }
  }
  return surface;
}
