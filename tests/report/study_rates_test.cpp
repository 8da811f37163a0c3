#include <algorithm>
#include <sstream>

#include "base/parallel_for.hpp"
#include "catch.hpp"
#include "report/study/rates/answers.hpp"
#include "report/study/rates/rates.hpp"
#include "report/study/stage.hpp"
#include "report/study/text/rate_summary.hpp"
#include "support/soups.hpp"

using namespace pah;

namespace {

StudyScene small_scene(bool with_area, double aperture_radius = 0) {
  const test::Soup soup = test::random_soup(300, 0.2F, Vec3{0}, 3);
  Mesh mesh;
  mesh.positions = soup.positions;
  mesh.triangles = soup.indices;
  Scene scene = make_stage();
  put_on_stage(scene, std::move(mesh));
  std::get<PerspectiveCamera>(scene.camera).aperture_radius = aperture_radius;
  if (with_area)
    scene.influence_areas.declared = {
        PlaneAreaDeclaration{"sun", {1.6, 4.2, 1.6}, {-1, -2, -1}, {3.6, 3.6}, 8}};
  StudyScene study;
  study.name = "a \"scene\"";
  study.world = make_world(scene);
  study.settings.film = scene.film;
  study.settings.render = scene.render;
  study.settings.influence_areas = scene.influence_areas;
  return study;
}

StudyConfig quick() {
  StudyConfig config;
  config.quick = true;
  return config;
}

RecordedRays rays_of(const StudyScene& scene, const Accelerator& accelerator) {
  return record_rays(scene.world, accelerator, scene.settings.film, scene.settings.render, 2000, 1);
}

bool counts(const RateRow& row) {
  return row.nodes_per_ray.has_value() && row.triangles_per_ray.has_value();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Misses every triangle with an even index, and reports no ray as occluded.
class Liar final : public Accelerator {
 public:
  explicit Liar(const Triangles& triangles) : truth_(make_global_bvh(triangles)) {}
  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* counts) const override {
    truth_->closest_hit(rays, hits, counts);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (hits[i].valid() && hits[i].triangle % 2 == 0) hits[i] = {};
  }
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* counts) const override {
    truth_->occluded(rays, results, counts);
    std::ranges::fill(results, std::uint8_t{0});
  }
  [[nodiscard]] AcceleratorMemory memory() const override { return {1, 2, 4}; }

 private:
  std::unique_ptr<Accelerator> truth_;
};

}  // namespace

TEST_CASE("Rates have a row a repetition, and accelerators of ours answer alike") {
  StudyResults results;
  results.rates = measure_rates({small_scene(true)}, quick());
  const std::size_t for_nearest = has_embree() ? 4 : 3;
  const std::size_t for_any = has_embree() ? 5 : 3;
  const std::size_t thread_counts = parallel_threads() > 1 ? 2 : 1;
  const std::size_t repetitions = 3;
  CHECK(results.rates.size() == (2 * for_nearest + 3 * for_any) * thread_counts * repetitions);
  for (const RateRow& row : results.rates) {
    CHECK(row.triangles == 302);
    CHECK(row.rays_per_second > 0);
    CHECK(row.batch > 1);
    CHECK(row.bytes > 0);
    if (row.accelerator.starts_with("embree")) {
      CHECK(!counts(row));
    } else {
      CHECK(counts(row));
      CHECK(row.mismatches == 0);
    }
  }
  // Accelerators take turns.
  CHECK(results.rates[0].accelerator == "bvh");
  CHECK(results.rates[1].accelerator == "local");
  CHECK(results.rates[2].accelerator == "light");
  CHECK(results.rates[for_nearest].accelerator == "bvh");
  CHECK(results.rates[for_nearest].repetition == 2);

  const std::vector<std::string> lines = lines_of(rays_csv(results));
  REQUIRE(lines.size() == 1 + results.rates.size());
  CHECK(lines[0] ==
        "scene,triangles,ray_kind,accelerator,batch,threads,repetition,rays_per_second,"
        "nodes_per_ray,triangles_per_ray,build_seconds,bytes,mismatches");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(lines[i].starts_with("\"a \"\"scene\"\"\",302,"));
    CHECK(std::ranges::count(lines[i], ',') == 12);
    CHECK((lines[i].find(",,,") != std::string::npos) == !counts(results.rates[i - 1]));
  }

  const std::string report = study_markdown(results, false);
  CHECK(report.find("## Rays a second") != std::string::npos);
  CHECK(report.find("| a \"scene\" | shadow any |") != std::string::npos);
  CHECK(report.find("| a \"scene\" | shadow to a point or sun |") != std::string::npos);
  CHECK(report.find("local / bvh") != std::string::npos);
  CHECK(report.find("light / bvh") != std::string::npos);
  CHECK((report.find("light / embree16") != std::string::npos) == has_embree());
  CHECK(report.find("**geometric mean of all**") != std::string::npos);
  CHECK(report.find("nan") == std::string::npos);
}

