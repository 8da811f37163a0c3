// --tev: the unfinished picture in a viewer.
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <pah/image/image_file.hpp>
#include <thread>

#include "catch.hpp"
#include "cli/tev/packets.hpp"
#include "cli/tev/stream.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"
#include "tev_listener.hpp"

namespace fs = std::filesystem;
using namespace pah::test;
using pah::CurrentTemporaryFolder;
using pah::Film;
using pah::Image;
using pah::PixelRect;
using pah::Vec3;
using pah::cli::parse_tev_address;
using pah::cli::TevAddress;
using pah::cli::TevStream;
using pah::cli::TileQueue;
using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;
using namespace std::chrono_literals;

namespace {

template <typename Condition>
bool wait_until(const Condition& condition) {
  const Clock::time_point start = Clock::now();
  while (!condition()) {
    if (Clock::now() - start > 60s) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

// Five samples take four passes of six tiles each.
Words small_render(const std::string& output, const Words& options) {
  write_file("scene.yaml", small_scene);
  Words words{"scene.yaml", "-o", output, "--width", "70", "--height", "50"};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

// Returns the picture, and checks that there is only one.
ListenedPicture shown(const TevListener& listener, const std::string& name) {
  CHECK(listener.fault().empty());
  const auto pictures = listener.pictures().pictures();
  REQUIRE(pictures.size() == 1);
  REQUIRE(pictures.contains(name));
  return pictures.at(name);
}

Image part(const Image& image, const PixelRect& rect) {
  Image result{rect.width(), rect.height(), {}};
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) result.pixels.push_back(image.at(x, y));
  return result;
}

int warnings_in(const std::string& text) {
  int count = 0;
  for (std::size_t at = text.find("warning: "); at != std::string::npos;
       at = text.find("warning: ", at + 1))
    ++count;
  return count;
}

Film gray_film(int width, int height) {
  Film film;
  film.rect = {0, width, 0, height};
  film.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (auto& pixel : film.pixels) {
    pixel.add_radiance({0.5, 0.25, 0.75});
    pixel.samples = 1;
  }
  return film;
}

pah::FilmSettings settings_of(const Film& film) {
  pah::FilmSettings settings;
  settings.width = film.rect.width();
  settings.height = film.rect.height();
  return settings;
}

TevAddress address_of(const TevListener& listener) {
  return {"127.0.0.1", static_cast<std::uint16_t>(listener.port())};
}

}  // namespace

TEST_CASE("The viewer shows in the end the picture that is written, to the last bit") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  const Outcome outcome =
      run(small_render("out.exr", {"--spp", "5", "--tev", listener.address(), "--exposure", "3"}));
  CHECK(outcome.exit_code == 0);
  CHECK(warnings_in(outcome.err) == 0);
  const ListenedPicture picture = shown(listener, "out.exr");
  CHECK(picture.image.width == 70);
  CHECK(picture.image.height == 50);
  CHECK(picture.updates >= 6);
  CHECK(picture.updates <= 4 * 6);
  CHECK(picture.image.pixels == pah::read_image("out.exr").pixels);
  CHECK(files() == Words{"out.exr", "scene.yaml"});
}

TEST_CASE("The viewer shows a crop where it is in the picture") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  fs::create_directory("there");
  REQUIRE(run(small_render("there/out.exr",
                           {"--spp", "5", "--tev", listener.address(), "--crop", "11,59,7,44"}))
              .exit_code == 0);
  const ListenedPicture picture = shown(listener, "out.exr");
  CHECK(picture.image.width == 70);
  CHECK(picture.image.height == 50);
  CHECK(part(picture.image, {11, 59, 7, 44}).pixels == pah::read_image("there/out.exr").pixels);
  CHECK(std::ranges::count(picture.updated, true) == 48 * 37);
}

TEST_CASE("The picture is the same with a viewer and without") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  (void)run(small_render("with.film", {"--spp", "5", "--tev", listener.address()}));
  (void)run(small_render("without.film", {"--spp", "5"}));
  CHECK(!read_file("with.film").empty());
  CHECK(read_file("with.film") == read_file("without.film"));
  CHECK(shown(listener, "with.film").updates >= 6);
}

TEST_CASE("The viewer shows the film from which a render continues") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  const Words options{"--checkpoint", "100", "--tev", listener.address(), "--quiet"};
  Words first = small_render("out.exr", options);
  first.insert(first.end(), {"--time-limit", "0.000001", "--spp", "5"});
  REQUIRE(run(first).exit_code == 0);
  REQUIRE(fs::exists("out.exr.film"));
  // The resumed render has no samples left to render.
  Words second = small_render("out.exr", options);
  second.insert(second.end(), {"--resume", "--spp", "1"});
  REQUIRE(run(second).exit_code == 0);
  CHECK(listener.connections() == 2);
  CHECK(listener.pictures().created() == 2);
  const ListenedPicture picture = shown(listener, "out.exr");
  CHECK(picture.updates == 6);
  CHECK(picture.image.pixels == pah::read_image("out.exr").pixels);
}

