// Compares influence areas with random rays of their bundles.
#include <algorithm>
#include <pah/influence/bundle_area.hpp>
#include <pah/influence/facing.hpp>

#include "catch.hpp"
#include "random_shapes.hpp"

using namespace pah;

namespace {

struct Segment {
  DVec3 origin, direction;
  double from, to;
};

// A random ray of the bundle, from its entry into the region to its exit.
Segment sample(const InfluenceArea& area, Shapes& shapes) {
  if (const auto* plane = std::get_if<PlaneArea>(&area)) {
    const Obb& b = plane->box;
    const DVec2 p = DVec2(b.half_size) * DVec2(shapes.uniform(), shapes.uniform());
    return {b.center + b.axes * DVec3(p, 0), b.axes[2], -b.half_size.z, b.half_size.z};
  }
  const auto& point = std::get<PointArea>(area);
  const Frustum& f = point.frustum;
  for (;;) {
    const DVec3 d(f.tan_half * DVec2(shapes.uniform(), shapes.uniform()), 1);
    // Solid angle is cos^3 times the plane's measure. Rejection uses no formula under test.
    if (point.measure == PointMeasure::solid_angle &&
        shapes.uniform(0, 1) > std::pow(glm::length(d), -3))
      continue;
    return {f.eye, f.axes * d, f.near, f.far};
  }
}

bool meets(const Segment& s, const Aabb& box) {
  double from = s.from;
  double to = s.to;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min[k] - s.origin[k]) / s.direction[k];
    const double b = (box.max[k] - s.origin[k]) / s.direction[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

double hit_share(const InfluenceArea& area, const Aabb& box, Shapes& shapes, int rays) {
  int hits = 0;
  for (int i = 0; i < rays; ++i) hits += meets(sample(area, shapes), box);
  return static_cast<double>(hits) / rays;
}

void compare_shares(unsigned seed, int areas, int rays) {
  Shapes shapes(seed);
  int compared = 0, clipped = 0, beyond = 0;
  double chi_squared = 0;
  while (compared < areas) {
    InfluenceArea area = PlaneArea{shapes.obb(1)};
    if (compared % 3 != 0)
      area = PointArea{shapes.frustum(1),
                       compared % 3 == 1 ? PointMeasure::plane : PointMeasure::solid_angle};
    Aabb box{Vec3(shapes.vector()), Vec3(shapes.vector())};
    if (compared % 2 == 0) {  // a small box on a ray
      const Segment s = sample(area, shapes);
      const DVec3 center = s.origin + glm::mix(s.from, s.to, shapes.uniform(0.5, 1)) * s.direction;
      box = {Vec3(center + 0.1 * shapes.vector()), Vec3(center + 0.1 * shapes.vector())};
    }
    box = {glm::min(box.min, box.max), glm::max(box.min, box.max)};
    const double p = hit_probability(area, box);
    if (p < 0.01 || p > 0.99) continue;
    ++compared;
    clipped += !contains(region_of(area), box);
    const double sigma = std::sqrt(p * (1 - p) / rays);
    const double z = (hit_share(area, box, shapes, rays) - p) / sigma;
    chi_squared += z * z;
    beyond += std::abs(z) > 4;
  }
  WARN(compared << " boxes, " << clipped << " clipped by their region, chi^2 / n "
                << chi_squared / compared);
  CHECK(beyond == 0);
  CHECK(std::abs(chi_squared / compared - 1) < 4 * std::sqrt(2.0 / compared));
  CHECK(clipped > compared / 4);
  CHECK(clipped < compared);
}

PointArea down(PointMeasure measure, double near = 0, double far = 10) {
  return make_point_area({0, 5, 0}, {0, -1, 0}, DVec2(std::acos(-1.0) / 2), near, far, measure);
}

}  // namespace

TEST_CASE("The hit probability is the fraction of the bundle's rays that meet the box") {
  compare_shares(1, 60, 100000);
}
TEST_CASE("The hit probability, many rays", "[full]") { compare_shares(2, 300, 1000000); }

TEST_CASE("A point area's probability depends on the place of its eye") {
  for (const PointMeasure measure : {PointMeasure::plane, PointMeasure::solid_angle}) {
    const InfluenceArea area = down(measure);
    CHECK(hit_probability(area, Aabb{{-1, 4, -1}, {1, 6, 1}}) == 1);     // inside
    CHECK(hit_probability(area, Aabb{{-1, 4, -1}, {1, 5, 1}}) == 1);     // on its face
    CHECK(hit_probability(area, Aabb{{0, 5, 0}, {1, 6, 1}}) == 1);       // on its corner
    CHECK(hit_probability(area, Aabb{{-1, 5.5F, -1}, {1, 6, 1}}) == 0);  // behind
    CHECK(hit_probability(area, Aabb{{2, 5.1F, 2}, {3, 6, 3}}) == 0);    // behind and to the side
    CHECK(hit_probability(area, Aabb{{-90, -90, -90}, {90, -6, 90}}) == 0);  // beyond the far face
    CHECK(hit_probability(area, Aabb{{-90, -90, -90}, {90, 4, 90}}) == Approx(1));
    CHECK(hit_probability(area, Aabb{}) == 0);
    // A box across the eye's plane: all directions with x > 0.25 z. The rest of the solid angle is
    // twice that of a rectangle with a corner on the axis, atan(ab / sqrt(1 + a^2 + b^2)).
    const double angle = 0.5 - 2 * std::atan(0.25 / std::sqrt(2.0625)) / cross_section(area);
    CHECK(hit_probability(area, Aabb{{0.5F, 3, -90}, {90, 90, 90}}) ==
          Approx(measure == PointMeasure::plane ? 0.375 : angle).epsilon(1e-12));
  }
  CHECK(hit_probability(down(PointMeasure::plane), Aabb{{-0.5F, 0, -0.5F}, {0.5F, 4, 0.5F}}) ==
        Approx(0.25));
  CHECK(projected_hull(down(PointMeasure::plane), Aabb{{-1, 4, -1}, {1, 6, 1}}).size() == 4);
  CHECK(projected_hull(down(PointMeasure::plane), Aabb{{-1, 6, -1}, {1, 7, 1}}).empty());
}

TEST_CASE("The two measures of a point area differ away from its axis") {
  const Aabb center{{-0.5F, 0, -0.5F}, {0.5F, 0.5F, 0.5F}};
  const Aabb corner{{4, 0, 4}, {5, 0.5F, 5}};
  const double plane = hit_probability(down(PointMeasure::plane), corner) /
                       hit_probability(down(PointMeasure::plane), center);
  const double angle = hit_probability(down(PointMeasure::solid_angle), corner) /
                       hit_probability(down(PointMeasure::solid_angle), center);
  CHECK(angle < 0.4 * plane);
  // Six faces of a cube make a sphere.
  CHECK(6 * cross_section(down(PointMeasure::solid_angle)) == Approx(4 * std::acos(-1.0)));
}

TEST_CASE("Scaling an area by a power of two changes no digit") {
  Shapes shapes(5);
  for (int i = 0; i < 2000; ++i) {
    PointArea point{shapes.frustum(1), PointMeasure::plane};
    PlaneArea plane{shapes.obb(1)};
    Aabb box = shapes.box(1);
    const double p = projected_area(point, box);
    const double q = projected_area(plane, box);
    const int k = shapes.integer(-20, 20);
    const double s = std::ldexp(1.0, k);
    point.frustum = {s * point.frustum.eye, point.frustum.axes, point.frustum.tan_half,
                     s * point.frustum.near, s * point.frustum.far};
    plane.box = {s * plane.box.center, plane.box.axes, s * plane.box.half_size};
    box = {static_cast<float>(s) * box.min, static_cast<float>(s) * box.max};
    REQUIRE(projected_area(point, box) == p);
    REQUIRE(projected_area(plane, box) == s * s * q);
  }
}

TEST_CASE("The mean absolute direction of an area is that of its rays") {
  const DVec3 down(0, -1, 0);
  const DVec3 sun =
      mean_absolute_direction(make_plane_area(DVec3(0), DVec3(3, 0, -4), DVec2(1), 1));
  CHECK(glm::distance(sun, DVec3(0.6, 0, 0.8)) < 1e-12);
  // A narrow area has that of its axis.
  const DVec3 narrow = mean_absolute_direction(make_point_area(DVec3(0), down, DVec2(0.01), 0, 1));
  CHECK(narrow.y == Approx(1).epsilon(1e-4));
  CHECK(narrow.x < 0.01);
  // A cube's face seen from the center: a sixth of all directions, over which |d| has a mean of 1/2
  // for each axis. With y the largest component and x and z equal: y + 2 x = 3/2.
  constexpr double right_angle = 1.5707963267948966;
  const DVec3 face =
      mean_absolute_direction(make_point_area(DVec3(0), down, DVec2(right_angle), 0, 1));
  CHECK(face.y + 2 * face.x == Approx(1.5).epsilon(1e-3));
  CHECK(face.x == Approx(face.z));
  CHECK(face.y > 0.7);
  // Uniform in the picture plane: more rays are far from the axis.
  const DVec3 plane = mean_absolute_direction(
      make_point_area(DVec3(0), down, DVec2(right_angle), 0, 1, PointMeasure::plane));
  CHECK(plane.y < face.y);
}

TEST_CASE("The projected area of a spread bundle is the mean over its directions") {
  Shapes shapes(6);
  std::vector<DVec3> directions;
  for (int i = 0; i < 1000; ++i) directions.push_back(shapes.vector() + DVec3(0.3, -1, 0));
  const ParallelBundleArea spread(mean_absolute_direction(directions));
  const Aabb box{{-1, 2, 3}, {4, 2.5F, 9}};
  double mean = 0;
  for (const DVec3& d : directions) {
    const PlaneArea wide = make_plane_area(-1000.0 * glm::normalize(d), d, DVec2(1000), 2000);
    mean += projected_area(wide, box) / 1000;
  }
  CHECK(spread(box) == Approx(mean));
  CHECK(spread(Aabb{}) == 0);
  // One direction: equals the thesis's sum of three parallelograms at one vertex.
  const DVec3 d = glm::normalize(DVec3(1, -2, 0.5));
  const DMat3 axes = orthonormal_basis(d);
  const auto project2 = [&](const DVec3& v) {
    return DVec2(glm::dot(axes[0], v), glm::dot(axes[1], v));
  };
  const DVec2 e[3] = {project2({5, 0, 0}), project2({0, 0.5, 0}), project2({0, 0, 6})};
  double parallelograms = 0;
  for (int k = 0; k < 3; ++k) {
    const DVec2 &u = e[k], &v = e[(k + 1) % 3];
    parallelograms += std::abs(u.x * v.y - u.y * v.x);
  }
  CHECK(ParallelBundleArea(glm::abs(d))(box) == Approx(parallelograms));
  const HitProbability probability(down(PointMeasure::plane));
  CHECK(probability(Aabb{{-0.5F, 0, -0.5F}, {0.5F, 4, 0.5F}}) == Approx(0.25));
}

TEST_CASE("Directions are affine within the tolerance, either way") {
  const InfluenceArea plane = make_plane_area({0, 5, 0}, {0, -1, 0}, {2, 2}, 10);
  const InfluenceArea point = down(PointMeasure::plane);
  Ray ray;
  ray.origin = {0, 1, 0};
  ray.direction = {0, 2, 0};
  CHECK(is_affine(plane, ray, 0));
  CHECK(is_affine(point, ray, 0));
  ray.direction = {0, -3, 0.03F};
  CHECK_FALSE(is_affine(plane, ray, 0));
  CHECK_FALSE(is_affine(plane, ray, 0.009));
  CHECK(is_affine(plane, ray, 0.011));
  CHECK(is_affine(point, ray, 0.011));
  ray.origin = {4, 1, 0};
  CHECK(is_affine(plane, ray, 0.011));
  CHECK_FALSE(is_affine(point, ray, 0.011));
  ray.direction = {-4, 4, 0};
  CHECK(is_affine(point, ray, 1e-9));
  ray.origin = {0, 5, 0};
  CHECK(is_affine(point, ray, 0));
  CHECK(ray_direction(point, {0, 5, 0}) == std::get<PointArea>(point).frustum.axes[2]);
}

TEST_CASE("Facing quality is large for planes along the rays") {
  const DVec3 v(0, -3, 1);
  const DVec3 quality = facing_quality(v);
  CHECK(quality == DVec3(1, 0.25, 0.75));
  CHECK(facing_axis_order(v) == std::array<int, 3>{0, 2, 1});
  CHECK(facing_axis_order({1, 1, 1}) == std::array<int, 3>{0, 1, 2});
  CHECK(facing_quality({0, 0, 0}) == DVec3(2.0 / 3));
  const InfluenceArea point = down(PointMeasure::plane);
  CHECK(facing_axis_order(mean_direction(point, Aabb{{3, 3.5F, 0}, {5, 4.5F, 0}}))[0] == 2);
  CHECK(mean_direction(make_plane_area({0, 5, 0}, {0, -2, 0}, {1, 1}, 1),
                       Aabb{{0, 0, 0}, {9, 9, 9}}) == DVec3(0, -1, 0));
}
