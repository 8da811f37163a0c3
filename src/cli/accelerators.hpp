// The accelerators that --accel knows, by name.
#pragma once

#include <memory>
#include <pah/accel/accelerator.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pah::cli {

struct AcceleratorChoice {
  std::string_view name;
  std::string_view what;
  std::unique_ptr<Accelerator> (*make)(Triangles);
};

// The first is the default.
[[nodiscard]] std::span<const AcceleratorChoice> accelerators();

// Null if there is none of that name.
[[nodiscard]] const AcceleratorChoice* find_accelerator(std::string_view name);

}  // namespace pah::cli
