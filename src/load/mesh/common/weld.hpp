// Merges vertices of triangles that are equal to the last bit.
#pragma once

#include <cstdint>
#include <functional>
#include <pah/scene/mesh.hpp>
#include <vector>

namespace pah {

// The attributes that all vertices have beside positions.
struct VertexParts {
  bool normals = false;
  bool uvs = false;
  bool colors = false;
};

struct VertexValues {
  Vec3 position;
  Vec3 normal{0};
  Vec2 uv{0};
  Vec3 color{1};
};

// Returns for each of `count` vertices the first equal one, possibly itself. `values` is called
// from several threads.
[[nodiscard]] std::vector<std::uint32_t> first_equal_vertices(
    std::uint32_t count, const std::function<VertexValues(std::uint32_t)>& values);

class MeshBuilder {
 public:
  MeshBuilder(const VertexParts& parts, std::size_t expected_triangles,
              std::size_t expected_vertices = 0);

  // Adds a vertex unless an equal one exists, and returns its index. Ignores attributes that the
  // mesh does not have.
  std::uint32_t add_vertex(const VertexValues& values);
  // Adds a vertex without a search for an equal one, and returns its index.
  std::uint32_t add_new_vertex(const VertexValues& values);
  void add_triangle(const UVec3& triangle) { mesh_.triangles.push_back(triangle); }

  [[nodiscard]] std::size_t vertices() const { return mesh_.positions.size(); }
  [[nodiscard]] std::size_t triangles() const { return mesh_.triangles.size(); }
  [[nodiscard]] Mesh take();

 private:
  [[nodiscard]] std::uint64_t hash(std::uint32_t vertex) const;
  [[nodiscard]] bool same(std::uint32_t a, std::uint32_t b) const;
  void grow();

  Mesh mesh_;
  VertexParts parts_;
  std::size_t expected_triangles_;
  std::vector<std::uint32_t> table_;  // open addressing over a power of 2; vertex + 1, or 0
};

// Replaces the normals by the mean of the normals of the triangles around each position, weighted
// by their angles there (Thuermer, Wuethrich, "Computing Vertex Normals from Polygonal Facets", JGT
// 1998). Seams of texture coordinates make no difference.
void smooth_normals(Mesh& mesh);

}  // namespace pah
