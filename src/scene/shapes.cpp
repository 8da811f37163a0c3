#include <cmath>
#include <numbers>
#include <pah/scene/shapes.hpp>
#include <stdexcept>
#include <string>

namespace pah {
namespace {

// Squares of lengths outside this range would overflow or underflow as floats.
constexpr double min_length = 1e-18;
constexpr double max_length = 1e18;

void require_length(double value, const char* name) {
  if (!(value >= min_length && value <= max_length))
    throw std::invalid_argument(std::string(name) + " must be a positive length, 1e-18 to 1e18");
}

void require_count(int value, int low, int high, const char* name) {
  if (value < low || value > high)
    throw std::invalid_argument(std::string(name) + " must be in [" + std::to_string(low) + ", " +
                                std::to_string(high) + "]");
}

// Returns points of the unit circle in the xz plane, from +x towards -z. The last equals the first
// to the last bit, so that seams close.
std::vector<DVec3> circle(int segments) {
  std::vector<DVec3> points;
  points.reserve(static_cast<std::size_t>(segments) + 1);
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    points.emplace_back(std::cos(angle), 0, -std::sin(angle));
  }
  points.push_back(points.front());
  return points;
}

std::uint32_t add_vertex(Mesh& mesh, const DVec3& position, const DVec3& normal, const DVec2& uv) {
  mesh.positions.emplace_back(position);
  mesh.normals.emplace_back(normal);
  mesh.uvs.emplace_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// Adds columns x rows quads. Their (columns + 1) * (rows + 1) vertices start at `first` and run to
// the right, then up. If the lowest row of vertices is a point, its vertex i belongs to quad i
// alone; if the highest is, its vertex i + 1 does.
void add_grid(Mesh& mesh, std::uint32_t first, int columns, int rows, bool point_below = false,
              bool point_above = false) {
  const auto stride = static_cast<std::uint32_t>(columns) + 1;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a =
          first + static_cast<std::uint32_t>(row) * stride + static_cast<std::uint32_t>(column);
      const std::uint32_t d = a + stride;
      if (!(point_below && row == 0)) mesh.triangles.emplace_back(a, a + 1, d + 1);
      if (!(point_above && row == rows - 1)) mesh.triangles.emplace_back(a, d + 1, d);
    }
  }
}

// Adds a disk at height y whose normal is up * (0, 1, 0), up = 1 or -1.
void add_disk(Mesh& mesh, const std::vector<DVec3>& unit, double radius, double y, double up) {
  const DVec3 normal{0, up, 0};
  const std::uint32_t center = add_vertex(mesh, {0, y, 0}, normal, {0.5, 0.5});
  for (const DVec3& p : unit)
    add_vertex(mesh, {radius * p.x, y, radius * p.z}, normal,
               {0.5 + 0.5 * p.x, 0.5 - 0.5 * up * p.z});
  for (std::uint32_t i = 1; i < unit.size(); ++i) {
    if (up > 0)
      mesh.triangles.emplace_back(center, center + i, center + i + 1);
    else
      mesh.triangles.emplace_back(center, center + i + 1, center + i);
  }
}

Mesh make(const RectangleShape& shape) {
  require_length(shape.size.x, "size");
  require_length(shape.size.y, "size");
  Mesh mesh;
  for (const double v : {0.0, 1.0})
    for (const double u : {0.0, 1.0})
      add_vertex(mesh, {(u - 0.5) * shape.size.x, 0, (0.5 - v) * shape.size.y}, {0, 1, 0}, {u, v});
  add_grid(mesh, 0, 1, 1);
  return mesh;
}

Mesh make(const DiskShape& shape) {
  require_length(shape.radius, "radius");
  require_count(shape.segments, 3, 65536, "segments");
  Mesh mesh;
  add_disk(mesh, circle(shape.segments), shape.radius, 0, 1);
  return mesh;
}

