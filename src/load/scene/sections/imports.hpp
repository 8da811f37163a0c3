// Mesh files in a scene.
#pragma once

#include "load/scene/sections/reading.hpp"

namespace pah {

// Which parts of a mesh file are used beside its geometry, and how they are adjusted.
struct FileUse {
  bool materials = false;
  bool cameras = false;
  bool lights = false;
  std::string camera;      // the one to take; the first if empty
  double light_scale = 1;  // of all lights, emission included
  struct Replacement {
    std::string name;  // of a material of the file
    MaterialId by;
    Mark mark;
  };
  std::vector<Replacement> replacements;
};

// The file that `node` names, read once however often it is used; null, and an error, if it cannot
// be. With `use`, as several meshes with their own materials, else as one mesh of material 0.
[[nodiscard]] const ImportedFile* import_file(SceneReading& reading, const YamlNode& node,
                                              const ValueName& name, MeshNormals normals,
                                              const FileUse& use);

// The material that each part is of, as `use` replaces them; reports names that the file has not.
[[nodiscard]] std::vector<MaterialId> materials_of(SceneReading& reading, const ImportedFile& file,
                                                   const FileUse& use);

// Adds the file's camera and lights as `use` says, standing at each of `copies`; returns the light
// of each part, no_light where it does not emit. `mark` is where the use is asked for.
[[nodiscard]] std::vector<LightId> use_file(SceneReading& reading, const ImportedFile& file,
                                            const FileUse& use, const std::string& mesh_name,
                                            const std::vector<glm::dmat4x3>& copies,
                                            const Mark& mark);

}  // namespace pah
