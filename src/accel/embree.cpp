// Embree (3.13 or 4) behind the Accelerator interface, with its fastest settings: a reference for
// speed. It has its own ray-triangle test, so its answers differ in the last bits.
#include <algorithm>
#include <array>
#include <atomic>
#include <pah/accel/accelerator.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "accel/embree_version.hpp"
#if PAH_EMBREE >= 4
#include <embree4/rtcore.h>
#elif PAH_EMBREE
#include <embree3/rtcore.h>
#endif

namespace pah {

#if PAH_EMBREE

namespace {

class Embree final : public Accelerator {
 public:
  Embree(const Triangles& triangles, EmbreeQuality quality, EmbreeRays rays) : rays_(rays) {
    if (device_ == nullptr) throw std::runtime_error("Embree cannot be started");
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(
        scene_, quality == EmbreeQuality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    if (triangles.size() > 0) add(triangles);
    rtcCommitScene(scene_);
    if (const RTCError error = rtcGetDeviceError(device_); error != RTC_ERROR_NONE) {
      release();
      throw std::runtime_error("Embree cannot build its structure: error " + std::to_string(error));
    }
  }
  ~Embree() override { release(); }

  void closest_hit(std::span<const Ray> rays, std::span<Hit> hits,
                   TraversalCounts* /*counts*/) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit query{prepared(rays[i]), {}};
      query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if PAH_EMBREE >= 4
      rtcIntersect1(scene_, &query);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene_, &context, &query);
#endif
      hits[i] = query.hit.geomID == RTC_INVALID_GEOMETRY_ID
                    ? Hit{}
                    : Hit{query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
    }
  }

  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> results,
                TraversalCounts* /*counts*/) const override {
    switch (rays_) {
      case EmbreeRays::single:
        return occluded_singly(rays, results);
      case EmbreeRays::packets_of_8:
        return occluded_by_packets<RTCRay8>(rays, results);
      case EmbreeRays::packets_of_16:
        return occluded_by_packets<RTCRay16>(rays, results);
    }
  }

  [[nodiscard]] AcceleratorMemory memory() const override {
    return {.global_bvh = static_cast<std::uint64_t>(std::max<std::int64_t>(bytes_, 0))};
  }

 private:
  static bool count_bytes(void* total, ssize_t bytes, bool /*after*/) {
    *static_cast<std::atomic<std::int64_t>*>(total) += bytes;
    return true;
  }

  void occluded_singly(std::span<const Ray> rays, std::span<std::uint8_t> results) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay query = prepared(rays[i]);
#if PAH_EMBREE >= 4
      rtcOccluded1(scene_, &query);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded1(scene_, &context, &query);
#endif
      results[i] = query.tfar < 0 ? 1 : 0;
    }
  }

  // `Packet` is RTCRay8 or RTCRay16.
  template <typename Packet>
  void occluded_by_packets(std::span<const Ray> rays, std::span<std::uint8_t> results) const {
    constexpr std::size_t width = std::extent_v<decltype(Packet::org_x)>;
    Packet packet{};
    alignas(64) std::array<int, width> valid{};
    for (std::size_t first = 0; first < rays.size(); first += width) {
      const std::size_t size = std::min(width, rays.size() - first);
      for (std::size_t i = 0; i < width; ++i) valid[i] = i < size ? -1 : 0;
      for (std::size_t i = 0; i < size; ++i) put(rays[first + i], packet, i);
      ask(valid.data(), packet);
      for (std::size_t i = 0; i < size; ++i) results[first + i] = packet.tfar[i] < 0 ? 1 : 0;
    }
  }

  template <typename Packet>
  static void put(const Ray& ray, Packet& packet, std::size_t lane) {
    packet.org_x[lane] = ray.origin.x;
    packet.org_y[lane] = ray.origin.y;
    packet.org_z[lane] = ray.origin.z;
    packet.dir_x[lane] = ray.direction.x;
    packet.dir_y[lane] = ray.direction.y;
    packet.dir_z[lane] = ray.direction.z;
    packet.tfar[lane] = ray.t_max;
    packet.mask[lane] = ~0U;
  }

  // The packets are not declared coherent: Embree then keeps rays together, which takes twice as
  // long for the rays of a path tracer.
  template <typename Packet>
  void ask(const int* valid, Packet& packet) const {
#if PAH_EMBREE >= 4
    const auto ask_by = [&](const auto& function) { function(valid, scene_, &packet, nullptr); };
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const auto ask_by = [&](const auto& function) { function(valid, scene_, &context, &packet); };
#endif
    if constexpr (std::is_same_v<Packet, RTCRay8>) {
      ask_by(rtcOccluded8);
    } else {
      ask_by(rtcOccluded16);
    }
  }

  static RTCRay prepared(const Ray& ray) {
    RTCRay query{};
    query.org_x = ray.origin.x;
    query.org_y = ray.origin.y;
    query.org_z = ray.origin.z;
    query.dir_x = ray.direction.x;
    query.dir_y = ray.direction.y;
    query.dir_z = ray.direction.z;
    query.tfar = ray.t_max;
    query.mask = ~0U;
    return query;
  }

  void add(const Triangles& triangles) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree's own buffers are padded: it reads 16 bytes even of the last position.
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Vec3), triangles.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(UVec3), triangles.indices.size());
    if (positions != nullptr && indices != nullptr) {
      std::ranges::copy(triangles.positions, static_cast<Vec3*>(positions));
      std::ranges::copy(triangles.indices, static_cast<UVec3*>(indices));
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
  }

  void release() {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  EmbreeRays rays_;
  std::atomic<std::int64_t> bytes_ = 0;
  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Accelerator> make_embree(Triangles triangles, EmbreeQuality quality,
                                         EmbreeRays rays) {
  return std::make_unique<Embree>(triangles, quality, rays);
}

bool has_embree() { return true; }
const char* embree_version() { return RTC_VERSION_STRING; }

#else

std::unique_ptr<Accelerator> make_embree(Triangles /*triangles*/, EmbreeQuality /*quality*/,
                                         EmbreeRays /*rays*/) {
  return nullptr;
}

bool has_embree() { return false; }
const char* embree_version() { return ""; }

#endif

}  // namespace pah
