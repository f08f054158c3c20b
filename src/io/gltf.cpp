#include "io/mesh_file.h"
namespace unsnarl {
std::unique_ptr<MeshFile> parse_glb(std::string, const std::filesystem::path&) { throw FileError("GLB is not read yet; convert to OBJ"); }
std::unique_ptr<MeshFile> parse_gltf(std::string, const std::filesystem::path&) { throw FileError("glTF is not read yet; convert to OBJ"); }
}
