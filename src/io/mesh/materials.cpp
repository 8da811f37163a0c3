#include "io/mesh/materials.hpp"

#include <assimp/GltfMaterial.h>
#include <assimp/ObjMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "io/mesh/access.hpp"
#include "io/mesh/gltf.hpp"

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
  MaterialReader(const aiMaterial& source, const aiScene& scene, fs::path folder_of_file,
                 const fs::path& limit, std::map<std::string, TextureId>& textures, MeshFile& out)
      : source_(source),
        scene_(scene),
        folder_(std::move(folder_of_file)),
        limit_(limit),
        textures_(textures),
        out_(out) {}

  void read() {
    Material material;
    material.name = source_.GetName().C_Str();
    Vec3 emission = color(AI_MATKEY_COLOR_EMISSIVE, Vec3(0));
    if (number("$mat.metallicFactor"))
      read_gltf(material);
    else
      read_mtl(material);
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

  void read_gltf(Material& material) {
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

  // Wavefront's models of illumination: 4, 6, 7 and 9 refract, 5 reflects, 2 and above shine.
  void read_mtl(Material& material) {
    const TextureId diffuse_map = texture(aiTextureType_DIFFUSE, 0, ColorSpace::automatic);
    // Where there is an image, exporters write a factor of 1, or of 0 and mean 1.
    Vec3 diffuse = unit_color(color(AI_MATKEY_COLOR_DIFFUSE, Vec3(0.8F)));
    if (diffuse_map != no_texture && diffuse == Vec3(0)) diffuse = Vec3(1);
    const Vec3 specular = unit_color(color(AI_MATKEY_COLOR_SPECULAR, Vec3(0)));
    const float shininess = number("$mat.shininess", 0, 0, 1e6F);
    const float ior = number("$mat.refracti", 1.5F, 0, 4);
    int model = 0;
    (void)source_.Get(AI_MATKEY_OBJ_ILLUM, model);
    // GGX that is as wide as Phong's lobe (Walter et al., EGSR 2007, section 5.4).
    const float roughness = std::sqrt(std::sqrt(2 / (shininess + 2)));
    if (model == 4 || model == 6 || model == 7 || model == 9) {
      GlassMaterial glass;
      glass.ior = ior > 1 ? ior : 1.5F;
      material.model = glass;
      return;
    }
    const float opacity = number("$mat.opacity", 1, 0, 1);
    material.opacity = {opacity, texture(aiTextureType_OPACITY, 0, ColorSpace::linear), 0};
    if (model == 5 && specular != Vec3(0)) {
      material.model = MirrorMaterial{{specular, no_texture}};
    } else if (specular != Vec3(0) && shininess > 0 && model != 1) {
      PlasticMaterial plastic;
      plastic.reflectance = {diffuse, diffuse_map};
      plastic.ior = ior > 1 ? ior : 1.5F;
      plastic.roughness = {roughness, no_texture, 0};
      material.model = plastic;
    } else {
      material.model = DiffuseMaterial{{diffuse, diffuse_map}};
    }
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
    const std::string key = image.file.string() + "|" + std::to_string(static_cast<int>(space)) +
                            "|" + std::to_string(image.clamp) + "|" +
                            std::to_string(image.scale.x) + "|" + std::to_string(image.scale.y) +
                            "|" + std::to_string(image.offset.x) + "|" +
                            std::to_string(image.offset.y);
    const auto [found, is_new] =
        textures_.emplace(key, static_cast<TextureId>(out_.textures.size()));
    if (is_new) out_.textures.emplace_back(image);
    return found->second;
  }

  fs::path path_of(std::string name) {
    if (scene_.GetEmbeddedTexture(name.c_str()) != nullptr)
      fail("images inside of a mesh file cannot be read; save it with separate images");
    std::replace(name.begin(), name.end(), '\\', '/');
    // glTF's names are URIs, which the importer may have decoded or not.
    for (const fs::path& path : {fs::path(name), fs::path(decode_uri(name))}) {
      const fs::path file = folder_ / path;
      if (path.is_absolute() || !lies_in(file, limit_))
        fail("image '" + name + "' lies outside of the scene's folder");
      std::error_code error;
      if (fs::is_regular_file(file, error)) return file;
    }
    fail("there is no image '" + name + "'");
  }

  const aiMaterial& source_;
  const aiScene& scene_;
  fs::path folder_;
  fs::path limit_;
  std::map<std::string, TextureId>& textures_;
  MeshFile& out_;
};

}  // namespace

glm::dmat4x3 matrix_of(const aiMatrix4x4& m) {
  return {DVec3{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
}

void read_materials(const aiScene& scene, const fs::path& file, const fs::path& folder,
                    MeshFile& out) {
  std::map<std::string, TextureId> textures;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    MaterialReader(*scene.mMaterials[i], scene, file.parent_path(), folder, textures, out).read();
}

}  // namespace pah
