// Repairs a file and keeps all else that it holds: example_mesh_file IN OUT
#include <unsnarl/document.h>
#include <unsnarl/repair.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: example_mesh_file IN OUT\n");
    return 2;
  }
  try {
    const unsnarl::Document document = unsnarl::Document::read(argv[1]);
    for (const std::string& note : document.notes()) std::printf("note: %s\n", note.c_str());

    // What the file will hold is what has to be embedded: the repair asks the document how positions will be read back.
    unsnarl::RepairOptions options;
    options.as_written = [&](std::span<const double> positions, bool float32) {
      return document.as_written(positions, float32);
    };
    if (document.stores_float32()) options.precision = unsnarl::Precision::float32;

    const unsnarl::RepairResult result = unsnarl::repair(document.surface(), options);
    std::printf("%s\n", std::string(to_string(result.status)).c_str());
    if (result.status != unsnarl::Status::embedded) return 1;

    const std::filesystem::path target = argv[2];
    const bool float32_digits = result.report.precision == unsnarl::Precision::float32;
    for (const unsnarl::OutputFile& file : document.patched(result.positions, float32_digits, target.filename()))
      unsnarl::write_atomically(file.name.empty() ? target : target.parent_path() / file.name, file.bytes);
  } catch (const std::exception& error) {  // FileError, WriteError: the message says what, where and what to do
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
