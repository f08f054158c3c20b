#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "same_bytes/known_hashes.h"
#include "unsnarl/curves.h"
#include "unsnarl/document.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/repair.h"
#include "unsnarl/samples.h"

/// What is written is the same bytes on every machine: digits and floats of mesh files, drawings.
namespace unsnarl {
namespace {

using same_bytes::Bytes;
using same_bytes::expect_known;

template <class Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string obj(const Surface& surface) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t k = 0; k < surface.positions.size(); k += 3)
    text << "v " << surface.positions[k] << ' ' << surface.positions[k + 1] << ' ' << surface.positions[k + 2] << '\n';
  for (std::size_t f = 0; f < SurfaceView(surface).face_count(); ++f) {
    text << 'f';
    for (const std::int32_t v : SurfaceView(surface).face(f)) text << ' ' << v + 1;
    text << '\n';
  }
  return text.str();
}

std::string off(const Surface& surface) {
  std::ostringstream text;
  text.precision(9);
  text << "OFF\r\n" << SurfaceView(surface).vertex_count() << ' ' << SurfaceView(surface).face_count() << " 0\r\n";
  for (std::size_t k = 0; k < surface.positions.size(); k += 3)
    text << surface.positions[k] << ' ' << surface.positions[k + 1] << ' ' << surface.positions[k + 2] << "\r\n";
  for (std::size_t f = 0; f < SurfaceView(surface).face_count(); ++f) {
    const auto corners = SurfaceView(surface).face(f);
    text << corners.size();
    for (const std::int32_t v : corners) text << ' ' << v;
    text << "\r\n";
  }
  return text.str();
}

std::string ply(const Surface& surface) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(SurfaceView(surface).vertex_count()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(SurfaceView(surface).face_count()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const double p : surface.positions) append(bytes, static_cast<float>(p));
  for (std::size_t f = 0; f < SurfaceView(surface).face_count(); ++f) {
    const auto corners = SurfaceView(surface).face(f);
    append(bytes, static_cast<std::uint8_t>(corners.size()));
    for (const std::int32_t v : corners) append(bytes, v);
  }
  return bytes;
}

/// Polygons as fans.
std::string stl(const Surface& surface) {
  std::string triangles;
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < SurfaceView(surface).face_count(); ++f) {
    const auto corners = SurfaceView(surface).face(f);
    for (std::size_t c = 2; c < corners.size(); ++c, ++count) {
      for (int k = 0; k < 3; ++k) append(triangles, 0.0F);
      for (const std::int32_t v : {corners[0], corners[c - 1], corners[c]})
        for (std::size_t k = 0; k < 3; ++k)
          append(triangles, static_cast<float>(surface.positions[3 * static_cast<std::size_t>(v) + k]));
      append(triangles, std::uint16_t{0});
    }
  }
  std::string bytes(80, ' ');
  append(bytes, count);
  return bytes + triangles;
}

Bytes repaired(const std::string& bytes, Format format) {
  const Document document = Document::parse(bytes, format);
  RepairOptions options;
  options.as_written = [&](std::span<const double> positions, bool float32) {
    return document.as_written(positions, float32);
  };
  const RepairResult result = repair(document.surface(), options);
  Bytes all;
  all << result.status << bytes;
  for (const OutputFile& file : document.patched(result.positions, result.report.float32_embedded)) all << file.bytes;
  return all;
}

TEST(same_bytes_of_files, meshes) {
  const Surface quads = make_sample("overlapping_quads", 20), tubes = make_sample("crossing_tubes", 14);
  expect_known("OBJ file", repaired(obj(quads), Format::obj));
  expect_known("OFF file", repaired(off(quads), Format::off));
  expect_known("PLY file", repaired(ply(quads), Format::ply));
  expect_known("STL file", repaired(stl(tubes), Format::stl));
}

TEST(same_bytes_of_files, drawings) {
  const std::vector<Curve> curves{random_closed_curve(random_curve_kinds().front(), 7, 60)};
  const CurveResult result = untangle_curves(curves);
  expect_known("SVG drawing", Bytes() << curve_picture_svg(curves, find_crossings(curves), result.curves, {}));
}

}  // namespace
}  // namespace unsnarl
