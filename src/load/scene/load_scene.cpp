#include <algorithm>
#include <fstream>
#include <pah/load/load_scene.hpp>
#include <system_error>

#include "base/extension.hpp"
#include "load/scene/animation.hpp"
#include "load/scene/keyframes.hpp"
#include "load/scene/language.hpp"
#include "load/scene/sections/reading.hpp"
#include "load/scene/synonyms.hpp"
#include "load/yaml/suggest.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file, std::uint64_t most_bytes) {
  const std::string shown = "cannot read '" + file.string() + "': ";
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw FileError(shown + "it does not exist");
  if (status.type() == fs::file_type::directory) throw FileError(shown + "it is a directory");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw FileError(shown + std::generic_category().message(errno));
  // Reads to the end instead of asking for the size, because pipes have none.
  std::string text;
  std::vector<char> buffer(1U << 16U);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
         stream.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most_bytes)
      throw SceneError({{{file.string()},
                         "larger than the limit of " + std::to_string(most_bytes) + " bytes",
                         ""}});
  }
  if (stream.bad()) throw FileError(shown + "it cannot be read to its end");
  return text;
}

// Only describes the section: load_scene() has evaluated the animation already.
void describe_animation(SceneReading& reading, const YamlNode* /*node*/) {
  if (reading.context.language == nullptr) return;
  (void)read_animation(reading.context, nullptr, {});
  (void)read_keyframes(reading.context, nullptr, 0);
}

// The order matters: a section may refer to earlier ones.
void read_sections(SceneReading& reading, MapReader& map) {
  using Section = std::pair<const char*, void (*)(SceneReading&, const YamlNode*)>;
  for (const auto& [key, read] : {Section{"camera", read_camera},
                                  {"film", read_film},
                                  {"render", read_render},
                                  {"textures", read_textures},
                                  {"materials", read_materials},
                                  {"meshes", read_meshes},
                                  {"lights", read_lights},
                                  {"influence_areas", read_influence_areas},
                                  {"acceleration", read_acceleration},
                                  {"animation", describe_animation}})
    map.nested(key, [&, section = read](const YamlNode* node) {
      if (node == nullptr || node->kind != YamlNode::Kind::null) section(reading, node);
    });
}

// Returns the tree with all overrides applied, and collects their errors.
YamlRef apply_overrides(YamlRef root, const LoadOptions& options, const YamlLimits& limits,
                        std::vector<YamlFault>& faults) {
  for (std::size_t i = 0; i < options.overrides.size(); ++i) {
    const std::string& text = options.overrides[i];
    const int index = static_cast<int>(i);
    const Mark mark{index, 1, 1};
    try {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0)
        throw YamlError(mark, "an override is key.path=value");
      const YamlRef value =
          parse_yaml(std::string_view(text).substr(equals + 1), limits, faults, index);
      root = replace_at(root, std::string_view(text).substr(0, equals), value, mark);
    } catch (const YamlError& error) {
      faults.push_back({error.mark(), error.what()});
    }
  }
  return root;
}

}  // namespace

bool NameTable::add(ReadContext& context, const std::string& name, std::uint32_t id,
                    const Mark& mark) {
  const auto [entry, is_new] = entries_.emplace(name, Entry{id, mark});
  if (is_new) {
    names_.push_back(name);
    return true;
  }
  const Mark& first = entry->second.mark;
  context.errors.add(mark, "duplicate " + kind_ + " name '" + name + "'" +
                               (first.override_index >= 0 || first.line == 0
                                    ? ""
                                    : "; the first is on line " + std::to_string(first.line)));
  return false;
}

void NameTable::add_unless_known(const std::string& name, std::uint32_t id) {
  if (entries_.emplace(name, Entry{id, {}}).second) names_.push_back(name);
}

std::optional<std::uint32_t> NameTable::find(ReadContext& context, const YamlNode& node,
                                             const ValueName& name) const {
  std::string text;
  if (!read_value(context, node, name, text)) return {};
  const auto found = entries_.find(text);
  if (found != entries_.end()) return found->second.id;
  const std::string near = suggestion(text, names_);
  context.errors.add(node.mark, "unknown " + kind_ + " '" + text + "' in " + name +
                                    (names_.empty() ? "; there are none" : near) +
                                    (kind_ == "mesh" && near.empty()
                                         ? ": a mesh must come before the meshes that name it"
                                         : ""));
  return {};
}

