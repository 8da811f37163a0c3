// Binary files of little-endian 64-bit words that end with a checksum.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/mix_bits.hpp"

namespace pah {

// mix_bits maps words one to one. So a step takes different words to different sums, and different
// sums to different sums: files that differ in one word, and so in one byte, never agree.
class WordChecksum {
 public:
  void add(std::uint64_t word) { sum_ = mix_bits(sum_ ^ word); }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 0x9E3779B97F4A7C15ULL;
};

class WordWriter {
 public:
  // Error messages name the file `named`.
  WordWriter(const std::filesystem::path& file, std::filesystem::path named);

  void put(std::uint64_t word);
  void put_int(int value) { put(static_cast<std::uint64_t>(value)); }
  void put_double(double value);
  void put_text(std::string_view text);
  // Adds the checksum. Throws FileError if not all was written.
  void finish();

 private:
  void flush();
  [[noreturn]] void fail() const;

  std::filesystem::path named_;
  std::ofstream stream_;
  std::string buffer_;
  WordChecksum checksum_;
};

// All functions throw FileError.
class WordReader {
 public:
  explicit WordReader(const std::filesystem::path& file);

  [[nodiscard]] std::uint64_t word();
  [[nodiscard]] double number();
  // Reads a number in a range; a number outside of it means damage.
  [[nodiscard]] int integer(int low, int high);
  [[nodiscard]] std::string text(std::uint64_t max_bytes);
  // Throws unless exactly this number of words, and then the checksum, follow.
  void check_left(std::uint64_t words) const;
  void check_end();
  [[noreturn]] void fail(const std::string& fault) const;
  [[noreturn]] void fail_as_damaged() const;

 private:
  void fill();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t bytes_ = 0;  // of the file
  std::uint64_t read_ = 0;
  std::vector<char> buffer_;
  std::size_t at_ = 0;
  WordChecksum checksum_;
};

}  // namespace pah