TEST_CASE("Without a viewer the picture is rendered, with a warning") {
  const CurrentTemporaryFolder folder;
  const std::string address = "127.0.0.1:" + std::to_string(free_port());
  const Outcome outcome = run(small_render("out.film", {"--tev", address}));
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "warning: no tev listens on " + address + ": Connection refused\n"));
  CHECK(warnings_in(outcome.err) == 1);
  CHECK(fs::exists("out.film"));
}

TEST_CASE("A missing viewer is an error with --strict") {
  const CurrentTemporaryFolder folder;
  const std::string address = "127.0.0.1:" + std::to_string(free_port());
  const Outcome outcome = run(small_render("out.film", {"--tev", address, "--strict", "--quiet"}));
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.err == "error: no tev listens on " + address + ": Connection refused\n");
  CHECK(fs::exists("out.film"));
}

TEST_CASE("A viewer that closes during a render causes one warning") {
  const CurrentTemporaryFolder folder;
  const TevListener listener(Listening::first_packet);
  const Outcome outcome =
      run(small_render("out.film", {"--tev", listener.address(), "--spp", "200"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(warnings_in(outcome.err) == 1);
  CHECK(contains(outcome.err, "warning: lost tev on " + listener.address() + ": "));
  CHECK(fs::exists("out.film"));
  CHECK(listener.connections() == 1);
  CHECK(listener.fault().empty());
}

TEST_CASE("A viewer that reads nothing does not delay the render") {
  const TevListener listener(Listening::nothing);
  const Film film = gray_film(640, 640);
  TevStream stream(address_of(listener), "slow", settings_of(film), {5s, 200ms});
  const Clock::time_point start = Clock::now();
  for (int pass = 0; pass < 10; ++pass)
    for (int y = 0; y < 640; y += 32)
      for (int x = 0; x < 640; x += 32) stream.show(film, {x, x + 32, y, y + 32});
  CHECK(Clock::now() - start < 1s);
  CHECK(!stream.take_fault());
  SECTION("in the end it is waited for, but not for long") {
    const Clock::time_point finishing = Clock::now();
    stream.finish();
    CHECK(Clock::now() - finishing >= 190ms);
    CHECK(stream.take_fault() ==
          "tev on " + listener.address() + " is too slow: it did not receive the whole picture");
    CHECK(!stream.take_fault());
  }
  SECTION("it is not if the picture is given up") {}
  CHECK(Clock::now() - start < 2s);
}

TEST_CASE("Waiting tiles are sent when a picture is finished") {
  const TevListener listener;
  const Film film = gray_film(640, 640);
  TevStream stream(address_of(listener), "waits", settings_of(film));
  for (int y = 0; y < 640; y += 32)
    for (int x = 0; x < 640; x += 32) stream.show(film, {x, x + 32, y, y + 32});
  stream.finish();
  CHECK(!stream.take_fault());
  const ListenedPicture picture = shown(listener, "waits");
  CHECK(picture.updates == 400);
  CHECK(picture.image.pixels == radiance_of(film).pixels);
}

TEST_CASE("Tiles are sent to tev as they are finished") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  Program program(small_render("out.film", {"--tev", listener.address(), "--spp", "1000000000"}));
  REQUIRE(wait_until([&] {
    const auto pictures = listener.pictures().pictures();
    return pictures.contains("out.film") && pictures.at("out.film").updates > 20;
  }));
  program.signal(SIGINT);
  CHECK(program.wait().exit_code == 130);
  CHECK(listener.fault().empty());
}

TEST_CASE("The viewer shows what watch renders") {
  const CurrentTemporaryFolder folder;
  const TevListener listener;
  Words words = small_render("out.exr", {"--tev", listener.address()});
  words.insert(words.begin(), "watch");
  Program program(words);
  REQUIRE(wait_until([&] { return fs::exists("out.exr"); }));
  write_file("scene.yaml", std::string(small_scene) + "  - {type: environment, radiance: 1}\n");
  REQUIRE(wait_until([&] { return listener.connections() == 2; }));
  REQUIRE(wait_until([&] {
    return shown(listener, "out.exr").image.pixels == pah::read_image("out.exr").pixels;
  }));
  program.signal(SIGINT);
  CHECK(program.wait().exit_code == 130);
}

TEST_CASE("A viewer's address is a host, a port or both") {
  const auto is = [](const char* text, const char* host, int port) {
    INFO(text);
    CHECK(parse_tev_address(text) == TevAddress{host, static_cast<std::uint16_t>(port)});
  };
  is("14159", "127.0.0.1", 14159);
  is(":65535", "127.0.0.1", 65535);
  is("localhost", "localhost", 14158);
  is("big-machine.example:1", "big-machine.example", 1);
  is("10.0.0.7", "10.0.0.7", 14158);
  is("[::1]", "::1", 14158);
  is("[fe80::1%eth0]:99", "fe80::1%eth0", 99);
  for (const char* text :
       {"",           ":",       "0",       "65536",    "99999999999",   "host:", "host:0",
        "host:65536", "host:-1", "host:1x", "host:1:2", "::1",           "[::1",  "[]",
        "[]:1",       "[::1]1",  "[::1]:",  "a b",      "http://host:1", "host/", "[a/b]"}) {
    INFO(text);
    CHECK(!parse_tev_address(text));
  }
  CHECK(to_string(TevAddress{"::1", 7}) == "[::1]:7");
  CHECK(to_string(TevAddress{}) == "127.0.0.1:14158");
}

TEST_CASE("An invalid value of --tev is wrong usage") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  for (const char* text : {"host:70000", "a b", "::1"}) {
    const Outcome outcome = run({"scene.yaml", "-o", "out.png", "--tev", text});
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.err, std::string("--tev: ") + text + " is not HOST, HOST:PORT or PORT"));
    CHECK(files() == Words{"scene.yaml"});
  }
}

