// Tests samplers of lights against their densities, and the choice among many lights.
#include <algorithm>
#include <functional>
#include <random>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "chi_square.hpp"
#include "render/light/lights.hpp"
#include "render/sampling/spherical_triangle.hpp"

using namespace pah;
using namespace pah::test;

namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float next() { return static_cast<float>(engine_() >> 8U) * 0x1p-24F; }
  Vec2 next_2d() {
    const float x = next();
    return {x, next()};
  }

 private:
  std::mt19937 engine_;
};

// Five runs pass together at 1 % (Sidak).
const double sidak = 1 - std::pow(1 - 0.01, 1.0 / 5);

}  // namespace

TEST_CASE("Spherical triangles are sampled uniformly in solid angle") {
  const std::array<Triangle, 5> triangles{
      Triangle{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      Triangle{{-0.4F, 0.05F, -0.7F}, {0.6F, 0.05F, -0.7F}, {-0.4F, 0.05F, 1.3F}},
      Triangle{{3, 10, 2}, {3.5F, 10, 2}, {3, 10.3F, 2.2F}},
      Triangle{{5, 1, 0}, {5, 1.01F, 0}, {5, 1, 4}},
      Triangle{{0.1F, 1, 0}, {-40, 1, 1}, {35, 0.5F, -30}}};
  Random random(1);
  for (const Triangle& t : triangles) {
    const SphericalTriangle seen(t, Vec3(0));
    const double omega = seen.solid_angle();
    REQUIRE(seen.sampled_by_solid_angle());
    // The cells come from splitting the triangle into four parts, four times. The solid angle of
    // each
    // cell is exact.
    constexpr int levels = 4;
    std::vector<double> counts(256), expected(256);
    const auto child = [](const std::array<DVec3, 3>& p, int i) -> std::array<DVec3, 3> {
      const DVec3 ab = (p[0] + p[1]) / 2.0, bc = (p[1] + p[2]) / 2.0, ca = (p[2] + p[0]) / 2.0;
      switch (i) {
        case 0:
          return {p[0], ab, ca};
        case 1:
          return {ab, p[1], bc};
        case 2:
          return {ca, bc, p[2]};
        default:
          return {bc, ca, ab};
      }
    };
    const int n = 200000;
    for (int cell = 0; cell < 256; ++cell) {
      std::array<DVec3, 3> p{DVec3(t.a), DVec3(t.b), DVec3(t.c)};
      for (int level = 0; level < levels; ++level)
        p = child(p, (cell >> (2 * (levels - 1 - level))) & 3);
      expected[static_cast<std::size_t>(cell)] =
          n * SphericalTriangle({Vec3(p[0]), Vec3(p[1]), Vec3(p[2])}, Vec3(0)).solid_angle() /
          omega;
    }
    for (int i = 0; i < n; ++i) {
      const Vec2 b = seen.sample(random.next_2d());
      double b0 = 1.0 - b.x - b.y, b1 = b.x, b2 = b.y;
      int cell = 0;
      for (int level = 0; level < levels; ++level) {
        b0 *= 2, b1 *= 2, b2 *= 2;
        int which = 3;
        if (b0 >= 1) {
          which = 0, b0 -= 1;
        } else if (b1 >= 1) {
          which = 1, b1 -= 1;
        } else if (b2 >= 1) {
          which = 2, b2 -= 1;
        } else {
          b0 = 1 - b0, b1 = 1 - b1, b2 = 1 - b2;
        }
        cell = 4 * cell + which;
      }
      ++counts[static_cast<std::size_t>(cell)];
    }
    INFO("omega " << omega);
    CHECK(test::goodness_of_fit(counts, expected).p > sidak);
  }
}

TEST_CASE("An environment picture is sampled by its density, which integrates to 1") {
  Random random(2);
  constexpr int w = 12, h = 7;
  std::vector<float> brightness(w * h);
  for (float& b : brightness) b = random.next() < 0.4F ? 0 : 10 * random.next() * random.next();
  const LatLongDistribution distribution(brightness, w, h);
  // Cells finer than texels, over each of which the density per texture coordinate is constant.
  constexpr int columns = 3 * w, rows = 3 * h, n = 200000;
  std::vector<double> counts(columns * rows), expected(columns * rows);
  double integral = 0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = (column + 0.5) / columns, v = (row + 0.5) / rows;
      const double pdf = static_cast<double>(distribution.pdf(
          direction_from_lat_long({static_cast<float>(u), static_cast<float>(v)})));
      const double mass = pdf * 2 * pi * pi * std::sin(pi * v) / (columns * rows);
      integral += mass;
      expected[static_cast<std::size_t>(row * columns + column)] = n * mass;
    }
  }
  CHECK(integral == Approx(1).epsilon(1e-5));
  for (int i = 0; i < n; ++i) {
    const auto s = distribution.sample(random.next_2d());
    REQUIRE(s.pdf > 0);
    const Vec2 uv = lat_long_from_direction(s.direction);
    const int row = std::clamp(static_cast<int>(uv.y * rows), 0, rows - 1);
    const int column = std::clamp(static_cast<int>(uv.x * columns), 0, columns - 1);
    ++counts[static_cast<std::size_t>(row * columns + column)];
  }
  // Rounding moves some samples across seams to neighboring cells, some of which expect no sample.
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] == 0) {
      CHECK(counts[i] < 5);
      counts[i] = 0;
    }
  }
  CHECK(test::goodness_of_fit(counts, expected).p > 0.01);
}

