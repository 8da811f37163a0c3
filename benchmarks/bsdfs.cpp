// Directions a second drawn from, and evaluated by, each BSDF model.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "registrations.hpp"
#include "render/bsdf/material_eval.hpp"
#include "render/sampling/sampler.hpp"
#include "render/sampling/warp.hpp"

namespace pah::bench {
namespace {

struct NamedModel {
  const char* name;
  MaterialModel model;
};

std::vector<NamedModel> models() {
  GlassMaterial rough_glass;
  rough_glass.roughness.value = 0.4F;
  MetalMaterial rough_metal, smooth_metal;
  rough_metal.roughness.value = 0.4F;
  smooth_metal.roughness.value = 0;
  PrincipledMaterial principled;
  principled.metallic.value = 0.4F;
  return {{"diffuse", DiffuseMaterial{}}, {"mirror", MirrorMaterial{}},
          {"glass", GlassMaterial{}},     {"rough_glass", rough_glass},
          {"smooth_metal", smooth_metal}, {"rough_metal", rough_metal},
          {"plastic", PlasticMaterial{}}, {"principled", principled}};
}

struct Directions {
  Vec3 wo, wi;
  float u;  // for the choice of a lobe
  Vec2 u2;
};

std::vector<Directions> directions(bool all_around) {
  std::vector<Directions> made;
  for (std::uint32_t i = 0; i < 1024; ++i) {
    Sampler sampler(0, 0, i, 1);
    Directions d;
    d.wo = sample_cosine_hemisphere(sampler.next_2d());
    const Vec2 u = sampler.next_2d();
    d.wi = all_around ? sample_uniform_sphere(u) : sample_cosine_hemisphere(u);
    d.u = sampler.next_1d();
    d.u2 = sampler.next_2d();
    made.push_back(d);
  }
  return made;
}

double mean(const Vec3& color) { return double{color.x + color.y + color.z} / 3; }

void measure_sample(benchmark::State& state, const Bsdf& bsdf) {
  const std::vector<Directions> all = directions(false);
  for (auto _ : state) {
    for (const Directions& d : all) {
      auto drawn = sample(bsdf, d.wo, d.u, d.u2);
      benchmark::DoNotOptimize(drawn);
    }
  }
  double weight = 0;
  for (const Directions& d : all) {
    if (const auto drawn = sample(bsdf, d.wo, d.u, d.u2)) weight += mean(drawn->weight);
  }
  const auto count = static_cast<std::int64_t>(all.size());
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["mean_weight"] = weight / static_cast<double>(count);
}

void measure_evaluate(benchmark::State& state, const Bsdf& bsdf) {
  const std::vector<Directions> all = directions(std::holds_alternative<GlassBsdf>(bsdf));
  for (auto _ : state) {
    for (const Directions& d : all) {
      Vec3 value = evaluate(bsdf, d.wo, d.wi);
      float density = pdf(bsdf, d.wo, d.wi);
      benchmark::DoNotOptimize(value);
      benchmark::DoNotOptimize(density);
    }
  }
  const auto positive = std::ranges::count_if(
      all, [&](const Directions& d) { return mean(evaluate(bsdf, d.wo, d.wi)) > 0; });
  const auto count = static_cast<std::int64_t>(all.size());
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["positive_share"] = static_cast<double>(positive) / static_cast<double>(count);
}

}  // namespace

void register_bsdfs() {
  const TextureStore no_textures({});
  for (const auto& [name, model] : models()) {
    Material material;
    material.model = model;
    const Bsdf bsdf = resolve_material(material, no_textures, Vec2{0}, 0);
    const std::string named = name;
    benchmark::RegisterBenchmark(("bsdfs/sample/" + named).c_str(),
                                 [bsdf](benchmark::State& state) { measure_sample(state, bsdf); });
    // Next-event estimation does not ask the others.
    if (!has_smooth_lobes(bsdf)) continue;
    benchmark::RegisterBenchmark(
        ("bsdfs/evaluate_and_pdf/" + named).c_str(),
        [bsdf](benchmark::State& state) { measure_evaluate(state, bsdf); });
  }
}

}  // namespace pah::bench