TEST_CASE("Packets follow tev's protocol") {
  using namespace std::string_literals;
  CHECK(pah::cli::create_image_packet("a.png", 258, 3) ==
        "\x1e\0\0\0\x04\x01"
        "a.png\0\x02\x01\0\0\x03\0\0\0\x03\0\0\0R\0G\0B\0"s);
  // 1 is 3f800000, -2 is c0000000, 0.5 is 3f000000.
  CHECK(pah::cli::update_image_packet("p", 1, 2, Image{1, 1, {Vec3(1, -2, 0.5F)}}) ==
        "\x5e\0\0\0\x06\0p\0\x03\0\0\0R\0G\0B\0"
        "\x01\0\0\0\x02\0\0\0\x01\0\0\0\x01\0\0\0"
        "\0\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0"
        "\x03\0\0\0\0\0\0\0\x03\0\0\0\0\0\0\0\x03\0\0\0\0\0\0\0"
        "\0\0\x80\x3f\0\0\0\xc0\0\0\0\x3f"s);
}

TEST_CASE("A queue holds the last state of each tile, the longest waiting first") {
  TileQueue queue;
  const auto tile = [](int x, int y, float value) {
    return pah::cli::ShownTile{x, y, Image{1, 1, {Vec3(value)}}};
  };
  for (int pass = 0; pass < 100; ++pass)
    for (int x = 0; x < 3; ++x)
      for (int y = 0; y < 2; ++y) queue.push(tile(x, y, static_cast<float>(pass)));
  CHECK(queue.size() == 6);
  const auto first = queue.pop();
  REQUIRE(first);
  CHECK(first->x == 0);
  CHECK(first->y == 0);
  CHECK(first->pixels.pixels == std::vector<Vec3>{Vec3(99)});
  queue.push(tile(0, 0, 100));
  queue.close();
  queue.push(tile(0, 0, 101));
  std::vector<std::pair<int, int>> places;
  std::optional<pah::cli::ShownTile> last;
  while (auto next = queue.pop()) {
    places.emplace_back(next->x, next->y);
    last = std::move(next);
  }
  CHECK(places == std::vector<std::pair<int, int>>{{0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}, {0, 0}});
  CHECK(last->pixels.pixels == std::vector<Vec3>{Vec3(100)});

  TileQueue abandoned;
  abandoned.push(tile(0, 0, 1));
  abandoned.abandon();
  CHECK(!abandoned.pop());
}

TEST_CASE("A queue's reader waits for tiles of several threads") {
  TileQueue queue;
  int taken = 0;
  std::thread reader([&] {
    while (queue.pop()) ++taken;
  });
  std::vector<std::thread> writers;
  for (int writer = 0; writer < 4; ++writer)
    writers.emplace_back([&queue, writer] {
      for (int y = 0; y < 1000; ++y) queue.push({writer, y, Image{1, 1, {Vec3(0)}}});
    });
  for (std::thread& writer : writers) writer.join();
  queue.close();
  reader.join();
  CHECK(taken == 4000);
}
