// Reads a file from beginning to end in blocks, as lines of text, as bytes, or both in turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

namespace pah {

inline constexpr std::size_t longest_line = 1U << 24;  // in bytes; no sensible line is longer

class FileReader {
 public:
  // Throws MeshFileError if the file cannot be read or has more than `max_bytes`.
  FileReader(const std::filesystem::path& file, std::uint64_t max_bytes);

  // Returns the next line without its end, or nothing at the end of the file. Lines end with "\n"
  // or "\r\n", or with "\r" if the first line does. Valid until the next call. Throws
  // MeshFileError for a line longer than longest_line.
  [[nodiscard]] std::optional<std::string_view> line();
  // The number of the last line read, from 1.
  [[nodiscard]] int line_number() const { return line_number_; }

  // Returns the next `count` bytes, or null if fewer are left. Valid until the next call.
  [[nodiscard]] const char* bytes(std::size_t count) {
    if (end_ - at_ < count && !fill(count)) return nullptr;
    const char* const begin = buffer_.data() + at_;
    at_ += count;
    return begin;
  }

  // Peeks at the next `count` bytes, or at all remaining ones; valid until the next call.
  [[nodiscard]] std::string_view ahead(std::uint64_t count);
  // Skips bytes that ahead() has returned.
  void skip(std::size_t count) { at_ += count; }

  [[nodiscard]] char line_end() const { return line_end_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  // The number of bytes not read yet.
  [[nodiscard]] std::uint64_t left() const { return unread_ + (end_ - at_); }

 private:
  // Fills the buffer with `count` bytes; returns false if the file ends before.
  bool fill(std::size_t count);
  void find_line_end();

  std::ifstream stream_;
  std::uint64_t size_ = 0;
  std::uint64_t unread_ = 0;  // bytes after those in the buffer
  std::vector<char> buffer_;
  std::size_t at_ = 0;   // index of the next byte in the buffer
  std::size_t end_ = 0;  // number of bytes in the buffer
  int line_number_ = 0;
  char line_end_ = '\n';
};

}  // namespace pah