Mesh make(const BoxShape& shape) {
  for (int k = 0; k < 3; ++k) require_length(shape.size[k], "size");
  Mesh mesh;
  // For each face, its normal and the directions of u and v, with u x v = normal.
  const DVec3 faces[6][3] = {
      {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
      {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
      {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}}};
  for (const auto& [normal, right, up] : faces) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const double v : {0.0, 1.0})
      for (const double u : {0.0, 1.0})
        add_vertex(mesh, 0.5 * shape.size * (normal + (2 * u - 1) * right + (2 * v - 1) * up),
                   normal, {u, v});
    add_grid(mesh, first, 1, 1);
  }
  return mesh;
}

Mesh make(const SphereShape& shape) {
  require_length(shape.radius, "radius");
  require_count(shape.segments, 3, 8192, "segments");
  require_count(shape.rings, 2, 8192, "rings");
  const std::vector<DVec3> unit = circle(shape.segments);
  Mesh mesh;
  for (int row = 0; row <= shape.rings; ++row) {
    const bool pole = row == 0 || row == shape.rings;
    const double angle = std::numbers::pi * row / shape.rings;
    const double ring = pole ? 0 : std::sin(angle);
    // A vertex at a pole belongs to one quad and has the u of that quad's middle.
    const double shift = row == 0 ? 0.5 : pole ? -0.5 : 0;
    for (int i = 0; i <= shape.segments; ++i) {
      const DVec3 normal = ring * unit[static_cast<std::size_t>(i)] - DVec3{0, std::cos(angle), 0};
      add_vertex(mesh, shape.radius * normal, normal,
                 {(i + shift) / shape.segments, static_cast<double>(row) / shape.rings});
    }
  }
  add_grid(mesh, 0, shape.segments, shape.rings, true, true);
  return mesh;
}

Mesh make(const CylinderShape& shape) {
  require_length(shape.radius, "radius");
  require_length(shape.height, "height");
  require_count(shape.segments, 3, 65536, "segments");
  const std::vector<DVec3> unit = circle(shape.segments);
  Mesh mesh;
  for (const double v : {0.0, 1.0})
    for (int i = 0; i <= shape.segments; ++i) {
      const DVec3& normal = unit[static_cast<std::size_t>(i)];
      add_vertex(mesh, shape.radius * normal + DVec3{0, (v - 0.5) * shape.height, 0}, normal,
                 {static_cast<double>(i) / shape.segments, v});
    }
  add_grid(mesh, 0, shape.segments, 1);
  if (shape.capped) {
    add_disk(mesh, unit, shape.radius, 0.5 * shape.height, 1);
    add_disk(mesh, unit, shape.radius, -0.5 * shape.height, -1);
  }
  return mesh;
}

Mesh make(const ConeShape& shape) {
  require_length(shape.radius, "radius");
  require_length(shape.height, "height");
  require_count(shape.segments, 3, 65536, "segments");
  const std::vector<DVec3> unit = circle(shape.segments);
  const double slant = std::hypot(shape.radius, shape.height);
  const auto normal_along = [&](const DVec3& out) {
    return (shape.height * out + DVec3{0, shape.radius, 0}) / slant;
  };
  Mesh mesh;
  for (int i = 0; i <= shape.segments; ++i) {
    const DVec3& out = unit[static_cast<std::size_t>(i)];
    add_vertex(mesh, shape.radius * out - DVec3{0, 0.5 * shape.height, 0}, normal_along(out),
               {static_cast<double>(i) / shape.segments, 0});
  }
  // Each segment has an apex of its own, with the normal of the segment's middle.
  for (int i = 0; i <= shape.segments; ++i) {
    const double middle = 2 * std::numbers::pi * (i - 0.5) / shape.segments;
    add_vertex(mesh, {0, 0.5 * shape.height, 0},
               normal_along({std::cos(middle), 0, -std::sin(middle)}),
               {(i - 0.5) / shape.segments, 1});
  }
  add_grid(mesh, 0, shape.segments, 1, false, true);
  if (shape.capped) add_disk(mesh, unit, shape.radius, -0.5 * shape.height, -1);
  return mesh;
}

