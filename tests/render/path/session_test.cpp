// Tests that the film does not depend on how samples are split into passes, tiles and sessions.
#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>
#include <pah/render/session.hpp>
#include <random>
#include <set>

#include "analytic_scenes.hpp"
#include "catch.hpp"
#include "support/fewer.hpp"

using namespace pah;
using namespace pah::test;

namespace {

// Glass and a rough floor under a panel and a sky; three rows of three tiles, the last ones narrow.
Scene room() {
  SceneBuilder builder;
  const MaterialId white = builder.diffuse(0.7F);
  builder.add(RectangleShape{{4, 4}}, white);
  builder.add(SphereShape{0.4, 16, 8}, builder.material(GlassMaterial{}), moved({-0.6, 0.4, 0.2}));
  builder.add(BoxShape{{0.4, 0.8, 0.4}}, white, moved({0.4, 0.4, 0}));
  const LightId panel = builder.light(AreaLight{Vec3(6), false});
  builder.add(RectangleShape{{1, 1}}, white, moved({0, 2, 0}) * turned(180, {1, 0, 0}), panel);
  builder.light(EnvironmentLight{Vec3(0.3F)});
  builder.look({0, 1, 4}, {0, 0.6, 0}, 35);
  builder.film(96, 5);
  builder.scene.film.crop = PixelRect{7, 87, 11, 81};
  return builder.scene;
}

// The data that sessions of a scene share.
struct Prepared {
  explicit Prepared(Scene of) : scene(std::move(of)) {}

  [[nodiscard]] RenderSession session(const SessionOptions& options = {}) const {
    return {world, *accelerator, scene.film, scene.render, options};
  }
  [[nodiscard]] RenderResult render() const {
    return pah::render(world, *accelerator, scene.film, scene.render);
  }

  Scene scene;
  World world = make_world(scene);
  std::unique_ptr<Accelerator> accelerator = make_global_bvh(world.triangles());
};

using Tiles = std::vector<std::size_t>;

Tiles all_tiles(const RenderSession& session) {
  Tiles tiles(session.tiles().size());
  std::iota(tiles.begin(), tiles.end(), std::size_t{0});
  return tiles;
}

bool same_to_the_last_bit(const Film& a, const Film& b) {
  return a.rect.x0 == b.rect.x0 && a.rect.x1 == b.rect.x1 && a.rect.y0 == b.rect.y0 &&
         a.rect.y1 == b.rect.y1 && identical(a, b) && a.features.size() == a.pixels.size() &&
         a.features == b.features;
}

// Returns the number of samples that all pixels of a tile have, or -1 if they differ.
int samples_of(const Film& film, const PixelRect& tile) {
  const auto samples = static_cast<int>(film.at(tile.x0, tile.y0).samples);
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1; ++x) {
      if (static_cast<int>(film.at(x, y).samples) != samples) return -1;
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("The tiles of a session are its film, each pixel once") {
  const Prepared prepared(room());
  const RenderSession session = prepared.session();
  const Film& film = session.film();
  CHECK(film.rect.x0 == 7);
  CHECK(film.rect.y1 == 81);
  CHECK(session.tiles().size() == 9);
  Film covered = film;
  for (const PixelRect& tile : session.tiles()) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) ++covered.at(x, y).samples;
    }
  }
  CHECK(std::ranges::all_of(covered.pixels, [](const FilmPixel& p) { return p.samples == 1; }));
}

TEST_CASE("Any split into passes gives the film of a render", "[threads]") {
  Prepared prepared(room());
  // Also more samples than are traced together.
  const std::vector<std::vector<int>> splits_of_5{{5}, {1, 4}, {4, 1}, {2, 2, 1}, {1, 1, 1, 1, 1}};
  const std::vector<std::vector<int>> splits_of_40{{40}, {17, 23}};
  for (const auto& splits : {splits_of_5, splits_of_40}) {
    prepared.scene.render.samples = std::accumulate(splits[0].begin(), splits[0].end(), 0);
    const RenderResult whole = prepared.render();
    REQUIRE(whole.complete);
    for (const std::vector<int>& split : splits) {
      RenderSession session = prepared.session({3, false});
      const Tiles tiles = all_tiles(session);
      int first = 0;
      for (const int count : split) {
        CHECK(session.render_pass(tiles, first, count) == tiles);
        first += count;
      }
      CHECK(same_to_the_last_bit(session.film(), whole.film));
      CHECK(session.counts().rays == whole.counts.rays);
      CHECK(same_to_the_last_bit(std::move(session).take_film(), whole.film));
    }
  }
}

