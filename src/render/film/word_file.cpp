#include "render/film/word_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <pah/base/errors.hpp>
#include <system_error>
#include <utility>

namespace pah {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;
constexpr std::size_t word_bytes = 8;

std::string last_error() { return std::generic_category().message(errno); }

void append(std::string& bytes, std::uint64_t word) {
  for (std::size_t i = 0; i < word_bytes; ++i)
    bytes.push_back(static_cast<char>(word >> (8 * i) & 0xFF));
}

std::uint64_t load_word(const char* bytes) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < word_bytes; ++i)
    word |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  return word;
}

}  // namespace

WordWriter::WordWriter(const std::filesystem::path& file, std::filesystem::path named)
    : named_(std::move(named)) {
  errno = 0;
  stream_.open(file, std::ios::binary | std::ios::trunc);
  if (!stream_) fail();
  buffer_.reserve(buffer_bytes);
}

void WordWriter::put(std::uint64_t word) {
  checksum_.add(word);
  append(buffer_, word);
  if (buffer_.size() == buffer_bytes) flush();
}

void WordWriter::put_double(double value) { put(std::bit_cast<std::uint64_t>(value)); }

void WordWriter::put_text(std::string_view text) {
  put(text.size());
  for (std::size_t at = 0; at < text.size(); at += word_bytes) {
    std::string padded(text.substr(at, word_bytes));
    padded.resize(word_bytes);
    put(load_word(padded.data()));
  }
}

void WordWriter::finish() {
  append(buffer_, checksum_.value());
  flush();
  stream_.close();
  if (!stream_) fail();
}

void WordWriter::flush() {
  errno = 0;
  if (!stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()))) fail();
  buffer_.clear();
}

void WordWriter::fail() const {
  throw FileError("cannot write " + named_.string() + ": " + last_error());
}

WordReader::WordReader(const std::filesystem::path& file) : file_(file) {
  std::error_code error;
  bytes_ = std::filesystem::file_size(file, error);
  errno = 0;
  if (!error) stream_.open(file, std::ios::binary);
  if (error || !stream_)
    throw FileError("cannot read " + file.string() + ": " +
                    (error ? error.message() : last_error()));
}

std::uint64_t WordReader::word() {
  if (at_ == buffer_.size()) fill();
  const std::uint64_t word = load_word(buffer_.data() + at_);
  at_ += word_bytes;
  read_ += word_bytes;
  checksum_.add(word);
  return word;
}

double WordReader::number() { return std::bit_cast<double>(word()); }

int WordReader::integer(int low, int high) {
  const std::uint64_t value = word();
  if (value < static_cast<std::uint64_t>(low) || value > static_cast<std::uint64_t>(high))
    fail_as_damaged();
  return static_cast<int>(value);
}

std::string WordReader::text(std::uint64_t max_bytes) {
  const std::uint64_t size = word();
  if (size > max_bytes) fail_as_damaged();
  std::string text;
  while (text.size() < size) append(text, word());
  text.resize(size);
  return text;
}

void WordReader::check_left(std::uint64_t words) const {
  const std::uint64_t expected = read_ + word_bytes * (words + 1);
  if (bytes_ < expected) fail(fmt::format("is cut short: it has {} of {} bytes", bytes_, expected));
  if (bytes_ > expected)
    fail(fmt::format("is damaged: {} bytes follow its end", bytes_ - expected));
}

void WordReader::check_end() {
  const std::uint64_t expected = checksum_.value();
  if (word() != expected) fail_as_damaged();
}

void WordReader::fill() {
  buffer_.resize(buffer_bytes);
  stream_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  const auto count = static_cast<std::size_t>(stream_.gcount());
  buffer_.resize(count - count % word_bytes);
  at_ = 0;
  if (buffer_.empty()) fail("is cut short");
}

void WordReader::fail(const std::string& fault) const {
  throw FileError(file_.string() + " " + fault);
}

void WordReader::fail_as_damaged() const { fail("is damaged: its bytes are not those written"); }

}  // namespace pah
