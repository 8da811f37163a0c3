// Wavefront MTL: the materials of OBJ files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/mesh/obj/obj.hpp"

namespace pah {

// Reads the materials that `obj` uses from its libraries into `out`, in its order. A material in no
// library is gray and causes a warning. Libraries and images must lie in or under `options.folder`,
// or the file's folder if that is empty. Throws MeshFileError, which names the library and the
// line.
void read_mtl_materials(const ObjFile& obj, const std::filesystem::path& file,
                        const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
