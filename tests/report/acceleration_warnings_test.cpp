#include "report/acceleration_warnings.hpp"

#include <pah/scene/shapes.hpp>

#include "base/format_bytes.hpp"
#include "catch.hpp"

using namespace pah;

TEST_CASE("A BVH that takes more memory than the scene allows causes a warning") {
  Scene scene;
  scene.materials.push_back({"gray", DiffuseMaterial{}});
  scene.meshes = {make_mesh(SphereShape{})};
  scene.instances.emplace_back();
  const World world = make_world(scene);
  const Acceleration acceleration = make_acceleration(world, scene);
  const std::uint64_t bytes = acceleration.accelerator->memory().global_bvh;
  REQUIRE(bytes > 1000);
  CHECK(warnings_of(acceleration, world, scene).empty());
  scene.acceleration.memory = bytes;
  CHECK(warnings_of(acceleration, world, scene).empty());
  scene.acceleration.memory = 1500;
  CHECK(warnings_of(acceleration, world, scene) ==
        std::vector<std::string>{
            "the BVH of the whole scene takes " + format_bytes(bytes) +
            ", more than the 1.50 kB of 'memory' of acceleration; it is built anyway"});
}

TEST_CASE("Bytes are formatted in a fitting unit") {
  CHECK(format_bytes(0) == "0 bytes");
  CHECK(format_bytes(999) == "999 bytes");
  CHECK(format_bytes(1000) == "1.00 kB");
  CHECK(format_bytes(12'345'678) == "12.35 MB");
  CHECK(format_bytes(2'500'000'000) == "2.50 GB");
}
