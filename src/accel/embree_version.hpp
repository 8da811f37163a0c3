#pragma once

namespace pah {

// Embree's version, such as "4.3.0"; empty if pahrender was built without Embree.
[[nodiscard]] const char* embree_version();

}  // namespace pah
