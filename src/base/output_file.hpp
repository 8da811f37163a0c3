// Files are written under a temporary name and then renamed, so that none is ever half written.
#pragma once

#include <filesystem>
#include <pah/base/errors.hpp>
#include <string>
#include <string_view>

namespace pah {

// Throws a FileError: cannot write `file`, for that reason.
[[noreturn]] void fail_to_write(const std::filesystem::path& file, const std::string& reason);

// Throws FileError if `file` cannot be created or replaced. Leaves no trace.
void check_can_create(const std::filesystem::path& file);

// Returns whether the file is a device or a pipe, which is written to directly and never replaced.
[[nodiscard]] bool is_device(const std::filesystem::path& file);

// Returns a name in the same folder, with the same extension, that only this process uses.
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& file);

// Renames the finished `temporary` to `file`, and removes temporary files that killed writes of
// `file` left. If renaming fails, removes `temporary` and throws FileError.
void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& file);

// Replaces `file` as a whole, or writes to a device or pipe directly. Throws FileError.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace pah