TEST_CASE("A lat-long picture has -z in its center and +y at its top") {
  CHECK(lat_long_from_direction({0, 0, -1}) == Vec2(0.5F, 0.5F));
  CHECK(lat_long_from_direction({1, 0, 0}) == Vec2(0.75F, 0.5F));
  CHECK(lat_long_from_direction({0, 1, 0}).y == 0);
  CHECK(lat_long_from_direction({0, -1, 0}).y == 1);
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 uv = random.next_2d();
    const Vec2 back = lat_long_from_direction(direction_from_lat_long(uv));
    CHECK(back.x == Approx(uv.x).margin(1e-4));
    CHECK(back.y == Approx(uv.y).margin(1e-5));
  }
}

namespace {

// Many small lights of all kinds above and below a floor.
Scene many_lights(int count) {
  SceneBuilder builder;
  Random random(4);
  builder.add(RectangleShape{{10, 10}}, builder.diffuse(1));
  const LightId panel_triangles = 8;
  for (int i = 0; i < count; ++i) {
    const DVec3 p(8 * random.next() - 4, 0.2 + 2 * random.next(), 8 * random.next() - 4);
    const Vec3 power(random.next(), random.next(), random.next());
    if (i % 3 == 0) {
      builder.light(PointLight{p, power});
    } else if (i % 3 == 1) {
      builder.light(SpotLight{p, {random.next() - 0.5, -1, random.next() - 0.5}, power, 50, 0.3});
    } else {
      const LightId id = builder.light(AreaLight{10.0F * power, i % 2 == 0});
      builder.add(DiskShape{0.1, static_cast<int>(panel_triangles)}, 0,
                  moved(p) * turned(360 * random.next(), glm::normalize(DVec3(1, 0.3, 0.2))), id);
    }
  }
  builder.light(EnvironmentLight{Vec3(0.05F)});
  builder.light(DirectionalLight{{1, -1, 0}, Vec3(0.2F)});
  builder.look({0, 4, 6}, {0, 0, 0}, 40);
  builder.film(16, 1024);
  builder.scene.render.max_depth = 1;
  return builder.scene;
}

}  // namespace

TEST_CASE("Choosing a light: probabilities are those of the choice and leave no light out") {
  for (const int count : {9, 200, 1000}) {
    const Scene scene = many_lights(count);
    const World world = make_world(scene);
    const TextureStore textures(world.textures);
    const Lights lights(world, textures);
    Random random(5);
    for (int point = 0; point < 20; ++point) {
      LitPoint at;
      at.position = Vec3(8 * random.next() - 4, 2 * random.next() - 1, 8 * random.next() - 4);
      at.normal = glm::normalize(Vec3(random.next() - 0.5F, random.next() - 0.5F, 0.3F));
      at.transmits = point % 4 == 0;
      double total = 0;
      for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto id = static_cast<LightId>(i);
        const float probability = lights.sampler().probability(at, id);
        total += probability;
        if (probability > 0) continue;
        for (int k = 0; k < 50; ++k) {
          const auto sample = lights.sample(id, at, {random.next(), random.next_2d()});
          const bool reached = sample && sample->radiance != Vec3(0) &&
                               (at.transmits || glm::dot(sample->direction, at.normal) > 0);
          CHECK_FALSE(reached);
        }
      }
      CHECK(total < 1 + 1e-5);
      const int n = 20000;
      std::vector<double> counts(lights.size()), expected(lights.size());
      for (int i = 0; i < n; ++i) {
        const auto choice = lights.sampler().choose(at, random.next());
        if (!choice) continue;
        REQUIRE(choice->probability ==
                Approx(lights.sampler().probability(at, choice->light)).epsilon(1e-4));
        ++counts[choice->light];
      }
      double lost = n;
      for (std::size_t i = 0; i < lights.size(); ++i) {
        expected[i] =
            n * static_cast<double>(lights.sampler().probability(at, static_cast<LightId>(i)));
        lost -= counts[i];
      }
      counts.push_back(lost);
      expected.push_back(std::max(0.0, n * (1 - total)));
      CHECK(test::goodness_of_fit(counts, expected).p > 1e-4);
    }
  }
}

TEST_CASE("Many lights at once are as bright as each alone, added up") {
  const Scene scene = many_lights(40);
  const Estimate together = estimate(scene);
  double sum = 0, variance = 0;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    Scene alone = scene;
    for (std::size_t k = 0; k < scene.lights.size(); ++k) {
      if (k == i) continue;
      std::visit(
          [](auto& model) {
            if constexpr (requires { model.intensity; }) model.intensity = Vec3(0);
            if constexpr (requires { model.radiance; }) model.radiance = Vec3(0);
            if constexpr (requires { model.irradiance; }) model.irradiance = Vec3(0);
          },
          alone.lights[k].model);
    }
    alone.render.samples = 64;
    alone.render.seed = i + 1;
    const Estimate e = estimate(alone);
    sum += e.mean;
    variance += e.sigma * e.sigma;
  }
  const double sigma = std::sqrt(variance + together.sigma * together.sigma);
  INFO(together.mean << " against " << sum << ", sigma " << sigma);
  CHECK(std::abs(together.mean - sum) < 4 * sigma);
}