TEST_CASE("Tiles may come in any order and in several calls", "[threads]") {
  const Prepared prepared(room());
  const RenderResult whole = prepared.render();
  RenderSession session = prepared.session();
  const Tiles odd{7, 3, 5, 1};
  const Tiles even{8, 0, 4, 2, 6};
  CHECK(session.render_pass(odd, 0, 3) == odd);
  for (std::size_t i = 0; i < 9; ++i) {
    CHECK(samples_of(session.film(), session.tiles()[i]) == (i % 2 == 1 ? 3 : 0));
  }
  CHECK(session.render_pass(even, 0, 5) == even);
  CHECK(session.render_pass({}, 0, 5).empty());
  CHECK(session.render_pass(odd, 3, 2) == odd);
  CHECK(same_to_the_last_bit(session.film(), whole.film));
  CHECK(session.counts().rays == whole.counts.rays);
}

TEST_CASE("A hundred random splits of the samples add up to the picture of the whole") {
  Prepared prepared(room());
  prepared.scene.film.width = 24;
  prepared.scene.film.height = 16;
  prepared.scene.film.crop.reset();
  constexpr int samples = 16;
  const auto part = [&](int from, int to) {
    prepared.scene.render.samples = to;
    RenderResult result = pah::render(prepared.world, *prepared.accelerator, prepared.scene.film,
                                      prepared.scene.render, {}, {{}, {from, from, 0, {}}});
    REQUIRE(result.held == FilmSamples{from, to, 0, {}});
    return std::move(result.film);
  };
  const Film whole = part(0, samples);
  const std::vector<Vec3> picture = radiance_of(whole).pixels;
  std::map<std::pair<int, int>, Film> parts;
  std::mt19937 random(5);
  for (int split = 0; split < fewer_if_sanitized(100); ++split) {
    std::set<int> ends{samples};
    for (auto parts_left = random() % 8; parts_left > 0; --parts_left)
      ends.insert(1 + static_cast<int>(random() % (samples - 1)));
    std::vector<std::pair<int, int>> ranges;
    int from = 0;
    for (const int to : ends) ranges.emplace_back(std::exchange(from, to), to);
    std::ranges::shuffle(ranges, random);
    Film sum;
    for (const auto& range : ranges) {
      auto known = parts.find(range);
      if (known == parts.end()) known = parts.emplace(range, part(range.first, range.second)).first;
      if (sum.pixels.empty())
        sum = known->second;
      else
        add(sum, known->second);
    }
    CAPTURE(split, ranges.size());
    CHECK(mean_samples(sum) == samples);
    REQUIRE(radiance_of(sum).pixels == picture);
  }
}

TEST_CASE("A restored film goes on as if nothing had happened") {
  const Prepared prepared(room());
  const RenderResult whole = prepared.render();
  for (const int before : {1, 3}) {
    RenderSession first = prepared.session();
    first.render_pass(all_tiles(first), 0, before);
    const Film saved = first.film();
    RenderSession second = prepared.session();
    second.render_pass(all_tiles(second), 0, 1);  // is replaced by the restored film
    second.restore(saved);
    CHECK(same_to_the_last_bit(second.film(), saved));
    second.render_pass(all_tiles(second), before, 5 - before);
    CHECK(same_to_the_last_bit(second.film(), whole.film));
  }
}

TEST_CASE("A render goes on from a film, some tiles of which are behind") {
  const Prepared prepared(room());
  const RenderResult whole = prepared.render();
  const Tiles odd{1, 3, 5, 7};
  const Tiles even{0, 2, 4, 6, 8};
  RenderSession session = prepared.session();
  session.render_pass(all_tiles(session), 0, 2);
  session.render_pass(odd, 2, 2);
  const RenderResult result =
      pah::render(prepared.world, *prepared.accelerator, prepared.scene.film, prepared.scene.render,
                  {}, {std::move(session).take_film(), {0, 2, 2, even}});
  CHECK(result.complete);
  CHECK(result.samples == 5);
  CHECK(result.held == FilmSamples{0, 5, 0, {}});
  CHECK(same_to_the_last_bit(result.film, whole.film));
}

