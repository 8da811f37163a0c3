#include "cli/accelerators.hpp"

#include <algorithm>
#include <array>

namespace pah::cli {

std::span<const AcceleratorChoice> accelerators() {
  static constexpr std::array<AcceleratorChoice, 2> choices{{
      {"bvh", "one BVH over all triangles", make_global_bvh},
      {"brute_force", "no structure: every ray tests every triangle", make_brute_force},
  }};
  return choices;
}

const AcceleratorChoice* find_accelerator(std::string_view name) {
  const auto all = accelerators();
  const auto found = std::ranges::find(all, name, &AcceleratorChoice::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace pah::cli