TEST_CASE("There is no rate of local BVHs where no area is built") {
  const std::vector<RateRow> rows = measure_rates({small_scene(false)}, quick());
  CHECK(std::ranges::find(rows, "local", &RateRow::accelerator) == rows.end());
}

TEST_CASE("There is no rate of grids where no light may have one") {
  StudyScene scene = small_scene(false);
  scene.world.lights = {{"sky", EnvironmentLight{}}};
  const std::vector<RateRow> rows = measure_rates({scene}, quick());
  CHECK(std::ranges::find(rows, "light", &RateRow::accelerator) == rows.end());
  CHECK(std::ranges::find(rows, "shadow to a point or sun", &RateRow::ray_kind) == rows.end());
  CHECK(std::ranges::find(rows, "shadow any", &RateRow::ray_kind) != rows.end());
}

TEST_CASE("Grids answer most shadow rays of a study to points and suns") {
  const std::vector<RateRow> rows = measure_rates({small_scene(false)}, quick());
  const auto row_of = [&](const std::string& kind, const std::string& accelerator) {
    return *std::ranges::find_if(rows, [&](const RateRow& row) {
      return row.ray_kind == kind && row.accelerator == accelerator;
    });
  };
  // A look-up of a cell counts as a node.
  CHECK(*row_of("shadow to a point or sun", "light").nodes_per_ray < 1.1);
  CHECK(*row_of("shadow to a point or sun", "bvh").nodes_per_ray > 2);
  CHECK(row_of("shadow any", "light").bytes > row_of("shadow any", "bvh").bytes);
  CHECK(row_of("bounce any", "light").nodes_per_ray == row_of("bounce any", "bvh").nodes_per_ray);
}

TEST_CASE("Wrong answers are counted as mismatches") {
  const StudyScene scene = small_scene(false);
  const Triangles triangles = scene.world.triangles();
  std::vector<NamedAccelerator> accelerators;
  accelerators.push_back({"bvh", make_global_bvh(triangles)});
  accelerators.push_back({"liar", std::make_unique<Liar>(triangles)});
  const Accelerator& bvh = *accelerators.front().accelerator;
  const RecordedRays rays = rays_of(scene, bvh);
  const Answers nearest = ask_all(bvh, RayQuery::nearest, rays.bounce);
  const Answers any = ask_all(bvh, RayQuery::any, rays.bounce);
  const auto unseen = static_cast<std::uint64_t>(std::ranges::count_if(
      nearest.hits, [](const Hit& hit) { return hit.valid() && hit.triangle % 2 == 0; }));
  const auto occluded = static_cast<std::uint64_t>(std::ranges::count(any.occluded, 1));
  REQUIRE(unseen > 0);
  REQUIRE(occluded > unseen);
  for (const RateRow& row : measure_rates("scene", triangles.size(), rays, accelerators, true)) {
    if (row.accelerator == "bvh") {
      CHECK(row.mismatches == 0);
      continue;
    }
    CHECK(row.bytes == 7);
    if (row.ray_kind == "bounce nearest") CHECK(row.mismatches == unseen);
    if (row.ray_kind == "bounce any") CHECK(row.mismatches == occluded);
  }
}

