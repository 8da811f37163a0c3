#include <pah/image/image_file.hpp>
#include <pah/load/load_scene.hpp>
#include <pah/render/acceleration.hpp>
#include <pah/render/render.hpp>

int main(int, char** argv) {
  const pah::LoadedScene loaded = pah::load_scene(argv[1]);
  const pah::World world = pah::make_world(loaded.scene);
  const pah::Acceleration acceleration = pah::make_acceleration(world, loaded.scene);
  const pah::RenderResult result =
      pah::render(world, *acceleration.accelerator, loaded.scene.film, loaded.scene.render);
  pah::write_image(argv[2], {{"", {"R", "G", "B"}, pah::radiance_of(result.film)}});
}
