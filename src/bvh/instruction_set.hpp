// What the kernels run on.
#pragma once

namespace pah {

// As Highway calls it: "AVX2". The best of those that kernels are compiled for and this processor
// has.
[[nodiscard]] const char* instruction_set();

}  // namespace pah