TEST_CASE("A film of other pixels is refused") {
  const Prepared prepared(room());
  RenderSession session = prepared.session();
  session.render_pass(all_tiles(session), 0, 1);
  const Film own = session.film();

  Film larger = own;
  ++larger.rect.x1;
  larger.pixels.resize(81 * 70);
  CHECK_THROWS_WITH(session.restore(larger),
                    "a film of 81 x 70 pixels from (7, 11) does not fit a picture of 80 x 70 "
                    "pixels from (7, 11)");
  Film elsewhere = own;
  --elsewhere.rect.y0;
  --elsewhere.rect.y1;
  CHECK_THROWS_AS(session.restore(elsewhere), std::invalid_argument);
  Film torn = own;
  torn.pixels.pop_back();
  CHECK_THROWS_WITH(session.restore(torn), "a film of 80 x 70 pixels from (7, 11) holds 5599");
  Film plain = own;
  plain.features.clear();
  CHECK_THROWS_WITH(session.restore(plain),
                    "a film of 80 x 70 pixels from (7, 11) holds features of 0 in place of 5600");
  CHECK(same_to_the_last_bit(session.film(), own));
}

TEST_CASE("A stopped pass tells which tiles were finished", "[threads]") {
  const Prepared prepared(room());
  const RenderResult whole = prepared.render();
  for (const int threads : {1, 3}) {
    RenderSession session = prepared.session({threads, false});
    const Tiles tiles = all_tiles(session);
    std::atomic<bool> stop = false;
    std::mutex mutex;
    Tiles told;
    std::uint64_t rays = 0;
    const auto on_tile = [&](const FinishedTile& tile) {
      const std::lock_guard lock(mutex);
      CHECK(samples_of(session.film(), session.tiles()[tile.index]) == 5);
      told.push_back(tile.index);
      rays += tile.rays;
      if (told.size() == 3) stop = true;
    };
    const Tiles finished = session.render_pass(tiles, 0, 5, {&stop, on_tile});
    // Running tiles are finished, so there may be one more for each further thread.
    CHECK(finished.size() >= 3);
    CHECK(finished.size() <= static_cast<std::size_t>(2 + threads));
    CHECK(std::ranges::is_sorted(finished));
    std::ranges::sort(told);
    CHECK(told == finished);
    const auto [camera, shadow, bounce] = session.counts().rays;
    CHECK(rays == camera + shadow + bounce);
    Tiles rest;
    for (const std::size_t i : tiles) {
      const bool has_all = std::ranges::binary_search(finished, i);
      CHECK(samples_of(session.film(), session.tiles()[i]) == (has_all ? 5 : 0));
      if (!has_all) rest.push_back(i);
    }
    CHECK(session.render_pass(rest, 0, 5, {&stop, {}}).empty());
    stop = false;
    CHECK(session.render_pass(rest, 0, 5, {&stop, {}}) == rest);
    CHECK(same_to_the_last_bit(session.film(), whole.film));
  }
}

TEST_CASE("An invalid pass is refused without any effect") {
  const Prepared prepared(room());
  RenderSession session = prepared.session();
  const auto refused = [&](const Tiles& tiles, int first, int count, const char* message) {
    CHECK_THROWS_AS(session.render_pass(tiles, first, count), std::invalid_argument);
    CHECK_THROWS_WITH(session.render_pass(tiles, first, count), message);
  };
  refused({0, 9}, 0, 1, "there is no tile 9: the picture has 9");
  refused({4, 0, 4}, 0, 1, "tile 4 is given twice in one pass");
  refused({0}, -1, 2, "a pass cannot have 2 samples from sample -1 on");
  refused({0}, 0, 0, "a pass cannot have 0 samples from sample 0 on");
  refused({0}, 2147483647, 1, "a pass cannot have 1 samples from sample 2147483647 on");
  CHECK(session.counts().rays == RenderCounts{}.rays);
}

TEST_CASE("A session counts what traversal does if asked to") {
  const Prepared prepared(room());
  for (const bool asked : {false, true}) {
    RenderSession session = prepared.session({0, asked});
    session.render_pass(all_tiles(session), 0, 1);
    CHECK((session.counts().traversal[0].nodes > 0) == asked);
  }
}

TEST_CASE("A missing texture ends a session before it starts") {
  Scene scene = room();
  scene.textures.push_back(ImageTexture{"no_such_texture.png"});
  const Prepared prepared(scene);
  CHECK_THROWS_WITH((void)prepared.session(), contains_text("no_such_texture.png"));
}
