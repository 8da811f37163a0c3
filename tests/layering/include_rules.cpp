#include "include_rules.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>

namespace pah::testing {
namespace {

namespace fs = std::filesystem;

// geometry, parallel | influence, bvh | accel, scene | render | io | report | cli
const std::map<std::string, int, std::less<>> ranks{
    {"geometry", 0}, {"parallel", 0}, {"influence", 1}, {"bvh", 1},    {"accel", 2},
    {"scene", 2},    {"render", 3},   {"io", 4},        {"report", 5}, {"cli", 6}};

// Include prefixes of third parties, and the path prefixes of the files that may use them.
struct ThirdParty {
  std::string_view includes;
  std::vector<std::string_view> users;
};
const std::vector<ThirdParty> third_parties{
    {"glm/", {"include/", "src/"}},
    {"tbb/", {"src/parallel/", "src/render/session.cpp", "src/cli/render_command.cpp"}},
    {"OpenImageIO/", {"src/io/image_", "src/scene/texture"}},
    {"yaml-cpp/", {"src/io/"}},
    {"assimp/", {"src/io/"}},
    {"fmt/", {"src/io/", "src/report/", "src/cli/"}},
    {"nlohmann/", {"src/io/gltf_file", "src/report/json_value"}},
    {"CLI/", {"src/cli/"}},
    {"embree3/", {"src/accel/"}},
    {"embree4/", {"src/accel/"}},
    {"hwy/", {"src/geometry/", "src/bvh/", "src/accel/"}},
};
// The operating system's headers: <unistd.h>, <sys/resource.h>.
const std::vector<std::string_view> system_header_users{"src/io/", "src/report/", "src/cli/"};

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

// What is wrong with `include` in `file` of `module`; empty if nothing.
std::string fault(const std::string& file, const std::string& module, const Include& include) {
  std::string_view target = include.target;
  const bool is_public = file.starts_with("include/");
  if (is_public && include.quoted) return "a public header must not include private ones";
  const bool pah_header = target.starts_with("pah/");
  if (pah_header) target.remove_prefix(4);
  const auto slash = target.find('/');
  const auto first = target.substr(0, slash);

  if (pah_header || include.quoted) {
    if (slash == std::string_view::npos) return pah_header ? "not in a module" : "";
    const auto rank = ranks.find(first);
    if (rank == ranks.end()) return "no module " + std::string(first);
    if (first == module || rank->second < ranks.at(module)) return "";
    return module + " must not include " + std::string(first);
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

void check_file(const fs::path& root, const fs::path& path, const std::string& module,
                std::vector<std::string>& faults) {
  const std::string file = path.lexically_relative(root).generic_string();
  if (!ranks.contains(module)) {
    faults.push_back(file + ": no module " + module);
    return;
  }
  std::ifstream stream(path);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const auto include = parse_include(line);
    if (!include) continue;
    if (const std::string what = fault(file, module, *include); !what.empty())
      faults.push_back(file + ":" + std::to_string(number) + ": " + what);
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
      const auto module = entry.path().lexically_relative(top).begin()->string();
      check_file(root, entry.path(), module, faults);
    }
  }
  std::ranges::sort(faults);
  return faults;
}

}  // namespace pah::testing
