#include "include_rules.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>

namespace pah::test {
namespace {

namespace fs = std::filesystem;

// A module includes only modules of lower ranks.
const std::map<std::string, int, std::less<>> ranks{
    {"base", 0},   {"geometry", 1},    {"influence", 2}, {"image", 2},
    {"bvh", 2},    {"light_space", 3}, {"accel", 4},     {"scene", 5},
    {"render", 6}, {"load", 6},        {"report", 7},    {"cli", 8}};

// A floor is the folder of a module or a folder within it.
struct Floor {
  std::string_view name;
  std::vector<std::string_view> below;   // the floors of the module that it may include
  std::vector<std::string_view> unseen;  // prefixes of includes from other modules that it may not
};
// Every folder within a module needs an entry. A module's own folder needs one only if it includes
// other floors.
const std::vector<Floor> floors{
    {"image/picture", {}, {}},
    {"image", {"image/picture"}, {}},
    {"image/texture", {"image", "image/picture"}, {}},
    {"accel", {"accel/local"}, {}},
    {"accel/local", {}, {}},
    {"render/sampling", {}, {}},
    {"render/surface", {}, {}},
    {"render/bsdf", {"render/sampling", "render/surface"}, {}},
    {"render/light", {"render/sampling", "render/surface"}, {}},
    {"render/film", {}, {}},
    {"render/path",
     {"render/sampling", "render/surface", "render/bsdf", "render/light", "render/film"},
     {}},
    {"render/plan",
     {"render/sampling", "render/surface", "render/bsdf", "render/light", "render/path"},
     {}},
    {"load/yaml", {}, {"pah/scene/", "scene/"}},
    {"load/mesh", {"load/mesh/common", "load/mesh/gltf", "load/mesh/obj", "load/mesh/ply"}, {}},
    {"load/mesh/common", {}, {"scene/"}},  // of `scene` the public values only
    {"load/mesh/gltf", {"load/mesh/common"}, {"scene/"}},
    {"load/mesh/obj", {"load/mesh/common"}, {"scene/"}},
    {"load/mesh/ply", {"load/mesh/common"}, {"scene/"}},
    {"load/scene",
     {"load/scene/sections", "load/scene/files", "load/mesh", "load/mesh/common", "load/yaml"},
     {}},
    {"load/scene/sections", {"load/scene/files", "load/mesh", "load/mesh/common", "load/yaml"}, {}},
    {"load/scene/files", {"load/mesh", "load/mesh/common", "load/yaml"}, {}},
    {"report/inspect", {"report"}, {}},
    {"report/inspect/pictures", {"report", "report/inspect"}, {}},
    {"report/study", {"report"}, {}},
    {"report/study/rates", {"report", "report/study"}, {}},
    {"report/study/text", {"report", "report/study", "report/study/rates"}, {}},
    {"cli",
     {"cli/terminal", "cli/merge", "cli/render", "cli/watch", "cli/tev", "cli/pictures"},
     {}},
    {"cli/terminal", {}, {}},
    {"cli/tev", {"cli/terminal"}, {}},
    {"cli/merge", {"cli/terminal"}, {}},
    {"cli/render", {"cli/terminal", "cli/tev", "cli/merge"}, {}},
    {"cli/watch", {"cli/terminal", "cli/render"}, {}},
    {"cli/pictures", {}, {}},
};
// Every floor of a module may include its public headers, except those that belong to one floor.
const std::map<std::string, std::string, std::less<>> floors_of_headers{
    {"render/film_file.hpp", "render/film"},    {"render/render.hpp", "render/path"},
    {"render/session.hpp", "render/path"},      {"render/acceleration.hpp", "render/plan"},
    {"load/mesh_file.hpp", "load/mesh/common"}, {"load/load_scene.hpp", "load/scene/sections"}};

// Include prefixes of third parties, and the path prefixes of the files that may use them.
struct ThirdParty {
  std::string_view includes;
  std::vector<std::string_view> users;
};
const std::vector<ThirdParty> third_parties{
    {"glm/", {"include/", "src/"}},
    {"tbb/", {"src/base/", "src/render/path/session.cpp", "src/cli/render/"}},
    {"OpenImageIO/", {"src/image/"}},
    {"yaml-cpp/", {"src/load/yaml/"}},
    {"fmt/",
     {"src/base/", "src/image/", "src/render/film/", "src/load/", "src/report/", "src/cli/"}},
    {"nlohmann/", {"src/load/mesh/gltf/", "src/report/"}},
    {"CLI/", {"src/cli/"}},
    {"embree3/", {"src/accel/"}},
    {"embree4/", {"src/accel/"}},
    {"hwy/", {"src/geometry/", "src/bvh/", "src/light_space/", "src/accel/", "src/render/"}},
};
// The operating system's headers: <unistd.h>, <sys/resource.h>.
const std::vector<std::string_view> system_header_users{"src/base/", "src/image/", "src/load/",
                                                        "src/report/", "src/cli/"};

struct Include {
  std::string target;
  bool quoted = false;
};

std::optional<Include> parse_include(std::string_view line) {
  const auto skip_blanks = [&] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  skip_blanks();
  if (!line.starts_with('#')) return std::nullopt;
  line.remove_prefix(1);
  skip_blanks();
  if (!line.starts_with("include")) return std::nullopt;
  line.remove_prefix(7);
  skip_blanks();
  if (line.empty() || (line[0] != '<' && line[0] != '"')) return std::nullopt;
  const bool quoted = line[0] == '"';
  line.remove_prefix(1);
  return Include{std::string(line.substr(0, line.find(quoted ? '"' : '>'))), quoted};
}

bool starts_with_any(std::string_view text, const std::vector<std::string_view>& prefixes) {
  return std::ranges::any_of(prefixes, [&](auto prefix) { return text.starts_with(prefix); });
}

// The module and floor of a file.
struct Place {
  std::string module;
  std::string floor;  // "load/yaml"; empty for a public header that belongs to no floor
};

// Returns the place of a path such as "load/yaml/tree.hpp".
Place place_of(const std::string& path, bool is_public) {
  const std::string module = path.substr(0, path.find('/'));
  const auto header = floors_of_headers.find(path);
  if (header != floors_of_headers.end()) return {module, header->second};
  return {module, is_public ? "" : fs::path(path).parent_path().generic_string()};
}

// Returns null if there is no entry.
const Floor* find_floor(std::string_view name) {
  const auto floor = std::ranges::find(floors, name, &Floor::name);
  return floor == floors.end() ? nullptr : &*floor;
}

// Returns why a file at `from` must not include `include`, a file at `to`; empty if it may.
std::string fault_between(const Place& from, const Place& to, const Include& include) {
  const auto rank = ranks.find(to.module);
  if (rank == ranks.end()) return "no module " + to.module;
  const Floor* floor = find_floor(from.floor);
  bool allowed = false;
  if (to.module != from.module)
    allowed = rank->second < ranks.at(from.module) &&
              !(floor != nullptr && starts_with_any(include.target, floor->unseen));
  else
    allowed = to.floor.empty() || to.floor == from.floor ||
              (floor != nullptr && std::ranges::count(floor->below, to.floor) > 0);
  if (allowed) return "";
  const auto name = [](const Place& place) {
    return place.floor.empty() ? place.module : place.floor;
  };
  return name(from) + " must not include " + name(to);
}

// Returns why `file`, at `from`, must not include `include`; empty if it may.
std::string fault(const std::string& file, const Place& from, const Include& include) {
  std::string_view target = include.target;
  const bool is_public = file.starts_with("include/");
  if (is_public && include.quoted) return "a public header must not include private ones";
  const bool pah_header = target.starts_with("pah/");
  if (pah_header) target.remove_prefix(4);
  const auto slash = target.find('/');
  const auto first = target.substr(0, slash);

  if (pah_header || include.quoted) {
    if (slash == std::string_view::npos) return pah_header ? "not in a module" : "";
    return fault_between(from, place_of(std::string(target), pah_header), include);
  }
  for (const ThirdParty& party : third_parties)
    if (target.starts_with(party.includes))
      return starts_with_any(file, party.users) ? ""
                                                : include.target + " must not be included here";
  if (slash == std::string_view::npos && !target.ends_with(".h"))
    return "";  // the standard library
  if (slash == std::string_view::npos || first == "sys")
    return starts_with_any(file, system_header_users)
               ? ""
               : include.target + " must not be included here";
  return "unknown third party " + include.target;
}

// `top` is the folder above the modules: include/pah or src.
void check_file(const fs::path& root, const fs::path& top, const fs::path& path,
                std::vector<std::string>& faults) {
  const std::string file = path.lexically_relative(root).generic_string();
  const Place place =
      place_of(path.lexically_relative(top).generic_string(), top.filename() == "pah");
  if (!ranks.contains(place.module)) {
    faults.push_back(file + ": no module " + place.module);
    return;
  }
  if (!place.floor.empty() && place.floor != place.module && find_floor(place.floor) == nullptr) {
    faults.push_back(file + ": no floor " + place.floor);
    return;
  }
  std::ifstream stream(path);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const auto include = parse_include(line);
    if (!include) continue;
    if (const std::string found = fault(file, place, *include); !found.empty())
      faults.push_back(file + ":" + std::to_string(number) + ": " + found);
  }
}

}  // namespace

std::vector<std::string> broken_include_rules(const fs::path& root) {
  std::vector<std::string> faults;
  for (const fs::path& top : {root / "include" / "pah", root / "src"}) {
    if (!fs::is_directory(top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".cpp" && extension != ".hpp") continue;
      check_file(root, top, entry.path(), faults);
    }
  }
  std::ranges::sort(faults);
  return faults;
}

}  // namespace pah::test
