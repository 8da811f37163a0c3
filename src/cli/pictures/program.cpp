// The program's side. Its definitions precede those of the static libraries, so the linker takes
// nothing from the files there that need OpenImageIO.
#include <dlfcn.h>

#include "cli/pictures/functions.hpp"
#include "image/image_library.hpp"

namespace pah {
namespace {

const cli::PictureFunctions& load_functions() {
  // The module is found by the program's search path (RPATH), and never closed.
  void* const module = ::dlopen(PAH_PICTURES_MODULE, RTLD_LAZY | RTLD_LOCAL);
  const void* const functions =
      module == nullptr ? nullptr : ::dlsym(module, cli::picture_functions_name);
  if (functions == nullptr)
    throw FileError("cannot load the picture library: " + std::string(::dlerror()));
  return *static_cast<const cli::PictureFunctions*>(functions);
}

const cli::PictureFunctions& loaded() {
  static const cli::PictureFunctions& functions = load_functions();
  return functions;
}

}  // namespace

void load_image_library() { (void)loaded(); }

void write_image(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
                 const WriteOptions& options) {
  loaded().write_image(file, layers, options);
}

Image read_image(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return loaded().read_image(file, max_bytes);
}

ImageMetadata read_metadata(const std::filesystem::path& file) {
  return loaded().read_metadata(file);
}

ImageHeader read_image_header(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return loaded().read_image_header(file, max_bytes);
}

std::uint64_t check_image_file(const std::filesystem::path& file, std::uint64_t max_bytes,
                               const std::string* bytes) {
  return loaded().check_image_file(file, max_bytes, bytes);
}

std::vector<float> read_first_channel(const std::filesystem::path& file, std::uint64_t max_bytes) {
  return loaded().read_first_channel(file, max_bytes);
}

std::unique_ptr<TextureImages> make_texture_images(std::size_t count,
                                                   const TextureOptions& options) {
  return loaded().make_texture_images(count, options);
}

}  // namespace pah
