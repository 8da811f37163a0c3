#include "load/mesh/gltf/materials.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "load/mesh/common/texture_list.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, const GltfBuffers& buffers, MeshFile& out,
                 std::vector<std::string>& left_out)
      : document_(document),
        buffers_(buffers),
        textures_(out.textures),
        images_(list(document.json, "images").size()),
        out_(out),
        left_out_(left_out) {}

  void read(const Json& source) {
    Material material;
    material.name = source.value("name", std::string());
    try {
      read_model(source, material);
    } catch (const MeshFileError& error) {
      throw MeshFileError("material '" + material.name + "': " + error.what());
    }
    out_.materials.push_back(std::move(material));
  }

 private:
  static float factor(const Json& object, const char* key, float fallback, float low, float high) {
    const double value = object.value(key, double{fallback});
    if (!std::isfinite(value)) throw MeshFileError(std::string(key) + " is not finite");
    return static_cast<float>(std::clamp(value, double{low}, double{high}));
  }

  void read_model(const Json& source, Material& material) {
    const Json& metallic_roughness = child(source, "pbrMetallicRoughness");
    const Json& extensions = child(source, "extensions");
    tell_of_extensions(extensions);
    Vec4 base(1);
    if (const auto found = metallic_roughness.find("baseColorFactor");
        found != metallic_roughness.end())
      for (int k = 0; k < 4; ++k)
        base[k] = std::clamp(found->at(static_cast<std::size_t>(k)).get<float>(), 0.0F, 1.0F);

    PrincipledMaterial model;
    model.base_color = {Vec3(base),
                        texture(metallic_roughness, "baseColorTexture", ColorSpace::srgb)};
    const TextureId rough_metal =
        texture(metallic_roughness, "metallicRoughnessTexture", ColorSpace::linear);
    model.metallic = {factor(metallic_roughness, "metallicFactor", 1, 0, 1), rough_metal, 2};
    model.roughness = {factor(metallic_roughness, "roughnessFactor", 1, 0, 1), rough_metal, 1};
    model.ior = factor(child(extensions, "KHR_materials_ior"), "ior", 1.5F, 1, 4);
    material.vertex_colors = true;
    material.normal_map = texture(source, "normalTexture", ColorSpace::linear);
    material.normal_scale = factor(child(source, "normalTexture"), "scale", 1,
                                   -largest_normal_scale, largest_normal_scale);
    read_opacity(source, base.w, model.base_color.texture, material);
    out_.emission.push_back(emission_of(source, extensions));

    const Json& transmission = child(extensions, "KHR_materials_transmission");
    if (factor(transmission, "transmissionFactor", 0, 0, 1) < 0.5F) {
      material.model = model;
      return;
    }
    GlassMaterial glass;
    glass.ior = model.ior;
    glass.roughness = model.roughness;
    glass.transmittance = model.base_color;
    material.model = glass;
  }

  static void read_opacity(const Json& source, float alpha, TextureId base, Material& material) {
    const std::string mode = source.value("alphaMode", std::string("OPAQUE"));
    if (mode != "BLEND" && mode != "MASK") return;
    material.opacity = {alpha, base, 3};
    if (mode == "MASK") material.opacity_cutoff = factor(source, "alphaCutoff", 0.5F, 0, 1);
  }

  AreaLight emission_of(const Json& source, const Json& extensions) {
    const Json& strength = child(extensions, "KHR_materials_emissive_strength");
    const DVec3 color = vec(source, "emissiveFactor", DVec3(0)) *
                        double{factor(strength, "emissiveStrength", 1, 0, 1e18F)};
    AreaLight light;
    light.radiance = Vec3(glm::clamp(color, 0.0, 1e18));
    if (light.radiance != Vec3(0))
      light.image = texture(source, "emissiveTexture", ColorSpace::srgb);
    light.two_sided = source.value("doubleSided", false);
    return light;
  }

  void tell_of_extensions(const Json& extensions) {
    for (const auto& [name, value] : extensions.items())
      if (name != "KHR_materials_emissive_strength" && name != "KHR_materials_ior" &&
          name != "KHR_materials_transmission")
        left_out_.push_back(name);
  }

  TextureId texture(const Json& object, const char* key, ColorSpace space) {
    const Json& use = child(object, key);
    if (use.empty()) return no_texture;
    const Json& textures = list(document_.json, "textures");
    const Json& source = textures[index_of(use, "index", textures.size())];
    if (!source.contains("source")) {
      left_out_.emplace_back("textures in formats of extensions");
      return no_texture;
    }
    ImageTexture image;
    image.color_space = space;
    set_image(index_of(source, "source", images_.size()), image);
    if (source.contains("sampler")) {
      const Json& samplers = list(document_.json, "samplers");
      const Json& sampler = samplers[index_of(source, "sampler", samplers.size())];
      constexpr std::uint64_t clamp_to_edge = 33071, mirrored_repeat = 33648;
      const std::uint64_t wrap = number(sampler, "wrapS", 0);
      image.clamp = wrap == clamp_to_edge;
      if (wrap == mirrored_repeat) left_out_.emplace_back("mirroring of repeated textures");
    }
    const Json& transform = child(child(use, "extensions"), "KHR_texture_transform");
    if (number(use, "texCoord", 0) != 0 || number(transform, "texCoord", 0) != 0)
      left_out_.emplace_back("texture coordinates other than the first");
    if (transform.value("rotation", 0.0) != 0) left_out_.emplace_back("rotation of textures");
    const DVec2 scale = pair(transform, "scale", DVec2(1));
    const DVec2 offset = pair(transform, "offset", DVec2(0));
    image.scale = scale;
    // glTF's v points down: 1 - (offset + scale (1 - v)).
    image.offset = {offset.x, 1 - offset.y - scale.y};
    return textures_.add(image);
  }

  static DVec2 pair(const Json& object, const char* key, const DVec2& fallback) {
    const auto found = object.find(key);
    if (found == object.end()) return fallback;
    const DVec2 value{found->at(0).get<double>(), found->at(1).get<double>()};
    if (!std::isfinite(value.x) || !std::isfinite(value.y))
      throw MeshFileError("a texture's transform is not finite");
    return value;
  }

  // Sets the texture's file, or its bytes inside this file, which all uses share.
  void set_image(std::size_t index, ImageTexture& texture) {
    Image& known = images_[index];
    if (known.file.empty()) {
      const Json& source = list(document_.json, "images")[index];
      const std::string label =
          document_.file.filename().string() + ", image " + std::to_string(index);
      if (source.contains("bufferView")) {
        const std::size_t views = list(document_.json, "bufferViews").size();
        known = {document_.file.parent_path() / label,
                 std::make_shared<const std::string>(
                     buffers_.view(index_of(source, "bufferView", views)))};
      } else {
        const auto& uri = source.at("uri").get_ref<const std::string&>();
        if (is_data(uri))
          known = {document_.file.parent_path() / label,
                   std::make_shared<const std::string>(document_.data_of(uri))};
        else
          known = {document_.image_of(uri), nullptr};
      }
    }
    texture.file = known.file;
    texture.bytes = known.bytes;
  }

  static constexpr float largest_normal_scale = 1e6F;  // whose square is finite

  struct Image {
    fs::path file;
    std::shared_ptr<const std::string> bytes;
  };

  const GltfDocument& document_;
  const GltfBuffers& buffers_;
  TextureList textures_;
  std::vector<Image> images_;
  MeshFile& out_;
  std::vector<std::string>& left_out_;
};

}  // namespace

void read_gltf_materials(const GltfDocument& document, const GltfBuffers& buffers, MeshFile& out,
                         std::vector<std::string>& left_out) {
  MaterialReader reader(document, buffers, out, left_out);
  for (const Json& material : list(document.json, "materials")) reader.read(material);
  reader.read(Json::object());
}

}  // namespace pah
