// Reads the pictures that a scene names once, before rendering.
#include "base/parallel_for.hpp"
#include "image/image_header.hpp"
#include "load/scene/sections/reading.hpp"

namespace pah {

void check_pictures(SceneReading& reading) {
  struct Check {
    const std::filesystem::path& file;
    const NamedPicture& named;
    std::string fault{};
    std::uint64_t unusable = 0;
    FileStamp stamp{};  // taken before the check
  };
  LoadedFiles::Impl* const loaded = reading.files.loaded();
  std::vector<Check> checks;
  checks.reserve(reading.pictures.size());
  std::vector<std::size_t> todo;
  for (const auto& [file, named] : reading.pictures) {
    checks.push_back({file, named});
    // An embedded picture has no modification time of its own.
    const bool keeps = loaded != nullptr && named.bytes == nullptr;
    if (const auto* kept = keeps ? loaded->picture_checks.find(file.string()) : nullptr)
      checks.back().unusable = kept->value;
    else
      todo.push_back(checks.size() - 1);
  }
  parallel_for(todo.size(), 1, [&](std::size_t j) {
    const std::size_t i = todo[j];
    checks[i].stamp = stamp_of(checks[i].file);
    try {
      checks[i].unusable =
          check_image_file(checks[i].file, reading.limits.image_bytes, checks[i].named.bytes.get());
    } catch (const FileError& error) {
      checks[i].fault = error.what();
    }
  });
  if (loaded != nullptr)
    for (const std::size_t i : todo)
      if (const Check& check = checks[i]; check.fault.empty() && check.named.bytes == nullptr)
        loaded->picture_checks.put(check.file.string(), {{check.file, check.stamp}},
                                   check.unusable);
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
