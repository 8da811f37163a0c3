// Compares outlines, projected areas and overlap areas with exact arithmetic.
#include <algorithm>

#include "catch.hpp"
#include "exact.hpp"
#include "random_shapes.hpp"

using namespace pah;

namespace {

std::vector<BoxSector> all_sectors() {
  std::vector<BoxSector> sectors;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0) sectors.push_back({x, y, z});
  return sectors;
}

PointMeasure some_measure(Shapes& shapes) {
  return shapes.integer(0, 1) == 0 ? PointMeasure::plane : PointMeasure::solid_angle;
}

// Mutually orthogonal integer vectors. The last leads into the opposite sector.
DMat3 integer_axes(Shapes& shapes, BoxSector sector) {
  const DVec3 forward(-sector.x * shapes.integer(1, 1000), -sector.y * shapes.integer(1, 1000),
                      -sector.z * shapes.integer(1, 1000));
  DVec3 right(0);
  do {
    right = glm::cross(forward,
                       DVec3(shapes.integer(-9, 9), shapes.integer(-9, 9), shapes.integer(-9, 9)));
  } while (right == DVec3(0));
  return {right, glm::cross(forward, right), forward};
}

void compare_outlines(unsigned seed, int count) {
  Shapes shapes(seed);
  for (int i = 0; i < count; ++i)
    for (const BoxSector sector : all_sectors()) {
      const double scale = shapes.scale();
      Aabb box = shapes.box(scale);
      const PlaneArea parallel{Obb{DVec3(box.min), integer_axes(shapes, sector), DVec3(1)}};
      REQUIRE(sector_of_direction(parallel.box.axes[2]) == sector);
      REQUIRE(exact_answer::is_projected_hull(parallel, box, outline_from(sector).span()));

      // An eye in this sector, sometimes on the plane of a face.
      DVec3 eye(0), forward(0);
      for (int k = 0; k < 3; ++k) {
        const double t = shapes.integer(0, 2) == 0 ? shapes.integer(0, 1) : shapes.uniform(0, 1);
        const double inside =
            std::clamp<double>(glm::mix<double>(box.min[k], box.max[k], t), box.min[k], box.max[k]);
        const double away = scale * std::pow(10.0, shapes.uniform(-3, 1));
        eye[k] = sector[k] == 0 ? inside : (sector[k] > 0 ? box.max[k] + away : box.min[k] - away);
        forward[k] = sector[k] == 0 ? 0 : -sector[k];
      }
      const PointArea point{Frustum{eye, orthonormal_basis(forward), DVec2(1), 0, scale}};
      REQUIRE(sector_of_eye(eye, box) == sector);
      REQUIRE(exact_answer::is_projected_hull(point, box, outline_from(sector).span()));
    }
}

struct Error {
  double worst = 0;
  int compared = 0, empty = 0;

  // A relative error, except for boxes seen edge-on, whose area is rounding alone.
  void add(double ours, double truth, double section) {
    REQUIRE(std::abs(ours - truth) <= 1e-9 * truth + 1e-15 * section);
    if (truth < 1e-13 * section) {
      ++empty;
      return;
    }
    ++compared;
    worst = std::max(worst, std::abs(ours - truth) / truth);
  }
};

// Areas and boxes in all critical positions: across the eye's plane, the near and far faces and the
// sides, around the region, behind it, and with the eye inside or on a face.
struct Scene {
  InfluenceArea area;
  Aabb box;
};
Scene random_scene(Shapes& shapes) {
  if (shapes.integer(0, 3) == 0) {
    if (shapes.integer(0, 1) == 0) return {PlaneArea{shapes.grid_obb(1)}, shapes.grid_box()};
    return {PointArea{shapes.grid_frustum(), some_measure(shapes)}, shapes.grid_box()};
  }
  const double scale = shapes.scale();
  const Aabb box = shapes.box(scale);
  if (shapes.integer(0, 1) == 0) {
    return {PlaneArea{shapes.obb(scale)}, box};
  }
  PointArea area{shapes.frustum(scale), some_measure(shapes)};
  DVec3& eye = area.frustum.eye;
  switch (shapes.integer(0, 5)) {
    case 0:  // on a face
      eye = glm::mix(DVec3(box.min), DVec3(box.max), glm::abs(shapes.vector()));
      eye.y = box.max.y;
      break;
    case 1:  // near to a face
      eye = glm::mix(DVec3(box.min), DVec3(box.max), glm::abs(shapes.vector()));
      eye.x = box.max.x + scale * std::pow(10.0, shapes.uniform(-4, 0));
      break;
    case 2:  // on the plane of a face
      eye.z = box.min.z;
      break;
    default:
      break;
  }
  return {area, box};
}

