#include <array>
#include <pah/scene/metal_presets.hpp>

namespace pah {
namespace {

// The tabulated samples nearest to the wavelengths of the header. Au, Ag, Cu: P. B. Johnson and R.
// W. Christy, "Optical constants of the noble metals", Phys. Rev. B 6, 4370 (1972); Fe: the same,
// "Optical constants of transition metals", Phys. Rev. B 9, 5056 (1974); Al: A. D. Rakic,
// "Algorithm for the determination of intrinsic optical constants of metal films", Appl. Opt. 34,
// 4755 (1995).
constexpr std::array<MetalPreset, 5> presets{{
    {"Au", "gold", {0.14F, 0.43F, 1.38F}, {3.697F, 2.455F, 1.914F}},
    {"Ag", "silver", {0.05F, 0.06F, 0.04F}, {4.483F, 3.586F, 2.657F}},
    {"Cu", "copper", {0.22F, 1.02F, 1.15F}, {3.747F, 2.577F, 2.5F}},
    {"Al", "aluminum", {1.3456F, 0.96521F, 0.61722F}, {7.4746F, 6.3995F, 5.3031F}},
    {"Fe", "iron", {2.9114F, 2.9497F, 2.5845F}, {3.0893F, 2.9318F, 2.7670F}},
}};

}  // namespace

std::span<const MetalPreset> metal_presets() { return presets; }

}  // namespace pah
