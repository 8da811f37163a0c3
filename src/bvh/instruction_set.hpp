// The instruction set that the kernels run on.
#pragma once

namespace pah {

// Highway's name, such as "AVX2", of the best instruction set that kernels are compiled for and
// that this processor has.
[[nodiscard]] const char* instruction_set();

}  // namespace pah
