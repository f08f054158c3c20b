#include "command_options.h"

namespace unsnarl::app {

void add_mesh_options(CLI::App& command, MeshOptions& options) {
  command.add_option("IN", options.input, "Mesh file: obj, off, ply, stl, glb or gltf; '-' for standard input")
      ->required();
  command.add_option("--format", options.format, "Format of the mesh, where its name does not tell")
      ->type_name("FORMAT");
  command
      .add_option("--goal", options.goal,
                  "What counts as a self-intersection: 'all' pairs of faces that meet anywhere but where they are\n"
                  "joined, or only the 'disjoint' ones, which share no vertex")
      ->check(CLI::IsMember({"all", "disjoint"}))
      ->type_name("all|disjoint")
      ->capture_default_str();
  command
      .add_option("--weld", options.weld,
                  "Which vertices at equal positions count as one: those on 'seams' within a shell (texture seams,\n"
                  "corners in STL), 'all', or 'none'. The file keeps them apart in any case")
      ->check(CLI::IsMember({"none", "seams", "all"}))
      ->type_name("none|seams|all")
      ->capture_default_str();
  command
      .add_option("--weld-tolerance", options.weld_tolerance,
                  "How far apart positions may be to count as equal, in the units of the mesh")
      ->check(CLI::NonNegativeNumber)
      ->type_name("LENGTH");
  command.add_option("--threads", options.threads, "Threads to use; 0: as many as the machine has")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  command.add_flag("--quiet,-q", options.quiet, "Say nothing but errors");
}

FindOptions MeshOptions::find() const {
  FindOptions result;
  result.weld = weld == "none" ? Weld::none : weld == "all" ? Weld::all : Weld::seams;
  result.weld_tolerance = weld_tolerance;
  result.threads = threads;
  return result;
}

}  // namespace unsnarl::app