void compare_areas(unsigned seed, int count) {
  Shapes shapes(seed);
  Error parallel, point, hull;
  for (int i = 0; i < count; ++i) {
    const auto [area, box] = random_scene(shapes);
    const double truth = exact_answer::projected_area(area, box);
    const double ours = projected_area(area, box);
    const double section = cross_section(area);
    const bool is_point = std::holds_alternative<PointArea>(area);
    INFO("ours " << ours << " truth " << truth << " section " << section);
    REQUIRE(ours >= 0);
    REQUIRE(ours <= section);
    (is_point ? point : parallel).add(ours, truth, section);
    const bool flat = !is_point || std::get<PointArea>(area).measure == PointMeasure::plane;
    if (flat) {
      const double by_hull = pah::area(projected_hull(area, box));
      hull.add(by_hull, truth, section);
    }
  }
  const auto report = [](const char* name, const Error& e) {
    WARN(name << ": worst relative error " << e.worst << " of " << e.compared << ", " << e.empty
              << " not met");
    CHECK(e.compared > 100);
    CHECK(e.empty > 10);
  };
  report("parallel", parallel);
  report("point", point);
  report("by hull", hull);
}

void compare_children(unsigned seed, int count) {
  Shapes shapes(seed);
  int met = 0;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const auto [area, whole] = random_scene(shapes);
    const Aabb& parent = whole;  // Clang before 16 cannot capture a structured binding
    Aabb child = parent;
    for (int k = 0; k < 3; ++k) {
      const auto within = [&] {
        const float t = static_cast<float>(shapes.uniform(0, 1));
        return std::clamp(parent.min[k] + t * (parent.max[k] - parent.min[k]), parent.min[k],
                          parent.max[k]);
      };
      if (shapes.integer(0, 2) == 0) child.max[k] = within();
      if (shapes.integer(0, 2) == 0) child.min[k] = std::min(within(), child.max[k]);
    }
    const double outer = projected_area(area, parent);
    const double inner = projected_area(area, child);
    INFO("child " << inner << " parent " << outer);
    // The area of a flat box seen edge-on is rounding alone.
    const double nothing = 1e-16 * cross_section(area);
    REQUIRE(inner <= outer * (1 + 1e-12) + nothing);
    if (outer < 1e3 * nothing) continue;
    ++met;
    worst = std::max(worst, inner / outer - 1);
  }
  WARN("a child exceeds its parent by " << worst << " at most, of " << met);
  CHECK(met > count / 5);
}

ConvexPolygon random_polygon(Shapes& shapes, double scale) {
  std::vector<DVec2> points;
  const DVec2 center = scale * DVec2(shapes.vector());
  const DVec2 size =
      scale * DVec2(std::pow(10.0, shapes.uniform(-2, 0)), std::pow(10.0, shapes.uniform(-2, 0)));
  const int n = shapes.integer(3, 10);
  for (int i = 0; i < n; ++i) points.push_back(center + size * DVec2(shapes.vector()));
  return convex_hull(points);
}
ConvexPolygon grid_polygon(Shapes& shapes) {
  std::vector<DVec2> points;
  const int n = shapes.integer(1, 7);
  for (int i = 0; i < n; ++i) points.emplace_back(shapes.integer(-3, 3), shapes.integer(-3, 3));
  return convex_hull(points);
}

