#include "io/mesh/gltf_materials.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/mesh/folder.hpp"
#include "io/mesh/gltf.hpp"
#include "io/mesh/texture_list.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3 unit_color(const Vec3& c) { return glm::clamp(c, Vec3(0), Vec3(1)); }

// One material of assimp's, read in our terms.
class MaterialReader {
 public:
  MaterialReader(const aiMaterial& source, const aiScene& scene, const fs::path& file,
                 const fs::path& limit, TextureList& textures, MeshFile& out)
      : source_(source),
        scene_(scene),
        file_(file),
        limit_(limit),
        textures_(textures),
        out_(out) {}

  void read() {
    Material material;
    material.name = source_.GetName().C_Str();
    Vec3 emission = color(AI_MATKEY_COLOR_EMISSIVE, Vec3(0));
    read_model(material);
    material.normal_map = texture(aiTextureType_NORMALS, 0, ColorSpace::linear);
    emission *= std::max(number("$mat.emissiveIntensity").value_or(1), 0.0F);
    // An image says where a surface emits, which one radiance for all of it cannot.
    if (source_.GetTextureCount(aiTextureType_EMISSIVE) > 0) emission = Vec3(0);
    out_.emission.push_back(glm::max(emission, Vec3(0)));
    out_.materials.push_back(std::move(material));
  }

 private:
  [[nodiscard]] std::optional<float> number(const char* key) const {
    float value = 0;
    if (source_.Get(key, 0, 0, value) != aiReturn_SUCCESS) return std::nullopt;
    if (!std::isfinite(value)) fail(std::string(key) + " is not finite");
    return value;
  }

  [[nodiscard]] float number(const char* key, float otherwise, float low, float high) const {
    return std::clamp(number(key).value_or(otherwise), low, high);
  }

  Vec3 color(const char* key, unsigned type, unsigned index, const Vec3& otherwise) const {
    aiColor3D value;
    if (source_.Get(key, type, index, value) != aiReturn_SUCCESS) return otherwise;
    const Vec3 result{value.r, value.g, value.b};
    if (!finite(result)) fail(std::string(key) + " is not finite");
    return result;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw MeshFileError("material '" + std::string(source_.GetName().C_Str()) + "': " + what);
  }

  void read_model(Material& material) {
    PrincipledMaterial model;
    model.base_color = {unit_color(color(AI_MATKEY_BASE_COLOR, Vec3(1))),
                        texture(aiTextureType_BASE_COLOR, 0, ColorSpace::srgb)};
    const TextureId rough_metal = texture(aiTextureType_UNKNOWN, 0, ColorSpace::linear);
    model.metallic = {number("$mat.metallicFactor", 1, 0, 1), rough_metal, 2};
    model.roughness = {number("$mat.roughnessFactor", 1, 0, 1), rough_metal, 1};
    model.ior = number("$mat.refracti", 1.5F, 1, 4);
    aiString mode;
    if (source_.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS &&
        std::string(mode.C_Str()) != "OPAQUE") {
      aiColor4D base;
      (void)source_.Get(AI_MATKEY_BASE_COLOR, base);
      material.opacity = {std::clamp(base.a, 0.0F, 1.0F), model.base_color.texture, 3};
    }
    if (number("$mat.transmission.factor", 0, 0, 1) < 0.5F) {
      material.model = model;
      return;
    }
    GlassMaterial glass;
    glass.ior = model.ior;
    glass.roughness = model.roughness;
    glass.transmittance = model.base_color;
    material.model = glass;
  }

  TextureId texture(aiTextureType type, unsigned index, ColorSpace space) {
    aiString name;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                 aiTextureMapMode_Wrap};
    if (source_.GetTexture(type, index, &name, nullptr, nullptr, nullptr, nullptr, modes) !=
        aiReturn_SUCCESS)
      return no_texture;
    ImageTexture image;
    image.file = path_of(name.C_Str());
    image.color_space = space;
    image.clamp = modes[0] == aiTextureMapMode_Clamp;
    aiUVTransform transform;
    if (source_.Get(AI_MATKEY_UVTRANSFORM(type, index), transform) == aiReturn_SUCCESS) {
      image.scale = {transform.mScaling.x, transform.mScaling.y};
      image.offset = {transform.mTranslation.x, transform.mTranslation.y};
      if (!finite(Vec3(image.scale, 0)) || !finite(Vec3(image.offset, 0)))
        fail("a texture's transform is not finite");
    }
    return textures_.add(image);
  }

  fs::path path_of(const std::string& name) {
    if (scene_.GetEmbeddedTexture(name.c_str()) != nullptr)
      fail("images inside of a mesh file cannot be read; save it with separate images");
    // Names are URIs, which the importer may have decoded or not.
    std::error_code error;
    const std::string decoded = decode_uri(name);
    const bool is_decoded = fs::is_regular_file(file_.parent_path() / name, error);
    try {
      return image_of(file_, is_decoded ? name : decoded, limit_);
    } catch (const MeshFileError& problem) {
      fail(problem.what());
    }
  }

  const aiMaterial& source_;
  const aiScene& scene_;
  fs::path file_;
  fs::path limit_;
  TextureList& textures_;
  MeshFile& out_;
};

}  // namespace

glm::dmat4x3 matrix_of(const aiMatrix4x4& m) {
  return {DVec3{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

void read_gltf_materials(const aiScene& scene, const fs::path& file, const fs::path& folder,
                         MeshFile& out) {
  TextureList textures(out.textures);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    MaterialReader(*scene.mMaterials[i], scene, file, folder, textures, out).read();
}

}  // namespace pah
