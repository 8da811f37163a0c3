// The pictures that a scene names, read once before anything is rendered.
#include "io/image_header.hpp"
#include "io/scene/reading.hpp"
#include "parallel/parallel_for.hpp"

namespace pah {

void check_pictures(SceneReading& reading) {
  struct Check {
    const std::filesystem::path& file;
    const NamedPicture& named;
    std::string fault{};
    std::uint64_t unusable = 0;
  };
  std::vector<Check> checks;
  checks.reserve(reading.pictures.size());
  for (const auto& [file, named] : reading.pictures) checks.push_back({file, named});
  parallel_for(checks.size(), 1, [&](std::size_t i) {
    try {
      checks[i].unusable =
          check_image_file(checks[i].file, reading.limits.image_bytes, checks[i].named.bytes.get());
    } catch (const FileError& error) {
      checks[i].fault = error.what();
    }
  });
  for (const Check& check : checks) {
    const std::string shown = "image '" + check.file.filename().string() + "'";
    if (!check.fault.empty())
      reading.context.errors.add(check.named.mark, "cannot read " + shown + ": " + check.fault);
    if (check.unusable > 0)
      reading.context.errors.warn(
          check.named.mark,
          shown + " has " + std::to_string(check.unusable) +
              " values that are infinite, too large or not a number; they count as 0");
  }
}

}  // namespace pah
