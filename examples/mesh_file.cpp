// Repairs a file and keeps all else that it holds: example_mesh_file IN OUT
#include <unsnarl/repair_file.h>

#include <cstdio>
#include <exception>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: example_mesh_file IN OUT\n");
    return 2;
  }
  try {
    unsnarl::RepairFileOptions options;
    options.repair.max_displacement_rel = 0.5;  // of the diagonal of the bounding box

    // What is written beside OUT is read back and certified before it becomes OUT.
    const unsnarl::RepairedFiles done = unsnarl::repair_file(argv[1], argv[2], options);
    for (const std::string& note : done.report.notes) std::printf("note: %s\n", note.c_str());
    std::printf("%s\n", std::string(to_string(done.result.status)).c_str());
    for (const std::filesystem::path& place : done.partial) std::printf("best so far: %s\n", place.c_str());
    return done.result.status == unsnarl::Status::embedded ? 0 : 1;
  } catch (const std::exception& error) {  // FileError, WriteError: the message says what, where and what to do
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