void compare_polygons(unsigned seed, int count) {
  Shapes shapes(seed);
  double worst = 0;
  int overlapping = 0, disjoint = 0;
  for (int i = 0; i < count; ++i) {
    const double scale = shapes.scale();
    const bool grid = i % 2 == 0;
    ConvexPolygon a = grid ? grid_polygon(shapes) : random_polygon(shapes, scale);
    ConvexPolygon b = grid ? grid_polygon(shapes) : random_polygon(shapes, scale);
    const int kind = shapes.integer(0, 9);
    switch (kind) {
      case 0:
        b = a;
        break;
      case 1:  // touching along an edge, or shifted along one
        b = a;
        if (a.size() > 1) {
          const DVec2 along = shapes.integer(-2, 2) * 0.5 * (a[1] - a[0]);
          for (DVec2& p : b) p += along;
        }
        break;
      case 2:  // repeated vertices
        if (!a.empty()) a.insert(a.begin(), 2, a[0]);
        break;
      case 3:  // contained
        b = a;
        for (DVec2& p : b) p = 0.5 * (p + a[0]);
        break;
      case 4:  // a sliver
        for (DVec2& p : a) p.y = b.empty() ? 0 : b[0].y + 1e-3 * (p.y - b[0].y);
        a = convex_hull(a);
        break;
      default:
        break;
    }
    const double ours = overlap_area(a, b);
    const double truth = exact_answer::overlap_area(a, b);
    const double smaller = std::min(area(a), area(b));
    REQUIRE(ours == overlap_area(b, a));
    REQUIRE(ours <= smaller);
    INFO("ours " << ours << " truth " << truth << " smaller " << smaller);
    REQUIRE(std::abs(ours - truth) <= 1e-9 * smaller);
    // Rounding of the input is 1e-16 of a sliver's length, and a larger part of its width.
    if (kind != 4 && truth > 1e-6 * smaller) REQUIRE(std::abs(ours - truth) <= 1e-9 * truth);
    if (smaller > 0) worst = std::max(worst, std::abs(ours - truth) / smaller);
    ++(truth > 0 ? overlapping : disjoint);
    REQUIRE(std::abs(area(a) - exact_answer::area(a)) <= 1e-9 * exact_answer::area(a));
  }
  WARN("overlap: worst error " << worst << " of the smaller polygon, " << overlapping
                               << " overlapping, " << disjoint << " not");
  CHECK(overlapping > count / 5);
  CHECK(disjoint > count / 20);
}

void compare_hulls(unsigned seed, int count) {
  Shapes shapes(seed);
  int on_boundary = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<DVec2> points;
    const int n = shapes.integer(1, 12);
    const double scale = shapes.scale();
    for (int k = 0; k < n; ++k)
      points.push_back(i % 2 == 0 ? DVec2(shapes.integer(-2, 2), shapes.integer(-2, 2))
                                  : 1e3 * scale + scale * DVec2(shapes.vector()));
    const ConvexPolygon hull = convex_hull(points);
    REQUIRE(hull == exact_answer::convex_hull(points));
    if (hull.size() < 3) continue;
    const DVec2 p = i % 2 == 0 ? DVec2(shapes.integer(-4, 4), shapes.integer(-4, 4)) * 0.5
                               : glm::mix(hull[0], hull[1], shapes.uniform(0, 1));
    REQUIRE(contains(hull, p) == exact_answer::contains(hull, p));
    on_boundary += contains(hull, p);
  }
  CHECK(on_boundary > count / 20);
}

}  // namespace

TEST_CASE("The outline of a box is its convex hull in all 26 sectors") { compare_outlines(1, 60); }
TEST_CASE("The outline of a box, many times", "[full]") { compare_outlines(2, 40000); }

TEST_CASE("Projected areas agree with exact arithmetic") { compare_areas(3, 4000); }
TEST_CASE("Projected areas, many times", "[full]") { compare_areas(4, 1000000); }

TEST_CASE("A child's projected area does not exceed its parent's") { compare_children(5, 100000); }
TEST_CASE("A child's projected area, many times", "[full]") { compare_children(6, 10000000); }

TEST_CASE("Overlap areas agree with exact arithmetic") { compare_polygons(7, 4000); }
TEST_CASE("Overlap areas, many times", "[full]") { compare_polygons(8, 1000000); }

TEST_CASE("Hulls and containment in polygons agree with exact arithmetic") {
  compare_hulls(9, 20000);
}
