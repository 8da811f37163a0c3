// Numbers that depend on the frame: expressions and keyframes.
#include <pah/scene/scene.hpp>
#include <random>

#include "catch.hpp"
#include "load/scene/keyframes.hpp"
#include "load/yaml/expression.hpp"
#include "scene_testing.hpp"

using namespace pah;

namespace {

double value_of(std::string_view text, double frame = 6, double time = 0.25) {
  const std::optional<double> value = evaluate(text, {frame, time});
  REQUIRE(value);
  return *value;
}

LoadOptions at(int frame) {
  return {.overrides = {}, .limits = {}, .on_file = {}, .loaded = nullptr, .frame = frame};
}

// Returns the vertical field of view of a scene's camera at a frame.
double fov_at(const std::string& fov, int frame, const std::string& rest = "") {
  const LoadedScene loaded =
      load("camera: {type: perspective, fov: " + fov + "}\n" + rest, at(frame));
  return std::get<PerspectiveCamera>(loaded.scene.camera).fov;
}

DVec3 position_at(const std::string& position, int frame) {
  const LoadedScene loaded =
      load("camera: {type: perspective, position: " + position + "}", at(frame));
  return std::get<PerspectiveCamera>(loaded.scene.camera).position;
}

std::string camera_errors(const std::string& fov) {
  return errors_of("camera: {type: perspective, fov: " + fov + "}");
}

}  // namespace

TEST_CASE("An expression is evaluated as it is read") {
  CHECK(value_of("frame") == 6);
  CHECK(value_of("time") == 0.25);
  CHECK(value_of("1 + 2 * frame - 3") == 10);
  CHECK(value_of("(1 + 2) * -frame") == -18);
  CHECK(value_of("12/frame/2") == 1);
  CHECK(value_of("10 - frame - 1") == 3);
  CHECK(value_of("1.5e1*+frame") == 90);
  CHECK(value_of("frame % 4") == 2);
  CHECK(value_of("-frame % 4") == 2);
  CHECK(value_of("-(frame % 4)") == -2);
  CHECK(value_of("sin(5 * frame)") == Approx(0.5));
  CHECK(value_of("cos(10 * frame) + 0*frame") == Approx(0.5));
  CHECK(value_of("abs(-frame) + floor(time)") == 6);
  CHECK(value_of(std::string(60, '(') + "frame" + std::string(60, ')')) == 6);
}

