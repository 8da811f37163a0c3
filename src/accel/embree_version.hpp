#pragma once

namespace pah {

// "4.3.0"; empty if this was built without Embree.
[[nodiscard]] const char* embree_version();

}  // namespace pah
