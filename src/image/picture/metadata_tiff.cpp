#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "image/picture/metadata.hpp"

namespace pah {
namespace {

using IOFile = OIIO::Filesystem::IOFile;

// A file that replaces some bytes as they are read.
class PatchedFile final : public IOFile {
 public:
  explicit PatchedFile(const std::string& file) : IOFile(file, IOProxy::Read) {}

  // Readers bypass a proxy whose type is "file".
  const char* proxytype() const override { return "patched"; }

  void patch(std::uint64_t at, char byte) { patches_[at] = byte; }

  std::size_t read(void* buffer, std::size_t size) override {
    const auto at = static_cast<std::uint64_t>(tell());
    return patched(buffer, IOFile::read(buffer, size), at);
  }
  std::size_t pread(void* buffer, std::size_t size, std::int64_t offset) override {
    return patched(buffer, IOFile::pread(buffer, size, offset), static_cast<std::uint64_t>(offset));
  }

 private:
  std::size_t patched(void* buffer, std::size_t size, std::uint64_t at) const {
    for (auto it = patches_.lower_bound(at); it != patches_.end() && it->first < at + size; ++it)
      static_cast<char*>(buffer)[it->first - at] = it->second;
    return size;
  }

  std::map<std::uint64_t, char> patches_;
};

// Walks the directories of a TIFF file, whose entries have tags.
class Directories {
 public:
  explicit Directories(PatchedFile& file) : file_(file) {
    std::array<unsigned char, 4> magic{};
    (void)file.pread(magic.data(), magic.size(), 0);
    big_endian_ = magic[0] == 'M';
    big_ = magic[2] == '+' || magic[3] == '+';
  }

  void hide_metadata() {
    // No mip map has more levels.
    constexpr std::size_t most_directories = 64;
    std::set<std::uint64_t> seen;
    std::uint64_t link = big_ ? 8 : 4;
    for (;;) {
      const std::uint64_t at = number(link, word());
      if (at == 0) return;
      if (seen.size() == most_directories || !seen.insert(at).second) {
        for (std::uint64_t i = 0; i < word(); ++i) file_.patch(link + i, 0);
        return;
      }
      link = hide_in(at);
    }
  }

 private:
  // The size of an offset in bytes.
  [[nodiscard]] std::uint64_t word() const { return big_ ? 8 : 4; }

  // Returns 0 beyond the file's end.
  [[nodiscard]] std::uint64_t number(std::uint64_t at, std::uint64_t count) const {
    std::array<unsigned char, 8> bytes{};
    if (at > file_.size() ||
        file_.pread(bytes.data(), count, static_cast<std::int64_t>(at)) != count)
      return 0;
    std::uint64_t value = 0;
    for (std::uint64_t i = 0; i < count; ++i)
      value = value << 8U | bytes[big_endian_ ? i : count - 1 - i];
    return value;
  }

  // Hides the metadata tags of a directory; returns the position of the link to the next one.
  std::uint64_t hide_in(std::uint64_t directory) {
    constexpr std::uint64_t xmp = 700, iptc = 33723, photoshop = 34377, exif = 34665, icc = 34675,
                            gps = 34853;
    const std::uint64_t entry_bytes = big_ ? 20 : 12;
    const std::uint64_t first = directory + (big_ ? 8 : 2);
    // libtiff reads no more entries.
    const std::uint64_t count = std::min<std::uint64_t>(number(directory, big_ ? 8 : 2), 0xFFFF);
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t at = first + i * entry_bytes;
      const std::uint64_t tag = number(at, 2);
      if (tag != xmp && tag != iptc && tag != photoshop && tag != exif && tag != icc && tag != gps)
        continue;
      file_.patch(at, '\xFF');
      file_.patch(at + 1, '\xFF');
    }
    return first + count * entry_bytes;
  }

  PatchedFile& file_;
  bool big_endian_ = false;
  bool big_ = false;  // BigTIFF: 64-bit offsets
};

}  // namespace

std::unique_ptr<OIIO::Filesystem::IOProxy> open_tiff_without_metadata(
    const std::filesystem::path& file) {
  auto patched = std::make_unique<PatchedFile>(file.string());
  if (patched->opened()) Directories(*patched).hide_metadata();
  return patched;
}

}  // namespace pah
