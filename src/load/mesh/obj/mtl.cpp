#include "load/mesh/obj/mtl.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "load/mesh/common/file_reader.hpp"
#include "load/mesh/common/folder.hpp"
#include "load/mesh/common/text.hpp"
#include "load/mesh/common/texture_list.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

// The statements of a library about one material.
struct MtlMaterial {
  Vec3 diffuse{0.8F};
  Vec3 specular{0};
  Vec3 emission{0};
  float shininess = 0;
  float ior = 1.5F;
  float opacity = 1;
  int illumination = 0;
  TextureId diffuse_map = no_texture;
  TextureId opacity_map = no_texture;
  TextureId normal_map = no_texture;
};

Vec3 unit_color(const Vec3& c) { return glm::clamp(c, Vec3(0), Vec3(1)); }

// Illumination models 4, 6, 7 and 9 refract, 5 is a mirror, 2 and above have highlights.
MaterialModel model_of(const MtlMaterial& m) {
  const float ior = m.ior > 1 ? std::min(m.ior, 4.0F) : 1.5F;
  if (m.illumination == 4 || m.illumination == 6 || m.illumination == 7 || m.illumination == 9) {
    GlassMaterial glass;
    glass.ior = ior;
    return glass;
  }
  const Vec3 specular = unit_color(m.specular);
  // With an image, some exporters write a factor of 0 and mean 1.
  const bool no_factor = m.diffuse_map != no_texture && m.diffuse == Vec3(0);
  const ColorInput diffuse{no_factor ? Vec3(1) : unit_color(m.diffuse), m.diffuse_map};
  if (m.illumination == 5 && specular != Vec3(0)) return MirrorMaterial{{specular, no_texture}};
  if (specular == Vec3(0) || m.shininess <= 0 || m.illumination == 1)
    return DiffuseMaterial{diffuse};
  PlasticMaterial plastic;
  plastic.reflectance = diffuse;
  plastic.ior = ior;
  // A GGX lobe as wide as Phong's (Walter et al., EGSR 2007, section 5.4).
  plastic.roughness.value = std::sqrt(std::sqrt(2 / (std::min(m.shininess, 1e6F) + 2)));
  return plastic;
}

Material material_of(const std::string& name, const MtlMaterial& m) {
  Material material;
  material.name = name;
  material.model = model_of(m);
  material.normal_map = m.normal_map;
  if (!std::holds_alternative<GlassMaterial>(material.model))
    material.opacity = {std::clamp(m.opacity, 0.0F, 1.0F), m.opacity_map, 0};
  return material;
}

// Keys without an effect on our materials.
constexpr std::string_view ignored_keys[] = {"Ka", "Tf", "sharpness", "map_aat", "map_Ka"};

// The number of arguments of a map's option; nothing if the word is not an option.
std::optional<int> words_of_option(std::string_view option) {
  for (const char* name :
       {"-blendu", "-blendv", "-bm", "-boost", "-cc", "-clamp", "-imfchan", "-texres", "-type"})
    if (option == name) return 1;
  if (option == "-mm") return 2;
  if (option == "-o" || option == "-s" || option == "-t") return 3;
  return std::nullopt;
}

class MtlReader {
 public:
  MtlReader(const fs::path& library, const fs::path& limit, std::uint64_t max_bytes,
            TextureList& textures, std::map<std::string, MtlMaterial>& materials)
      : path_(library),
        limit_(limit),
        file_(library, max_bytes),
        textures_(textures),
        materials_(materials) {}

  // Returns the unused keys.
  std::vector<std::string> read() {
    while (const auto line = file_.line()) {
      text_ = file_.line_number() == 1 ? without_byte_order_mark(*line) : *line;
      Words words(text_);
      const std::string_view keyword = words.next();
      if (keyword.empty() || keyword.front() == '#') continue;
      if (keyword == "newmtl")
        // The first material of a name counts.
        material_ = &materials_.try_emplace(std::string(words.rest())).first->second;
      else if (material_ != nullptr)
        read_key(keyword, words);
    }
    return unused_;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw MeshFileError(path_.filename().string() + ", line " +
                        std::to_string(file_.line_number()) + ": " + message);
  }

  void read_key(std::string_view key, Words& words) {
    MtlMaterial& m = *material_;
    if (key == "Kd")
      color(key, words, m.diffuse);
    else if (key == "Ks")
      color(key, words, m.specular);
    else if (key == "Ke")
      color(key, words, m.emission);
    else if (key == "Ns")
      m.shininess = number(words.next());
    else if (key == "Ni")
      m.ior = number(words.next());
    else if (key == "d")
      read_opacity(words);
    else if (key == "Tr")
      m.opacity = 1 - number(words.next());
    else if (key == "illum")
      m.illumination = static_cast<int>(std::clamp(number(words.next()), 0.0F, 10.0F));
    else if (key == "map_Kd")
      m.diffuse_map = map(words, ColorSpace::automatic);
    else if (key == "map_d")
      m.opacity_map = map(words, ColorSpace::linear);
    else if (key == "norm" || key == "map_Kn")
      m.normal_map = map(words, ColorSpace::linear);
    else if (std::find(std::begin(ignored_keys), std::end(ignored_keys), key) ==
             std::end(ignored_keys))
      leave_out(key);
  }