Mesh make(const TorusShape& shape) {
  require_length(shape.radius, "radius");
  require_length(shape.tube_radius, "tube_radius");
  if (shape.tube_radius >= shape.radius)
    throw std::invalid_argument("tube_radius must be less than radius");
  require_count(shape.segments, 3, 8192, "segments");
  require_count(shape.tube_segments, 3, 8192, "tube_segments");
  const std::vector<DVec3> around = circle(shape.segments);
  const std::vector<DVec3> tube = circle(shape.tube_segments);
  Mesh mesh;
  for (int row = 0; row <= shape.tube_segments; ++row) {
    const DVec3& t = tube[static_cast<std::size_t>(row)];
    for (int i = 0; i <= shape.segments; ++i) {
      const DVec3& out = around[static_cast<std::size_t>(i)];
      const DVec3 normal = t.x * out - DVec3{0, t.z, 0};
      add_vertex(mesh, shape.radius * out + shape.tube_radius * normal, normal,
                 {static_cast<double>(i) / shape.segments,
                  static_cast<double>(row) / shape.tube_segments});
    }
  }
  add_grid(mesh, 0, shape.segments, shape.tube_segments);
  return mesh;
}

void require_heights(const HeightFieldShape& shape) {
  require_length(shape.size.x, "size");
  require_length(shape.size.y, "size");
  if (!(std::abs(shape.height) <= max_length))
    throw std::invalid_argument("height must be in [-1e18, 1e18]");
  if (shape.columns < 2 || shape.rows < 2)
    throw std::invalid_argument("a height field needs at least 2 x 2 heights");
  const std::uint64_t count =
      static_cast<std::uint64_t>(shape.columns) * static_cast<std::uint64_t>(shape.rows);
  if (count > (1ULL << 31)) throw std::invalid_argument("a height field has at most 2^31 heights");
  if (shape.heights.size() != count)
    throw std::invalid_argument("a height field needs columns * rows heights");
  for (const float h : shape.heights)
    if (!(std::abs(h * shape.height) <= max_length))
      throw std::invalid_argument("a height is not finite, or beyond 1e18");
}

Mesh make(const HeightFieldShape& shape) {
  require_heights(shape);
  const auto columns = static_cast<std::size_t>(shape.columns);
  const auto rows = static_cast<std::size_t>(shape.rows);
  const auto height = [&](std::size_t x, std::size_t z) {
    return shape.height * shape.heights[z * columns + x];
  };
  const DVec2 step = shape.size / DVec2(columns - 1, rows - 1);
  Mesh mesh;
  mesh.positions.reserve(columns * rows);
  mesh.normals.reserve(columns * rows);
  mesh.uvs.reserve(columns * rows);
  mesh.triangles.reserve(2 * (columns - 1) * (rows - 1));
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t z = rows - 1 - row;  // the grid's rows run towards -z
    const double v = static_cast<double>(row) / static_cast<double>(rows - 1);
    for (std::size_t x = 0; x < columns; ++x) {
      const double u = static_cast<double>(x) / static_cast<double>(columns - 1);
      // Slopes are central differences, one-sided at the border.
      const std::size_t x0 = x > 0 ? x - 1 : x;
      const std::size_t x1 = x + 1 < columns ? x + 1 : x;
      const std::size_t z0 = z > 0 ? z - 1 : z;
      const std::size_t z1 = z + 1 < rows ? z + 1 : z;
      const double slope_x =
          (height(x1, z) - height(x0, z)) / (static_cast<double>(x1 - x0) * step.x);
      const double slope_z =
          (height(x, z1) - height(x, z0)) / (static_cast<double>(z1 - z0) * step.y);
      add_vertex(mesh, {(u - 0.5) * shape.size.x, height(x, z), (0.5 - v) * shape.size.y},
                 glm::normalize(DVec3{-slope_x, 1, -slope_z}), {u, v});
    }
  }
  add_grid(mesh, 0, shape.columns - 1, shape.rows - 1);
  return mesh;
}

}  // namespace

Mesh make_mesh(const Shape& shape) {
  return std::visit([](const auto& s) { return make(s); }, shape);
}

}  // namespace pah
