// Whether the parts of a glTF document lie within one another and within its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace pah {

// `binary` is the chunk of a .glb. Throws MeshFileError or nlohmann::json::exception.
void check_gltf(const nlohmann::json& json, std::string_view binary,
                const std::filesystem::path& file, const std::filesystem::path& folder,
                std::uint64_t max_bytes);

// The file at once. Throws MeshFileError.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& file, std::uint64_t max_bytes);

}  // namespace pah
