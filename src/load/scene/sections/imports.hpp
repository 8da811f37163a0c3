// Imports mesh files into a scene.
#pragma once

#include "load/scene/sections/reading.hpp"

namespace pah {

// The parts of a mesh file that are used beside its geometry, and their adjustments.
struct FileUse {
  bool materials = false;
  bool cameras = false;
  bool lights = false;
  std::string camera;      // name of the camera to take; the first if empty
  double light_scale = 1;  // factor for all lights and emission
  struct Replacement {
    std::string name;  // of a material of the file
    MaterialId by;
    Mark mark;
  };
  std::vector<Replacement> replacements;
};

// Returns the file that `node` names, which is read only once; reports an error and returns null if
// that fails. With `use.materials` it has several meshes with their own materials, else one mesh of
// material 0.
[[nodiscard]] const ImportedFile* import_file(SceneReading& reading, const YamlNode& node,
                                              const ValueName& name, MeshNormals normals,
                                              const FileUse& use);

// Returns the material of each part after the replacements of `use`; reports names that the file
// does not have.
[[nodiscard]] std::vector<MaterialId> materials_of(SceneReading& reading, const ImportedFile& file,
                                                   const FileUse& use);

// Adds the file's camera and lights at each of `copies`, as `use` selects. Returns the light of
// each part, or no_light if it does not emit. `mark` is the place of the use in the scene.
[[nodiscard]] std::vector<LightId> use_file(SceneReading& reading, const ImportedFile& file,
                                            const FileUse& use, const std::string& mesh_name,
                                            const std::vector<glm::dmat4x3>& copies,
                                            const Mark& mark);

}  // namespace pah
