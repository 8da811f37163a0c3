#include "io/scene/files.hpp"

#include <array>
#include <fstream>

#include "io/yaml/suggest.hpp"

namespace pah {
namespace {

namespace fs = std::filesystem;

// Names in the folder of a file that is not there, for a suggestion.
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

}  // namespace

void ContentHash::add(std::string_view bytes) {
  // The prime is 2^88 + 0x13B; arithmetic modulo 2^128 on two halves.
  constexpr std::uint64_t prime = 0x13B;
  for (const char c : bytes) {
    low_ ^= static_cast<unsigned char>(c);
    const std::uint64_t bottom = (low_ & 0xFFFFFFFFU) * prime;
    const std::uint64_t top = (low_ >> 32U) * prime + (bottom >> 32U);
    high_ = high_ * prime + (top >> 32U) + (low_ << 24U);
    low_ *= prime;  // shorter to wait for than joining the halves
  }
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

std::optional<fs::path> SceneFiles::open(ReadContext& context, const YamlNode& node,
                                         const ValueName& name, std::uint64_t most_bytes) {
  std::string text;
  if (!read_value(context, node, name, text)) return {};
  return open(context, node.mark, fs::path(text), most_bytes);
}

std::optional<fs::path> SceneFiles::open(ReadContext& context, const Mark& mark,
                                         const fs::path& file, std::uint64_t most_bytes) {
  fs::path whole = (folder_ / file).lexically_normal();
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
    std::ifstream stream(whole, std::ios::binary);
    hash_.add_part(std::to_string(size));
    std::array<char, 1 << 16> buffer{};
    while (stream.read(buffer.data(), buffer.size()) || stream.gcount() > 0)
      hash_.add({buffer.data(), static_cast<std::size_t>(stream.gcount())});
    entry->second = stream.eof();
  }
  if (!entry->second) return fail("cannot read file " + shown);
  return whole;
}

}  // namespace pah
