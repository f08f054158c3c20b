// What CONTRIBUTING.md promises of its format: names and options know it, and moved coordinates alone change.
#include <cstdio>

#include "unsnarl/document.h"

int main() {
  using namespace unsnarl;
  if (format_from_extension("a/mesh.tri") != Format::tri) return std::puts("not known by its extension"), 1;
  if (format_names().find("tri") == std::string::npos) return std::puts("not in the names"), 1;
  const std::string bytes = "0 0 0 # a corner\n1 0 0\n0  1 0\n";
  const Document document = Document::parse(bytes, Format::tri);
  std::vector<double> positions = document.surface().positions;
  if (document.patched(positions, false)[0].bytes != bytes) return std::puts("not the same bytes"), 1;
  positions[3] = 2.5;
  if (document.patched(positions, false)[0].bytes != "0 0 0 # a corner\n2.5 0 0\n0  1 0\n")
    return std::puts("not the new coordinate alone"), 1;
  try {
    Document::parse("0 0 0\n1 0 0\n", Format::tri);
  } catch (const FileError&) {
    return 0;
  }
  return std::puts("half a triangle was read"), 1;
}
