#pragma once

#include <string>
#include <vector>

namespace unsnarl::fuzz {

/// Long texts that nest one thing within itself, closed and cut short: of what is here, no reader may follow all.
inline std::vector<std::string> nested_shapes() {
  constexpr std::size_t depth = 200000;
  struct Shape {
    std::string before, open, close, after;
  };
  const std::vector<Shape> shapes = {
      {"", "[", "]", ""},
      {"", "{\"a\":", "}", ""},
      {"{\"agents\":", "[", "]", "}"},
      {"{\"agents\":[{\"name\":\"a\",\"radius\":1,\"start\":", "[", "]", "}]}"},
      {"{\"curves\":[{\"points\":", "[", "]", "}]}"},
      {"{\"schema\":\"unsnarl-report\",\"schema_version\":", "[", "]", "}"},
      {"{\"schema\":\"unsnarl-knot-isotopy\",\"keyframes\":", "[", "]", "}"},
      {"{\"asset\":{\"version\":\"2.0\"},\"extras\":", "{\"a\":[", "]}", "}"},
      {"<svg xmlns=\"http://www.w3.org/2000/svg\">", "<g>", "</g>", "</svg>"},
      {"<svg>", "<g transform=\"scale(1)\">", "</g>", "</svg>"},
      {"<svg>", "<path d=\"M0 0L1 1\">", "</path>", "</svg>"},
      {"<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">", "<PolyData>", "</PolyData>", "</VTKFile>"},
      {"<GIFTI>", "<DataArray Intent=\"NIFTI_INTENT_POINTSET\">", "</DataArray>", "</GIFTI>"},
      {"<model>", "<components>", "</components>", "</model>"},
  };
  std::vector<std::string> texts;
  for (const Shape& shape : shapes) {
    std::string opened = shape.before, closed;
    for (std::size_t k = 0; k < depth; ++k) opened += shape.open, closed += shape.close;
    texts.push_back(opened);
    texts.push_back(opened + closed + shape.after);
  }
  return texts;
}

}  // namespace unsnarl::fuzz
