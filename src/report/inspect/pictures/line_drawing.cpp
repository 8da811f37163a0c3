#include "report/inspect/pictures/line_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/parallel_for.hpp"
#include "render/surface/seen_point.hpp"

namespace pah {
namespace {

constexpr float hidden_opacity = 0.25F;

struct End {
  Vec3 point;
  Vec4 place;  // CameraRays::project()
};
using Segment = std::array<End, 2>;

End between(const End& a, const End& b, float t) {
  return {glm::mix(a.point, b.point, t), glm::mix(a.place, b.place, t)};
}

// Clips a line to the part in front of the camera that is in the picture or within `margin` pixels
// of it: Liang and Barsky, "A New Concept and Method for Line Clipping" (1984), in homogeneous
// coordinates.
std::optional<Segment> clipped(const Segment& line, const Image& picture, float margin) {
  const float right = static_cast<float>(picture.width) + margin;
  const float bottom = static_cast<float>(picture.height) + margin;
  const auto room = [&](const Vec4& p) {
    return std::array{p.x + margin * p.w, right * p.w - p.x, p.y + margin * p.w, bottom * p.w - p.y,
                      p.z};
  };
  const auto a = room(line[0].place), b = room(line[1].place);
  float from = 0, to = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] < 0 && b[i] < 0) return std::nullopt;
    if (a[i] < 0) from = std::max(from, a[i] / (a[i] - b[i]));
    if (b[i] < 0) to = std::min(to, a[i] / (a[i] - b[i]));
  }
  if (from > to) return std::nullopt;
  Segment part{between(line[0], line[1], from), between(line[0], line[1], to)};
  // A line that ends in the eye appears as a point.
  for (const std::size_t i : {0U, 1U})
    if (!(part[i].place.w > 0)) part[i] = part[1 - i];
  if (!(part[0].place.w > 0)) return std::nullopt;
  return part;
}

class Drawing {
 public:
  Drawing(float width, float pixel_width, const std::vector<SeenPlane>& planes,
          const Image& picture)
      : reach_(width / 2 + 0.5F),
        most_(std::min(width, 1.0F)),
        pixel_width_(pixel_width),
        planes_(planes),
        width_(picture.width),
        height_(picture.height),
        opacity_(picture.pixels.size()) {}

  // The distance from the middle of a line, in pixels, beyond which it covers no part of a pixel.
  [[nodiscard]] float reach() const { return reach_; }
  [[nodiscard]] const std::vector<float>& opacity() const { return opacity_; }

  // Steps along the axis that the line is more parallel to.
  void add(const Segment& line) {
    const Vec2 from = place_of(line[0]), to = place_of(line[1]);
    const Vec2 way = to - from;
    const int major = std::abs(way.x) >= std::abs(way.y) ? 0 : 1, minor = 1 - major;
    const float slope = way[major] == 0 ? 0 : way[minor] / way[major];
    const float half_height = reach_ * std::sqrt(1 + slope * slope);
    const auto ends = std::minmax(from[major], to[major]);
    const auto [first, last] = pixels(ends.first - reach_, ends.second + reach_, major);
    for (int i = first; i <= last; ++i) {
      const float middle = from[minor] + slope * (static_cast<float>(i) + 0.5F - from[major]);
      const auto [low, high] = pixels(middle - half_height, middle + half_height, minor);
      for (int j = low; j <= high; ++j)
        add_pixel(major == 0 ? i : j, major == 0 ? j : i, from, way, line);
    }
  }

 private:
  // Clamps to the clipped range, because rounding errors near the eye are unbounded.
  [[nodiscard]] Vec2 place_of(const End& end) const {
    const Vec2 size(static_cast<float>(width_), static_cast<float>(height_));
    return glm::clamp(Vec2(end.place) / end.place.w, Vec2(-reach_), size + reach_);
  }

  // The first and last pixel along an axis between two coordinates.
  [[nodiscard]] std::pair<int, int> pixels(float from, float to, int axis) const {
    const int last = axis == 0 ? width_ - 1 : height_ - 1;
    return {std::max(static_cast<int>(std::floor(from)), 0),
            std::min(static_cast<int>(std::floor(to)), last)};
  }

  void add_pixel(int x, int y, const Vec2& from, const Vec2& way, const Segment& line) {
    const Vec2 center(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const float length2 = glm::dot(way, way);
    const float s =
        length2 == 0 ? 0 : std::clamp(glm::dot(center - from, way) / length2, 0.0F, 1.0F);
    const float coverage = std::clamp(reach_ - glm::distance(center, from + s * way), 0.0F, most_);
    // Interpolates along the line in space, not in the picture.
    const float far_weight = s * line[0].place.w, near_weight = (1 - s) * line[1].place.w;
    const End at = between(line[0], line[1], far_weight / (far_weight + near_weight));
    const std::size_t index = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                              static_cast<std::size_t>(x);
    const SeenPlane& plane = planes_[index];
    // Lines on a surface count as in front of it, because their position is known to a pixel only.
    const float slack = pixel_width_ * at.place.w;
    const bool hidden = glm::dot(plane.normal, at.point) < plane.offset - slack;
    opacity_[index] = std::max(opacity_[index], coverage * (hidden ? hidden_opacity : 1));
  }

  float reach_, most_, pixel_width_;
  const std::vector<SeenPlane>& planes_;
  int width_, height_;
  std::vector<float> opacity_;
};

}  // namespace

std::vector<SeenPlane> seen_planes(const World& world, const Accelerator& accelerator,
                                   const FilmSettings& film) {
  const CameraRays camera(world.camera, film);
  const auto width = static_cast<std::size_t>(film.width);
  const auto height = static_cast<std::size_t>(film.height);
  std::vector<SeenPlane> planes(width * height);
  parallel_for(height, 1, [&](std::size_t row) {
    for (int x = 0; x < film.width; ++x) {
      const Ray ray = camera.central(x, static_cast<int>(row));
      Hit hit;
      accelerator.closest_hit({&ray, 1}, {&hit, 1});
      if (!hit.valid()) continue;
      const SeenPoint seen = seen_point(world, ray, hit);
      planes[row * width + static_cast<std::size_t>(x)] = {
          seen.side, glm::dot(seen.side, seen.point.position)};
    }
  });
  return planes;
}

void draw_lines(const LineSet& lines, float width, const CameraRays& camera,
                const std::vector<SeenPlane>& planes, Image& picture) {
  Drawing drawing(width, camera.pixel_width(), planes, picture);
  const auto end = [&](std::uint32_t position) {
    const Vec3& point = lines.positions[position];
    return End{point, camera.project(point)};
  };
  for (const auto& [a, b] : lines.edges)
    if (const auto line = clipped({end(a), end(b)}, picture, drawing.reach())) drawing.add(*line);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = glm::mix(picture.pixels[i], lines.color, drawing.opacity()[i]);
}

}  // namespace pah
