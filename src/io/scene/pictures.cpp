// The pictures that a scene names, read once before anything is rendered.
#include "io/image_header.hpp"
#include "io/scene/reading.hpp"
#include "parallel/parallel_for.hpp"

namespace pah {

void check_pictures(SceneReading& reading) {
  struct Check {
    const std::filesystem::path& file;
    const Mark& mark;
    std::string fault{};
  };
  std::vector<Check> checks;
  for (const auto& [file, mark] : reading.pictures) checks.push_back({file, mark});
  parallel_for(checks.size(), 1, [&](std::size_t i) {
    try {
      check_image_file(checks[i].file, reading.limits.image_bytes);
    } catch (const FileError& error) {
      checks[i].fault = error.what();
    }
  });
  for (const Check& check : checks)
    if (!check.fault.empty())
      reading.context.errors.add(
          check.mark, "cannot read image '" + check.file.filename().string() + "': " + check.fault);
}

}  // namespace pah
