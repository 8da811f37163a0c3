// Camera, film and render sections.
#include <algorithm>
#include <cmath>

#include "load/scene/sections/reading.hpp"

namespace pah {
namespace {

constexpr std::size_t perspective = 0;

// Reads position, look_at and up. The view direction and up must not be parallel.
template <class CameraType>
void read_pose(MapReader& map, CameraType& camera) {
  map.optional("position", camera.position);
  map.optional("look_at", camera.look_at);
  map.optional("up", camera.up);
  const DVec3 forward = camera.look_at - camera.position;
  if (forward == DVec3(0)) {
    map.error("look_at", "camera looks at its own position");
    return;
  }
  // cross() gives the sine of the angle between unit vectors with an error of some ulps. Below
  // that, the direction of up is arbitrary.
  const DVec3 up = camera.up;
  const double scale = std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)});
  if (scale == 0) {
    map.error("up", map.name_of("up") + " must not be zero");
    return;
  }
  const DVec3 side = glm::cross(glm::normalize(forward), glm::normalize(up / scale));
  if (glm::length(side) <= 8 * std::numeric_limits<double>::epsilon())
    map.error("up", map.name_of("up") + " is parallel to the viewing direction");
}

void read_lens(MapReader& map, PerspectiveCamera& camera) {
  constexpr double narrow = 3;  // degrees: a telescope, or a value meant in radians
  if (map.optional("fov", camera.fov, NumberRange{0, 180, true, true}) && camera.fov < narrow)
    map.context().errors.warn(map.mark_of("fov"), "'fov' is in degrees, and this is very narrow");
  map.optional("aperture_radius", camera.aperture_radius, not_negative);
  double focus = 0;
  if (map.optional("focus_distance", focus, positive)) camera.focus_distance = focus;
}

void read_filter(MapReader& film, FilmSettings& settings) {
  const EnumNames<PixelFilter> names{{"blackman_harris", PixelFilter::blackman_harris},
                                     {"box", PixelFilter::box}};
  const auto set = [&](PixelFilter filter) {
    settings.filter = filter;
    settings.filter_radius = filter == PixelFilter::box ? 0.5 : FilmSettings{}.filter_radius;
  };
  film.nested("filter", [&](const YamlNode* node) {
    const ValueName name = film.name_of("filter");
    if (node != nullptr && node->kind != YamlNode::Kind::map) {
      std::vector<std::string> options;
      for (const auto& entry : names) options.push_back(entry.first);
      const std::size_t index = read_option(film.context(), *node, name, options);
      if (index < names.size()) set(names[index].second);
      return;
    }
    read_map(film.context(), node, "filter", "filter", [&](MapReader& map) {
      PixelFilter filter = settings.filter;
      if (map.option("type", filter, names, true)) set(filter);
      map.optional("radius", settings.filter_radius, NumberRange{0, 16, true, false});
    });
  });
}

void read_crop(MapReader& film, FilmSettings& settings) {
  const YamlNode* node = film.find("crop");
  if (node == nullptr) return;
  ReadContext& context = film.context();
  const ValueName name = film.name_of("crop");
  if (node->kind != YamlNode::Kind::list || node->items.size() != 4) {
    film.error("crop",
               name + " must be a list of 4 numbers, x0, x1, y0, y1, not " + describe(*node));
    return;
  }
  PixelRect rect;
  const bool read = read_value(context, *node->items[0], name, rect.x0, 0, settings.width) &&
                    read_value(context, *node->items[1], name, rect.x1, 0, settings.width) &&
                    read_value(context, *node->items[2], name, rect.y0, 0, settings.height) &&
                    read_value(context, *node->items[3], name, rect.y1, 0, settings.height);
  if (!read) return;
  if (rect.width() <= 0 || rect.height() <= 0)
    film.error("crop", name + " holds no pixel");
  else
    settings.crop = rect;
}

void read_channels(MapReader& film, FilmSettings& settings) {
  const std::vector<std::string> options{"albedo", "normal", "depth", "variance"};
  const YamlNode* node = film.find("channels", false, options);
  if (node == nullptr || !is_list(film.context(), *node, film.name_of("channels"))) return;
  bool* const flags[] = {&settings.albedo, &settings.normal, &settings.depth, &settings.variance};
  for (const YamlRef& item : node->items) {
    const std::size_t index = read_option(film.context(), *item, "'channel' of film", options);
    if (index < options.size()) *flags[index] = true;
  }
}

}  // namespace

void read_camera(SceneReading& reading, const YamlNode* node) {
  reading.camera = node;
  read_variant(reading.context, node, "camera", "camera", "type", {"perspective", "orthographic"},
               perspective, [&](MapReader& map, std::size_t type) {
                 if (type == perspective) {
                   PerspectiveCamera camera;
                   read_pose(map, camera);
                   read_lens(map, camera);
                   reading.scene.camera = camera;
                 } else {
                   OrthographicCamera camera;
                   read_pose(map, camera);
                   map.optional("height", camera.height, positive);
                   reading.scene.camera = camera;
                 }
               });
}

void adopt_camera(SceneReading& reading, const Camera& camera, const Mark& mark) {
  reading.scene.camera = camera;
  const YamlNode* node = reading.camera;
  if (node == nullptr || node->kind != YamlNode::Kind::map) return;
  for (const YamlEntry& entry : node->entries)
    if (entry.key != "fov" && entry.key != "aperture_radius" && entry.key != "focus_distance") {
      reading.context.errors.add(mark,
                                 "the scene has a camera already: beside a mesh file's, "
                                 "'camera' may have fov, aperture_radius and focus_distance");
      return;
    }
  auto* const perspective_camera = std::get_if<PerspectiveCamera>(&reading.scene.camera);
  if (perspective_camera == nullptr) {
    reading.context.errors.add(node->mark,
                               "the mesh file's camera is orthographic: it has no lens");
    return;
  }
  // Errors were reported when the section was read.
  MapReader map(reading.context, node, "camera perspective", "camera");
  read_lens(map, *perspective_camera);
}

void read_film(SceneReading& reading, const YamlNode* node) {
  constexpr int most_pixels = 65536;  // across
  FilmSettings& film = reading.scene.film;
  read_map(reading.context, node, "film", "film", [&](MapReader& map) {
    const bool has_width = map.optional("width", film.width, 1, most_pixels);
    const bool has_height = map.optional("height", film.height, 1, most_pixels);
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(film.width) * static_cast<std::uint64_t>(film.height);
    if ((has_width || has_height) && pixels > reading.limits.film_pixels)
      map.error("width", "a film of " + std::to_string(film.width) + " x " +
                             std::to_string(film.height) + " pixels is larger than the limit of " +
                             std::to_string(reading.limits.film_pixels) + " pixels");
    read_filter(map, film);
    map.optional("exposure", film.exposure, NumberRange{-64, 64});
    read_crop(map, film);
    read_channels(map, film);
  });
}

void read_render(SceneReading& reading, const YamlNode* node) {
  constexpr int most_samples = 1 << 30;
  constexpr int most_depth = 65536;
  RenderSettings& render = reading.scene.render;
  read_map(reading.context, node, "render", "render", [&](MapReader& map) {
    map.optional("samples", render.samples, 1, most_samples);
    map.optional("max_depth", render.max_depth, 1, most_depth);
    map.optional("roulette_depth", render.roulette_depth, 1, most_depth);
    map.optional("seed", render.seed);
    map.option("strategy", render.strategy,
               EnumNames<Strategy>{
                   {"mis", Strategy::mis}, {"nee", Strategy::nee}, {"bsdf", Strategy::bsdf}});
  });
}

}  // namespace pah