  void leave_out(std::string_view key) {
    constexpr std::size_t enough = 8;
    std::string name = excerpt_of(key.substr(0, 40));
    if (unused_.size() < enough && std::find(unused_.begin(), unused_.end(), name) == unused_.end())
      unused_.push_back(std::move(name));
  }

  float number(std::string_view word) const {
    float value = 0;
    if (!read_float(word, value))
      fail("'" + excerpt_of(word.substr(0, 40)) + "' is not a finite number");
    return value;
  }

  // Reads three numbers, or one for all three. Ignores spectra.
  void color(std::string_view key, Words& words, Vec3& value) {
    const std::string_view first = words.next();
    if (first == "spectral" || first == "xyz")
      return leave_out(std::string(key) + " " + std::string(first));
    value = Vec3(number(first));
    const std::string_view second = words.next();
    if (second.empty() || second.front() == '#') return;
    value.y = number(second);
    value.z = number(words.next());
  }

  // Ignores -halo, which dims by viewing angle.
  void read_opacity(Words& words) {
    std::string_view word = words.next();
    if (word == "-halo") word = words.next();
    material_->opacity = number(word);
  }

  TextureId map(Words& words, ColorSpace space) {
    ImageTexture image;
    image.color_space = space;
    Words after = words;
    for (std::string_view option = after.next();; option = after.next()) {
      const std::optional<int> count = words_of_option(option);
      if (!count) break;
      read_option(option, *count, after, image);
      words = after;
    }
    try {
      image.file = image_of(path_, std::string(words.rest()), limit_);
    } catch (const MeshFileError& error) {
      fail(error.what());
    }
    return textures_.add(image);
  }

  // The last two numbers of -o, -s and -t are optional.
  void read_option(std::string_view option, int count, Words& words, ImageTexture& image) const {
    if (option == "-clamp") {
      image.clamp = words.next() == "on";
      return;
    }
    const bool scales = option == "-s";
    const bool moves = option == "-o";
    for (int i = 0; i < count; ++i) {
      Words after = words;
      const std::string_view word = after.next();
      float value = 0;
      if (count == 3 && !read_float(word, value)) {
        if (i == 0) fail("'" + std::string(option) + "' needs a number");
        return;
      }
      words = after;
      if (scales && i < 2) image.scale[i] = value;
      if (moves && i < 2) image.offset[i] = value;
    }
  }

  fs::path path_;
  fs::path limit_;
  FileReader file_;
  TextureList& textures_;
  std::map<std::string, MtlMaterial>& materials_;
  MtlMaterial* material_ = nullptr;
  std::vector<std::string> unused_;
  std::string_view text_;
};

// Returns the files that a line names: either one, whose name may contain blanks, or several.
std::vector<fs::path> files_of(const std::string& names, const fs::path& folder) {
  std::string text = names;
  std::replace(text.begin(), text.end(), '\\', '/');
  std::error_code error;
  if (fs::is_regular_file(folder / text, error)) return {folder / text};
  std::vector<fs::path> files;
  Words words(text);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    files.push_back(folder / word);
  return files;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "'" : ", '") + word + "'";
  return text;
}

}  // namespace

void read_mtl_materials(const ObjFile& obj, const fs::path& file, const MeshFileOptions& options,
                        MeshFile& out) {
  const fs::path limit = folder_of(file, options.folder);
  TextureList textures(out.textures);
  std::map<std::string, MtlMaterial> materials;
  bool missing = false;
  for (const std::string& names : obj.libraries)
    for (const fs::path& library : files_of(names, file.parent_path())) {
      const std::string name = library.filename().string();
      if (!lies_in(library, limit))
        throw MeshFileError("it names '" + name + "' outside of its folder");
      if (options.on_file) options.on_file(library);
      std::error_code error;
      if (!fs::is_regular_file(library, error)) {
        missing = true;
        out.warnings.push_back("there is no material library '" + name +
                               "': its materials are gray");
        continue;
      }
      const auto unused = MtlReader(library, limit, options.file_bytes, textures, materials).read();
      if (!unused.empty())
        out.warnings.push_back(name + ": " + joined(unused) + " is not supported and is left out");
    }
  std::vector<std::string> unknown;
  for (const std::string& name : obj.materials) {
    const auto found = materials.find(name);
    const bool known = found != materials.end();
    if (!known && !name.empty() && !missing) unknown.push_back(name);
    const MtlMaterial material = known ? found->second : MtlMaterial{};
    out.materials.push_back(material_of(name, material));
    out.emission.push_back({.radiance = glm::max(material.emission, Vec3(0))});
  }
  if (!unknown.empty()) {
    const std::size_t more = unknown.size() > 4 ? unknown.size() - 4 : 0;
    unknown.resize(unknown.size() - more);
    out.warnings.push_back("no material library has " + joined(unknown) +
                           (more > 0 ? " and " + std::to_string(more) + " more" : "") +
                           ", used by faces: gray instead");
  }
}

}  // namespace pah