std::string title_of(const YamlNode& node, const std::string& kind, std::size_t index) {
  const YamlEntry* name = node.kind == YamlNode::Kind::map ? node.find("name") : nullptr;
  return name != nullptr && name->value->kind == YamlNode::Kind::scalar &&
                 !name->value->text.empty()
             ? kind + " '" + name->value->text + "'"
             : kind + " " + std::to_string(index + 1);
}

Language describe_language() {
  Language language;
  ErrorCollector errors("", "");
  ReadContext context{errors, &language};
  Scene scene;
  SceneFiles files("");
  const LoadLimits limits;
  SceneReading reading{context, scene, files, limits};
  read_map(context, nullptr, "scene", "scene",
           [&](MapReader& map) { read_sections(reading, map); });
  return language;
}

namespace {

// Returns the value of a section, or null.
const YamlNode* section(const YamlNode& root, std::string_view key) {
  const YamlEntry* entry = root.kind == YamlNode::Kind::map ? root.find(key) : nullptr;
  return entry == nullptr || entry->value->kind == YamlNode::Kind::null ? nullptr
                                                                        : entry->value.get();
}

// Refuses files of other programs, by their extensions.
void refuse_other_formats(const fs::path& file) {
  const std::string extension = lower_extension(file);
  const auto& meshes = mesh_extensions();
  std::string message;
  if (std::find(meshes.begin(), meshes.end(), extension) != meshes.end())
    message = "this is a mesh file; a scene that shows it says: meshes: [{file: " +
              file.filename().string() + "}]";
  else if (extension == ".pov" || extension == ".xml" || extension == ".pbrt")
    message = "scenes of other programs cannot be read; a scene is a YAML file";
  if (message.empty()) return;
  std::vector<LocatedError> errors;
  LocatedError& error = errors.emplace_back();
  error.where.file = file.string();
  error.message = message;
  throw SceneError(std::move(errors));
}

// Warns if the scene has no light or no mesh.
void warn_of_gaps(const Scene& scene, ErrorCollector& errors) {
  if (scene.lights.empty()) errors.warn({}, "the scene has no light: the picture will be black");
  if (scene.instances.empty()) errors.warn({}, "the scene has no mesh: the picture will be empty");
}

}  // namespace

LoadedScene load_scene(const fs::path& file, const LoadOptions& options) {
  refuse_other_formats(file);
  const std::string whole = read_text(file, options.limits.scene_bytes);
  std::string_view text = whole;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);

  ErrorCollector errors(file.string(), text, options.overrides);
  ReadContext context{errors, nullptr, synonym_hint};
  LoadedScene loaded;
  LoadedFiles::Impl* const kept = options.loaded == nullptr ? nullptr : &options.loaded->impl();
  SceneFiles files(file.parent_path(), options.on_file, kept);
  files.hash().add_part(whole);
  for (const std::string& text_of_override : options.overrides)
    files.hash().add_part(text_of_override);

  const YamlLimits limits{options.limits.yaml_nodes, options.limits.nesting};
  std::vector<YamlFault> faults;
  try {
    const YamlRef root = apply_overrides(parse_yaml(text, limits, faults), options, limits, faults);
    for (YamlFault& fault : faults) errors.add(fault.mark, std::move(fault.message));
    if (root->kind == YamlNode::Kind::null) {
      errors.add({}, "the file holds no scene");
    } else {
      const FrameTime now = read_animation(context, section(*root, "animation"), options.frame);
      const YamlRef shown = at_frame(context, root, now);
      // Stops here, because the faulty values would cause further errors.
      if (errors.size() > faults.size()) throw SceneError(errors.located());
      loaded.animated = shown != root;
      if (loaded.animated) files.hash().add_part(std::to_string(now.frame));
      SceneReading reading{context, loaded.scene, files, options.limits};
      read_map(context, shown.get(), "scene", "the scene", [&](MapReader& map) {
        read_sections(reading, map);
        for (const YamlEntry& entry : shown->entries)
          if (entry.key.starts_with("x-")) map.find(entry.key);
      });
      check_pictures(reading);
    }
  } catch (const YamlError& error) {
    for (YamlFault& fault : faults) errors.add(fault.mark, std::move(fault.message));
    errors.add(error.mark(), error.what());
  }
  if (errors.size() > 0) throw SceneError(errors.located());
  if (kept != nullptr) kept->drop_unused();
  warn_of_gaps(loaded.scene, errors);
  loaded.hash = files.hash().hex();
  loaded.warnings = errors.located_warnings();
  return loaded;
}

}  // namespace pah
