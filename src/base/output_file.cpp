#include "base/output_file.hpp"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <fstream>
#include <system_error>

namespace pah {
namespace {

namespace fs = std::filesystem;

std::string last_error() { return std::generic_category().message(errno); }

// Follows links: renaming must replace the file, not the link to it.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  const fs::path target = fs::weakly_canonical(absolute, error);
  return error ? absolute : target;
}

void write_all(const fs::path& file, const fs::path& named, std::string_view text,
               std::ios::openmode mode = std::ios::trunc) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | mode);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (stream) return;
  const std::string reason = last_error();
  if (file != named) {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
  fail_to_write(named, reason);
}

// The parts of a temporary file's name before and after the process id.
struct TemporaryName {
  std::string before, after;
};

TemporaryName temporary_name(const fs::path& target) {
  return {"." + target.stem().string() + ".part", target.extension().string()};
}

// Removes temporary files of processes that were killed while they wrote this file. An unknown
// process may run on another machine, so a file must be a minute old.
void remove_leftovers(const fs::path& target) {
  const auto [before, after] = temporary_name(target);
  std::error_code ignored;
  for (fs::directory_iterator entry(target.parent_path(), ignored), end; entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(before)) continue;
    pid_t process = 0;
    const auto [end_of_id, error] =
        std::from_chars(name.data() + before.size(), name.data() + name.size(), process);
    if (error != std::errc() || process <= 0 ||
        end_of_id != name.data() + name.size() - after.size() || !name.ends_with(after))
      continue;
    if (::kill(process, 0) == 0 || errno != ESRCH) continue;
    const fs::file_time_type written = fs::last_write_time(entry->path(), ignored);
    if (!ignored && fs::file_time_type::clock::now() - written > std::chrono::minutes(1))
      fs::remove(entry->path(), ignored);
  }
}

}  // namespace

void fail_to_write(const fs::path& file, const std::string& reason) {
  throw FileError("cannot write " + file.string() + ": " + reason);
}

bool is_device(const fs::path& file) {
  // These may lead to regular files, but another program has those open.
  for (const char* open_file : {"/dev/std", "/dev/fd/", "/proc/"})
    if (file.string().starts_with(open_file)) return true;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

fs::path temporary_beside(const fs::path& file) {
  const fs::path target = resolved(file);
  const auto [before, after] = temporary_name(target);
  return target.parent_path() / (before + std::to_string(::getpid()) + after);
}

void check_can_create(const fs::path& file) {
  if (file.filename().empty()) fail_to_write(file, "it names no file");
  if (is_device(file)) return;
  std::error_code error;
  if (fs::is_directory(file, error)) fail_to_write(file, "it is a folder");
  const fs::path folder = resolved(file).parent_path();
  if (!fs::is_directory(folder, error))
    fail_to_write(file, "there is no folder " + folder.string());
  const fs::path probe = temporary_beside(file);
  write_all(probe, file, {});
  fs::remove(probe, error);
}

void put_in_place(const fs::path& temporary, const fs::path& file) {
  std::error_code error;
  if (is_device(file))
    error = std::make_error_code(std::errc::not_supported);
  else
    fs::rename(temporary, resolved(file), error);
  if (!error) return remove_leftovers(resolved(file));
  std::error_code ignored;
  fs::remove(temporary, ignored);
  fail_to_write(file, error.message());
}

void write_text_file(const fs::path& file, std::string_view text) {
  if (is_device(file)) return write_all(file, file, text, std::ios::app);
  const fs::path temporary = temporary_beside(file);
  write_all(temporary, file, text);
  put_in_place(temporary, file);
}

}  // namespace pah