TEST_CASE("A text that is not an expression has no value") {
  for (const std::string text :
       {"", "frame frame", "frame +", "(frame", "frame)", "2frame(", "frames", "frame.obj", "sin",
        "sin frame", "sine(frame)", "* frame", "frame ** 2", "frame,", "frame\n", "0x10"})
    CHECK_FALSE(evaluate(text, {}));
  CHECK_FALSE(evaluate(std::string(100'000, '(') + "frame", {}));
  CHECK_FALSE(evaluate(std::string(100'000, '-') + "frame", {}));
}

TEST_CASE("An expression may replace any number") {
  CHECK(fov_at("30 + frame", 12) == 42);
  CHECK(fov_at("30 + 10 * time", 12) == 35);
  CHECK(fov_at("30 + 10 * time", 12, "animation: {fps: 12}") == 40);
  CHECK(position_at("[frame, 2, -frame]", 3) == DVec3(3, 2, -3));
  const LoadedScene loaded = load(
      "render: {samples: 1 + 2 * frame}\nmaterials: {time: {type: diffuse, reflectance: frame / "
      "8}}\n"
      "meshes: [{name: frame, shape: box, material: time}]",
      at(4));
  CHECK(loaded.scene.render.samples == 9);
  CHECK(loaded.scene.meshes.at(0).name == "frame");
  CHECK(std::get<DiffuseMaterial>(loaded.scene.materials.at(0).model).reflectance.value ==
        Vec3(0.5));
}

TEST_CASE("Without a requested frame the scene's own frame is loaded") {
  const std::string text = "camera: {type: perspective, fov: 30 + frame}\n";
  const auto fov = [](const LoadedScene& loaded) {
    return std::get<PerspectiveCamera>(loaded.scene.camera).fov;
  };
  CHECK(fov(load(text)) == 30);
  CHECK(fov(load(text + "animation: {frame: 7}")) == 37);
  CHECK(fov(load(text, {{"animation.frame=2.5"}, {}})) == 32.5);
  CHECK(fov(load(text + "animation: {frame: 7}", at(2))) == 32);
  CHECK(
      fov(load("{}", {{"camera.type=perspective", "camera.fov=50 + frame"}, {}, {}, nullptr, 5})) ==
      55);
}

TEST_CASE("Keyframes are met, and numbers between them lie between theirs") {
  for (const std::string kind : {"linear", "smooth"}) {
    const std::string fov =
        "{keys: {0: 30, 8: 50, 10.5: 40, 20: 40, 24: 90}, interpolation: " + kind + "}";
    CHECK(fov_at(fov, -3) == 30);
    CHECK(fov_at(fov, 0) == 30);
    CHECK(fov_at(fov, 8) == 50);
    CHECK(fov_at(fov, 20) == 40);
    CHECK(fov_at(fov, 15) == 40);
    CHECK(fov_at(fov, 24) == 90);
    CHECK(fov_at(fov, 30) == 90);
    CHECK(fov_at(fov, 4) == Approx(40));
    CHECK(fov_at(fov, 6) > fov_at(fov, 4));
  }
  CHECK(fov_at("{keys: {8: 50, 0: 30}}", 2) == 35);
  CHECK(position_at("{keys: {0: [0, 1, 2], 4: [4, 1, 0]}}", 1) == DVec3(1, 1, 1.5));
  CHECK(position_at("[{keys: {0: 0, 4: 4}}, frame, 2]", 1) == DVec3(1, 1, 2));
  CHECK(fov_at("{keys: {0: 30, 4: 30 + frame}}", 2) == 31);
  const LoadedScene loaded =
      load("meshes: [{shape: box, transform: [{translate: [0, {keys: {0: 1, 2: 3}}, 0]}]}]", at(1));
  CHECK(loaded.scene.instances.at(0).world_from_object[3] == DVec3(0, 2, 0));
}

TEST_CASE("Smooth keyframes begin and end at rest, never jump, and do not overshoot") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-5, 5), gap(0.1, 4);
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<Key> keys{{0, number(random)}};
    while (keys.size() < 6) keys.push_back({keys.back().at + gap(random), number(random)});
    const auto value = [&](double at) { return interpolate(keys, at, Interpolation::smooth); };
    constexpr double step = 1e-4;
    double before = value(-step), slope_before = 0;
    double fastest = 0, sharpest = 0;
    for (double at = 0; at < keys.back().at + step; at += step) {
      const double now = value(at), slope = (now - before) / step;
      fastest = std::max(fastest, std::abs(slope));
      sharpest = std::max(sharpest, std::abs(slope - slope_before));
      before = now;
      slope_before = slope;
    }
    // A segment of 0.1 frames may rise by 10 at 3 / 2 of its mean speed, and turns within its half.
    CHECK(fastest <= 150);
    CHECK(sharpest <= 6 * 10 / (0.1 * 0.1) * step * 1.5);
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
      const auto [low, high] = std::minmax(keys[i].value, keys[i + 1].value);
      for (double t = 0; t <= 1; t += 1.0 / 64) {
        const double now = value(keys[i].at + t * (keys[i + 1].at - keys[i].at));
        CHECK((now >= low - 1e-12 && now <= high + 1e-12));
      }
    }
  }
}

TEST_CASE("Errors in expressions and keyframes are located") {
  CHECK(camera_errors("30 + fram") ==
        "scene.yaml:1:34: error: 'fov' of camera must be a number, not '30 + fram'; did you mean "
        "'frame'?\n");
  CHECK(
      camera_errors("200 + frame") ==
      "scene.yaml:1:34: error: 'fov' of camera must be greater than 0 and less than 180, not 200, "
      "which is 200 + frame\n");
  CHECK(camera_errors("1 / frame") ==
        "scene.yaml:1:34: error: 'fov' of camera must be a finite number, not inf, which is 1 / "
        "frame\n");
  CHECK(camera_errors("{keys: {0: 1, 2: [1]}}") ==
        "scene.yaml:1:51: error: a keyframe must be a number, not a list of 1\n");
  CHECK(
      camera_errors("{keys: {0: [1, 2], 2: [1]}}") ==
      "scene.yaml:1:56: error: a keyframe must be a list of 2 as the first one, not a list of 1\n");
  CHECK(camera_errors("{keys: {0: 1, 0.0: 2}}") ==
        "scene.yaml:1:48: error: the frame 0.0 has two keyframes\n");
  CHECK(camera_errors("{keys: {0: 1, end: 2}}") ==
        "scene.yaml:1:48: error: keys of keyframes are frames: 'end' is not a number\n");
  CHECK(
      camera_errors("{keys: {0: 1}, interpolation: cubic}") ==
      "scene.yaml:1:64: error: unknown interpolation 'cubic' of keyframes; available options are: "
      "linear, smooth\n");
  CHECK(camera_errors("{keys: {0: 1}, smooth: true}") ==
        "scene.yaml:1:49: error: unknown key 'smooth' in keyframes; available keys are: keys, "
        "interpolation\n");
  CHECK(camera_errors("{keys: {0: 200}}") ==
        "scene.yaml:1:45: error: 'fov' of camera must be greater than 0 and less than 180, not "
        "200\n");
  CHECK(errors_of("animation: {fps: 0}") ==
        "scene.yaml:1:18: error: 'fps' of animation must be greater than 0, not 0\n");
  CHECK(errors_of("animation: {fsp: 25}") ==
        "scene.yaml:1:13: error: unknown key 'fsp' in animation; did you mean 'fps'?\n");
}

TEST_CASE("A scene knows whether it moves, and its hash the frame if so") {
  const std::string still = "camera: {type: perspective, fov: 30}";
  const std::string moving = "camera: {type: perspective, fov: 30 + frame}";
  CHECK_FALSE(load(still).animated);
  CHECK(load(still, at(1)).hash == load(still, at(2)).hash);
  CHECK(load(moving).animated);
  CHECK(load(moving, at(1)).hash != load(moving, at(2)).hash);
  CHECK(load(moving, at(1)).hash == load(moving, at(1)).hash);
  CHECK(load("camera: {type: perspective, fov: {keys: {3: 30}}}").animated);
}

TEST_CASE("Aliases of animated values move, and materials may be named keys") {
  const LoadedScene loaded = load(
      "x-size: &size [1, 1 + frame, 1]\n"
      "meshes: [{shape: box, size: *size}, {shape: box, size: *size}]\n"
      "materials: {keys: {type: diffuse}, frame: {type: diffuse}}",
      at(3));
  for (const Mesh& mesh : loaded.scene.meshes) {
    float top = 0;
    for (const Vec3& position : mesh.positions) top = std::max(top, position.y);
    CHECK(top == 2);
  }
  CHECK(loaded.scene.materials.size() >= 2);
}