TEST_CASE("Another triangle is a mismatch unless it is as far away") {
  const auto mismatches = [](const Hit& a, const Hit& b) {
    return count_mismatches(RayQuery::nearest, {{a}, {}}, {{b}, {}});
  };
  const Hit hit{2, 0, 0, 7};
  CHECK(mismatches(hit, hit) == 0);
  CHECK(mismatches(hit, {2.000001F, 0, 0, 8}) == 0);
  CHECK(mismatches(hit, {2.1F, 0, 0, 8}) == 1);
  CHECK(mismatches(hit, {2.1F, 0, 0, 7}) == 0);
  CHECK(mismatches(hit, {}) == 1);
  CHECK(mismatches({}, {}) == 0);
}

TEST_CASE("Rays are recorded by their kind, also of a lens") {
  for (const double aperture_radius : {0.0, 0.1}) {
    const StudyScene scene = small_scene(false, aperture_radius);
    const auto bvh = make_global_bvh(scene.world.triangles());
    const RecordedRays rays = rays_of(scene, *bvh);
    const DVec3 eye = std::get<PerspectiveCamera>(scene.world.camera).position;
    // Of 12 tiles with 1024 rays each, as many are recorded as have 2000 rays.
    CHECK(rays.camera.ends.size() == 2);
    for (const Ray& ray : rays.camera.rays)
      CHECK(glm::distance(DVec3(ray.origin), eye) < aperture_radius + 1e-4);
    for (const Ray& ray : rays.bounce.rays) {
      CHECK(ray.bundle == no_bundle);
      CHECK(glm::distance(DVec3(ray.origin), eye) > 0.5);
    }
    CHECK(!rays.bounce.rays.empty());
    CHECK(!rays.shadow.rays.empty());
    for (const Ray& ray : rays.shadow.rays) CHECK(ray.bundle < scene.world.lights.size());
    // The same seed gives the same rays.
    const RecordedRays again = rays_of(scene, *bvh);
    CHECK(again.shadow.rays.size() == rays.shadow.rays.size());
    CHECK(again.shadow.rays.back().origin == rays.shadow.rays.back().origin);
  }
}

TEST_CASE("Shadow rays are recorded as grids take them: light by light, of exact bundles apart") {
  StudyScene scene = small_scene(false);
  scene.world.lights.insert(scene.world.lights.begin() + 1, {"sky", EnvironmentLight{}});
  const auto bvh = make_global_bvh(scene.world.triangles());
  const RecordedRays rays = rays_of(scene, *bvh);
  std::array<std::size_t, 3> of_light{}, of_exact_light{};
  for (std::size_t i = 0; i < rays.shadow.ends.size(); ++i)
    CHECK(std::ranges::is_sorted(rays.shadow.batch(i), {}, &Ray::bundle));
  for (const Ray& ray : rays.shadow.rays) ++of_light[ray.bundle];
  for (const Ray& ray : rays.shadow_to_point_or_sun.rays) ++of_exact_light[ray.bundle];
  for (std::size_t i = 0; i < rays.shadow_to_point_or_sun.ends.size(); ++i)
    CHECK(std::ranges::is_sorted(rays.shadow_to_point_or_sun.batch(i), {}, &Ray::bundle));
  CHECK(of_light[1] > 0);
  CHECK(of_exact_light[0] > 0);
  CHECK(of_exact_light[1] == 0);
  CHECK(of_exact_light[2] > 0);
}

TEST_CASE("Ratios are medians of the repetitions' own") {
  std::vector<RateRow> rows;
  const auto add = [&](const char* accelerator, unsigned repetition, double rate) {
    RateRow row;
    row.accelerator = accelerator;
    row.repetition = repetition;
    row.rays_per_second = rate;
    rows.push_back(row);
  };
  add("bvh", 1, 10), add("embree", 1, 20), add("bvh", 2, 30), add("embree", 2, 20);
  add("bvh", 3, 4), add("embree", 3, 1);
  CHECK(ratio_of(rows, {}, "bvh", "embree") == 1.5);
  CHECK(spread_of(rows, {}, "bvh").median == 10);
  CHECK(spread_of(rows, {}, "bvh").least == 4);
  CHECK(spread_of(rows, {}, "bvh").most == 30);
  CHECK(std::isnan(ratio_of(rows, {}, "local", "bvh")));
}
