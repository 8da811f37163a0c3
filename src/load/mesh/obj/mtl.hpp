// Wavefront MTL: the materials of OBJ files, in our terms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "load/mesh/obj/obj.hpp"

namespace pah {

// The materials that `obj` uses into `out`, in its order: from its libraries, gray where none has
// them, with a warning. Libraries and images have to lie in or under `options.folder`, or that of
// the file if it is empty. Throws MeshFileError, which names the library and the line.
void read_mtl_materials(const ObjFile& obj, const std::filesystem::path& file,
                        const MeshFileOptions& options, MeshFile& out);

}  // namespace pah
