// Rays put in order before they are asked: what a renderer could do for packets.
#pragma once

#include <memory>
#include <pah/accel/accelerator.hpp>

namespace pah::bench {

// Searches for any hit ask `accelerator` in the order of the rays' origins along a Morton curve.
// For one thread.
[[nodiscard]] std::unique_ptr<Accelerator> make_sorted(std::unique_ptr<Accelerator> accelerator);

}  // namespace pah::bench
