#include "load/scene/files/files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "base/little_endian.hpp"
#include "base/parallel_for.hpp"
#include "load/yaml/suggest.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

// Suggests a file in the folder with a name similar to that of a missing file.
std::string near_names(const fs::path& file) {
  constexpr std::size_t most = 1000;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(file.parent_path(), error), end; !error && it != end;
       it.increment(error)) {
    if (names.size() >= most) break;
    names.push_back(it->path().filename().string());
  }
  return suggestion(file.filename().string(), names);
}

// Adds a file to the hash; returns false if the file cannot be read.
bool add_file(const fs::path& file, ContentHash& hash) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1 << 16> buffer{};
  while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0)
    hash.add({buffer.data(), static_cast<std::size_t>(stream.gcount())});
  return stream.eof();
}

// Larger files are hashed in blocks of this size in parallel.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

// Like add_file(), for a large file of `size` bytes.
bool add_blocks(const fs::path& file, std::uintmax_t size, ContentHash& hash) {
  struct Block {
    ContentHash hash;
    bool is_read = false;
  };
  std::vector<Block> blocks((size + block_bytes - 1) / block_bytes);
  parallel_ranges(blocks.size(), 8, [&](std::size_t first, std::size_t last) {
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(first * block_bytes));
    std::vector<char> buffer(1U << 17);  // divides a block and fits the cache
    for (std::size_t i = first; i < last; ++i) {
      const std::uintmax_t end = std::min<std::uintmax_t>(size, (i + 1) * block_bytes);
      for (std::uintmax_t at = i * block_bytes; at < end && stream; at += buffer.size()) {
        const auto count =
            static_cast<std::size_t>(std::min<std::uintmax_t>(buffer.size(), end - at));
        stream.read(buffer.data(), static_cast<std::streamsize>(count));
        blocks[i].hash.add_words({buffer.data(), count});
      }
      blocks[i].is_read = !stream.fail();
    }
  });
  for (const Block& block : blocks) hash.add(block.hash.hex());
  return std::all_of(blocks.begin(), blocks.end(), [](const Block& b) { return b.is_read; });
}

}  // namespace

void ContentHash::step(std::uint64_t bits) {
  // The prime is 2^88 + 0x13B; arithmetic modulo 2^128 on two halves.
  constexpr std::uint64_t prime = 0x13B;
  low_ ^= bits;
  const std::uint64_t bottom = (low_ & 0xFFFFFFFFU) * prime;
  const std::uint64_t top = (low_ >> 32U) * prime + (bottom >> 32U);
  high_ = high_ * prime + (top >> 32U) + (low_ << 24U);
  low_ *= prime;  // lower latency than joining the halves
}

void ContentHash::add(std::string_view bytes) {
  for (const char c : bytes) step(static_cast<unsigned char>(c));
}

void ContentHash::add_words(std::string_view bytes) {
  const std::size_t words = bytes.size() / 8;
  for (std::size_t i = 0; i < words; ++i) {
    const char* const word = bytes.data() + 8 * i;
    step(load_u32(word) | std::uint64_t{load_u32(word + 4)} << 32U);
  }
  add(bytes.substr(8 * words));
}

void ContentHash::add_part(std::string_view bytes) {
  add(std::to_string(bytes.size()) + ":");
  add(bytes);
}

std::string ContentHash::hex() const {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint64_t half : {high_, low_})
    for (unsigned shift = 64; shift > 0; shift -= 4) text += digits[(half >> (shift - 4)) & 15U];
  return text;
}

std::optional<std::string> SceneFiles::content_hash(const fs::path& file,
                                                    std::uintmax_t size) const {
  const std::string key = file.string();
  if (loaded_ != nullptr)
    if (const auto* kept = loaded_->hashes.find(key)) return kept->value;
  const FileStamp stamp = stamp_of(file);
  ContentHash hash;
  const bool whole = size > block_bytes ? add_blocks(file, size, hash) : add_file(file, hash);
  if (!whole) return {};
  if (loaded_ != nullptr) loaded_->hashes.put(key, {{file, stamp}}, hash.hex());
  return hash.hex();
}

std::optional<fs::path> SceneFiles::open(ReadContext& context, const YamlNode& node,
                                         const ValueName& name, std::uint64_t most_bytes) {
  std::string text;
  if (!read_value(context, node, name, text)) return {};
  return open(context, node.mark, fs::path(text), most_bytes);
}

std::optional<fs::path> SceneFiles::open(ReadContext& context, const Mark& mark,
                                         const fs::path& file, std::uint64_t most_bytes) {
  fs::path whole = (folder_ / file).lexically_normal();
  announce(whole);
  const std::string shown = "'" + file.string() + "'";
  const auto fail = [&](const std::string& message) {
    context.errors.add(mark, message);
    return std::nullopt;
  };
  std::error_code error;
  const fs::file_status status = fs::status(whole, error);
  if (status.type() == fs::file_type::not_found)
    return fail("file " + shown + " does not exist" + near_names(whole));
  if (status.type() == fs::file_type::directory) return fail(shown + " is a directory");
  if (status.type() != fs::file_type::regular) return fail(shown + " is not a regular file");
  const std::uintmax_t size = fs::file_size(whole, error);
  if (error) return fail("cannot read file " + shown + ": " + error.message());
  if (size > most_bytes)
    return fail("file " + shown + " has " + std::to_string(size) + " bytes; the limit is " +
                std::to_string(most_bytes));

  const auto [entry, is_new] = seen_.emplace(whole.string(), true);
  if (is_new) {
    hash_.add_part(std::to_string(size));
    const std::optional<std::string> hash = content_hash(whole, size);
    if (hash) hash_.add_part(*hash);
    entry->second = hash.has_value();
  }
  if (!entry->second) return fail("cannot read file " + shown);
  return whole;
}

}  // namespace pah
