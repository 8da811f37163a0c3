// Reads Wavefront MTL files, the materials of OBJ files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/mesh/obj/obj.hpp"

namespace pah {

// Adds the materials that `obj` uses to `out`, in its order. Materials that no library has are
// gray, with a warning. Libraries and images must lie in or below `options.folder`, by default the
// file's own folder. Throws MeshFileError, which names the library and the line.
void read_mtl_materials(const ObjFile& obj, const std::filesystem::path& file,
                        const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
