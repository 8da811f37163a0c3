#include "load/mesh/common/file_reader.hpp"

#include <algorithm>
#include <cstring>
#include <pah/load/mesh_file.hpp>

namespace pah {
namespace {

constexpr std::size_t block = 1U << 18;  // fits the second-level cache

}  // namespace

FileReader::FileReader(const std::filesystem::path& file, std::uint64_t max_bytes)
    : stream_(file, std::ios::binary), buffer_(2 * block) {
  std::error_code error;
  size_ = std::filesystem::file_size(file, error);
  if (!stream_ || error) throw MeshFileError("the file cannot be read");
  if (size_ > max_bytes)
    throw MeshFileError("the file is larger than " + std::to_string(max_bytes >> 20) + " MB");
  unread_ = size_;
  find_line_end();
}

void FileReader::find_line_end() {
  fill(std::min<std::uint64_t>(block, size_));
  const auto begin = buffer_.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(end_);
  const auto first = std::find_if(begin, end, [](char c) { return c == '\n' || c == '\r'; });
  const bool only_return = first != end && *first == '\r' && (first + 1 == end || first[1] != '\n');
  if (only_return) line_end_ = '\r';
}

bool FileReader::fill(std::size_t count) {
  if (count > left()) return false;
  std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
  end_ -= at_;
  at_ = 0;
  if (buffer_.size() < count) buffer_.resize(count);
  const auto wanted =
      static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - end_, unread_));
  stream_.read(buffer_.data() + end_, static_cast<std::streamsize>(wanted));
  // Another process may have truncated the file.
  if (static_cast<std::size_t>(stream_.gcount()) != wanted)
    throw MeshFileError("the file cannot be read to its end");
  end_ += wanted;
  unread_ -= wanted;
  return true;
}

std::string_view FileReader::ahead(std::uint64_t count) {
  const auto size = static_cast<std::size_t>(std::min(count, left()));
  if (end_ - at_ < size) fill(size);
  return {buffer_.data() + at_, size};
}

std::optional<std::string_view> FileReader::line() {
  if (left() == 0) return {};
  ++line_number_;
  std::size_t searched = 0;
  const void* found = nullptr;
  while (true) {
    const std::size_t held = end_ - at_;
    // memchr must not be called with a null pointer, not even for 0 bytes.
    if (held > searched)
      found = std::memchr(buffer_.data() + at_ + searched, line_end_, held - searched);
    if (found != nullptr || unread_ == 0) break;
    if (held > longest_line)
      throw MeshFileError("a line of more than " + std::to_string(longest_line >> 20) + " MB",
                          line_number_);
    searched = held;
    fill(held + std::min<std::uint64_t>(block, unread_));
  }
  const char* const begin = buffer_.data() + at_;
  const bool ends = found != nullptr;
  std::size_t size =
      ends ? static_cast<std::size_t>(static_cast<const char*>(found) - begin) : end_ - at_;
  at_ += size + (ends ? 1 : 0);
  if (size > 0 && begin[size - 1] == '\r') --size;
  return std::string_view(begin, size);
}

}  // namespace pah
