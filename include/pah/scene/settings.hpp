// The settings of a scene: its film, render, influence_areas and acceleration sections.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <pah/accel/local_config.hpp>
#include <pah/geometry/vec.hpp>
#include <string>
#include <variant>
#include <vector>

namespace pah {

// Pixels [x0, x1) x [y0, y1); y grows downwards.
struct PixelRect {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
};

enum class PixelFilter { blackman_harris, box };

struct FilmSettings {
  int width = 960;  // pixels, in [1, 65536]; width * height is limited at load
  int height = 540;
  PixelFilter filter = PixelFilter::blackman_harris;
  double filter_radius = 1.5;     // pixels; 0.5 is the default of the box filter
  double exposure = 0;            // stops; low dynamic range files only
  std::optional<PixelRect> crop;  // render only these pixels
  bool albedo = false, normal = false, depth = false, variance = false;  // extra EXR channels
};

// The pixels to be rendered: the crop, within the picture.
[[nodiscard]] inline PixelRect pixels_of(const FilmSettings& film) {
  PixelRect rect{0, film.width, 0, film.height};
  if (film.crop) {
    rect.x0 = std::clamp(film.crop->x0, 0, film.width);
    rect.x1 = std::clamp(film.crop->x1, rect.x0, film.width);
    rect.y0 = std::clamp(film.crop->y0, 0, film.height);
    rect.y1 = std::clamp(film.crop->y1, rect.y0, film.height);
  }
  return rect;
}

// How paths find light; the expected picture is the same for all three.
enum class Strategy { mis, nee, bsdf };

struct RenderSettings {
  int samples = 64;        // per pixel, >= 1
  int max_depth = 8;       // surface interactions of a path; 1 is direct light only
  int roulette_depth = 4;  // interactions before Russian roulette may end a path
  std::uint64_t seed = 0;
  Strategy strategy = Strategy::mis;
};

// An influence area declared by hand; `light` names a light or "camera".
struct PlaneAreaDeclaration {
  std::string light;
  DVec3 position{0};  // center of the face where rays start
  DVec3 direction{0, -1, 0};
  DVec2 size{1, 1};
  double depth = 1;
};
struct PointAreaDeclaration {
  std::string light;  // its position is the frustum's eye
  DVec3 forward{0, -1, 0};
  DVec2 fov{90, 90};  // full angles, degrees, in (0, 180)
  double near = 0;
  double far = 1;
};
using AreaDeclaration = std::variant<PlaneAreaDeclaration, PointAreaDeclaration>;

struct InfluenceSettings {
  bool derive = true;  // `auto`: derive areas from lights and camera
  std::vector<AreaDeclaration> declared;
};

struct AccelerationSettings {
  LocalConfig local;
  // Bytes of all structures that answer rays. The global BVH counts, but is built in any case.
  std::optional<std::uint64_t> memory;
};

}  // namespace pah
