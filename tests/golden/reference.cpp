#include "reference.hpp"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <pah/image/image_file.hpp>

#include "support/paths.hpp"

namespace pah::golden {
namespace {

const std::filesystem::path folder = test::source_folder() / "golden";
const std::filesystem::path references = folder / "references";

Image to_image(const Batches& batches, const std::vector<DVec3>& pixels) {
  return {batches.width(), batches.height(), {pixels.begin(), pixels.end()}};
}

std::vector<DVec3> to_doubles(const Image& image) {
  return {image.pixels.begin(), image.pixels.end()};
}

std::string read_metadata(const std::filesystem::path& file, const std::string& key) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (input == nullptr) throw FileError("cannot read " + file.string() + ": " + OIIO::geterror());
  return input->spec().get_string_attribute(key);
}

}  // namespace

LoadedScene load_golden(const std::string& name) { return load_scene(folder / (name + ".yaml")); }

void write_reference(const std::string& name, const LoadedScene& scene, const Batches& batches) {
  std::vector<DVec3> variance_of_mean;
  for (std::size_t i = 0; i < batches.mean().size(); ++i)
    variance_of_mean.push_back(batches.variance(i) / static_cast<double>(batches.count()));

  WriteOptions options;
  options.full_float = true;
  options.metadata = {
      {"version", PAHRENDER_VERSION},
      {"scene_hash", scene.hash},
      {"samples_per_pixel", std::to_string(batches.count() * scene.scene.render.samples)},
      {"batches", std::to_string(batches.count())},
      {"seeds", fmt::format("{}..{}", reference_seed,
                            reference_seed + static_cast<std::uint64_t>(batches.count()) - 1)}};
  for (const auto& [kind, pixels] :
       {std::pair{"mean", &batches.mean()}, {"variance", &variance_of_mean}})
    write_image(references / fmt::format("{}_{}.exr", name, kind),
                {{"", {"R", "G", "B"}, to_image(batches, *pixels)}}, options);
}

Reference read_reference(const std::string& name) {
  const std::filesystem::path mean_file = references / (name + "_mean.exr");
  const Image mean = read_image(mean_file);
  const int count = std::stoi(read_metadata(mean_file, "batches"));
  std::vector<DVec3> variance = to_doubles(read_image(references / (name + "_variance.exr")));
  for (DVec3& v : variance) v *= count;  // of one batch, not of the mean
  return {Batches(mean.width, mean.height, count, to_doubles(mean), variance),
          read_metadata(mean_file, "scene_hash")};
}

}  // namespace pah::golden
