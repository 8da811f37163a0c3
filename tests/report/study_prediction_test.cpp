#include <array>
#include <cmath>
#include <pah/accel/accelerator.hpp>
#include <pah/influence/box_sectors.hpp>

#include "catch.hpp"
#include "report/study/areas.hpp"
#include "report/study/local.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

StudyMesh mesh_of(const test::Soup& soup) { return {soup.name, soup.positions, soup.indices}; }

// The twelve triangles of an axis-aligned box.
StudyMesh box_mesh(const Vec3& low, const Vec3& high) {
  StudyMesh mesh{"box", {}, {}};
  const Aabb box{low, high};
  for (unsigned i = 0; i < 8; ++i) mesh.positions.emplace_back(box.corner(i));
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : faces) {
    mesh.indices.emplace_back(a, b, c);
    mesh.indices.emplace_back(a, c, d);
  }
  return mesh;
}

}  // namespace

TEST_CASE("The cost of one leaf is known, and predicted exactly") {
  const StudyMesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  const Aabb bounds = bounds_of(mesh.triangles());
  const StudyArea area{"plane", StudyGroup::plane_axis,
                       make_plane_area({0, 5, 0}, {0, -1, 0}, {4, 4}, 10)};
  StudySite site = make_site(mesh, area, 20'000, 1);
  REQUIRE(site.subset.size() == 12);
  BinaryTree leaf;
  leaf.nodes.push_back({bounds, 0, 12});
  for (std::uint32_t i = 0; i < 12; ++i) leaf.order.push_back(i);
  const BuildConfig config;
  for (const Tally& tally : {count_all(site.on(leaf, config), site.rays),
                             count_closest(site.on(leaf, config), site.rays)}) {
    CHECK(tally.rays == 20'000);
    CHECK(tally.mean() == Approx(3 * double{triangle_cost}));
    // A quarter of the rays meet it, within five standard deviations.
    CHECK(std::abs(static_cast<double>(tally.met) / 20'000 - 0.25) < 5 * std::sqrt(0.1875 / 2e4));
  }
  CHECK(count_closest(site.on(leaf, config), site.rays).hits ==
        count_all(site.on(leaf, config), site.rays).met);
}

TEST_CASE("PAH predicts what rays cost, within four standard errors") {
  const StudyMesh box = box_mesh({-1, -0.5F, -2}, {1.5F, 1, 1});
  for (const StudyMesh& mesh :
       {box, mesh_of(test::random_soup(500, 0.2F, Vec3{0}, 3)), mesh_of(test::grid(12, 3.0F, 6))}) {
    CAPTURE(mesh.name);
    const Aabb bounds = bounds_of(mesh.triangles());
    for (const StudyArea& area : study_areas(bounds, false)) {
      CAPTURE(area.name);
      StudyResults results;
      study_prediction(make_site(mesh, area, 20'000, 5), results);
      for (const PredictionRow& row : results.predictions) {
        CAPTURE(row.measured, row.pah, row.standard_error);
        // Areas are rounded to float before they are summed.
        CHECK(std::abs(row.pah - row.measured) < 4 * row.standard_error + 1e-4 * row.measured);
        CHECK(row.closest <= row.measured * (1 + 1e-4));
        if (!is_point(area.group)) CHECK(row.pah_plane == row.pah);
      }
    }
  }
}

// The thesis's 5.4.2 measures in the picture plane only.
TEST_CASE("Solid angle predicts what an isotropic light's rays cost, the picture plane does not") {
  // Most of the mesh is near the axis, where such rays are dense, and little is in the corners.
  test::Soup soup = test::random_soup(300, 0.2F, Vec3{0}, 3);
  for (const float x : {-4.5F, 4.5F})
    for (const float z : {-4.5F, 4.5F}) soup.add({x, 0, z}, {x + 0.1F, 0, z}, {x, 0, z + 0.1F});
  const StudyArea area{
      "wide", StudyGroup::point_outside,
      make_point_area({0, 5, 0}, {0, -1, 0}, DVec2(std::acos(0.0)), /*near=*/0, /*far=*/7)};
  StudyResults results;
  study_prediction(make_site(mesh_of(soup), area, 20'000, 5), results);
  REQUIRE_FALSE(results.predictions.empty());
  for (const PredictionRow& row : results.predictions) {
    CAPTURE(row.measured, row.pah, row.pah_plane, row.standard_error);
    CHECK(std::abs(row.pah - row.measured) < 4 * row.standard_error + 1e-4 * row.measured);
    CHECK(row.pah_plane < row.measured - 10 * row.standard_error);
  }
}

TEST_CASE("Rays are uniform in the measure of their area") {
  const DVec2 fov(2.2, 1.4);
  for (const PointMeasure measure : {PointMeasure::solid_angle, PointMeasure::plane}) {
    const InfluenceArea area = make_point_area({0, 0, 0}, {1, 2, 3}, fov, 0, 10, measure);
    const auto rays = draw_rays(area, 20'000, 3);
    const Aabb box{{1, 2, 2}, {2, 2.5F, 4}};
    const StudyMesh mesh = box_mesh(box.min, box.max);
    BinaryTree leaf;
    leaf.nodes.push_back({box, 0, 12});
    const StudyTree tree{leaf, mesh.triangles(), {}, 4};
    const double p = hit_probability(area, box);
    REQUIRE(p > 0.01);
    const double share = static_cast<double>(count_all(tree, rays).met) / 20'000;
    CHECK(std::abs(share - p) < 4 * std::sqrt(p * (1 - p) / 20'000));
  }
}

TEST_CASE("The study's searches find what the renderer finds") {
  const StudyMesh mesh = mesh_of(test::random_soup(2000, 0.1F, Vec3{0}, 3));
  const Aabb bounds = bounds_of(mesh.triangles());
  for (const StudyArea& area : study_areas(bounds, false)) {
    CAPTURE(area.name);
    const StudySite site = make_site(mesh, area, 2'000, 7);
    const LocalConfig config;
    const BuiltBvh built = build_local(site, config);
    std::vector<Ray> rays;
    for (const BundleRay& ray : site.rays) rays.push_back(ray_of(ray));
    std::vector<Hit> hits(rays.size());
    make_brute_force(mesh.triangles())->closest_hit(rays, hits, nullptr);
    std::uint64_t expected = 0;
    for (const Hit& hit : hits) expected += hit.valid() ? 1 : 0;
    CHECK(count_closest(site.on(built.tree, config.build), site.rays).hits == expected);
    CHECK(kernel_cost(built.bvh, site.rays, 4) > 0);
  }
}
