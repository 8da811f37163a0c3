// Files that are either whole or not there: written under another name, then renamed.
#pragma once

#include <filesystem>
#include <pah/base/errors.hpp>
#include <string_view>

namespace pah {

// Throws FileError if `file` cannot be created or replaced. Leaves no trace.
void check_can_create(const std::filesystem::path& file);

// Whether the file is a device or a pipe, to be written to as it is rather than replaced.
[[nodiscard]] bool is_device(const std::filesystem::path& file);

// A name in the same folder, of the same extension, that only this process uses.
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& file);

// Gives the finished `temporary` its name, and removes what is left of writes of that file that
// were killed. Throws FileError, and removes `temporary`, if it cannot have that name.
void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& file);

// Replaces `file` as a whole; devices and pipes are written to as they are. Throws FileError.
void write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace pah
