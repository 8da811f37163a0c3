#include "load/mesh/gltf/meshes.hpp"

#include <cmath>

namespace pah {
namespace {

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

[[noreturn]] void fail_at(std::size_t vertex, const char* value) {
  throw MeshFileError("the " + std::string(value) + " of vertex " + std::to_string(vertex) +
                      " is not finite");
}

void check_count(std::size_t count, std::size_t vertices, const char* name) {
  if (count != vertices)
    throw MeshFileError("attribute " + std::string(name) + " has " + std::to_string(count) +
                        " values for " + std::to_string(vertices) + " vertices");
}

// Adds the corners of a list, strip or fan of triangles (glTF 2.0, 3.7.2.1).
void add_triangles(std::uint64_t mode, const std::vector<std::uint32_t>& indices,
                   PolygonMesh& out) {
  constexpr std::uint64_t strip = 5, fan = 6;
  const std::size_t step = mode == strip || mode == fan ? 1 : 3;
  for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
    const std::size_t odd = mode == strip ? i % 2 : 0;
    out.corners.push_back(mode == fan ? indices[0] : indices[i]);
    out.corners.push_back(indices[i + 1 + odd]);
    out.corners.push_back(indices[i + 2 - odd]);
    out.face_sizes.push_back(3);
  }
}

// Reads linear colors with or without alpha.
void read_colors(const GltfBuffers& buffers, std::size_t accessor, PolygonMesh& mesh,
                 std::vector<std::string>& left_out) {
  const std::size_t size = buffers.components(accessor) == 4 ? 4 : 3;
  const std::vector<float> values = buffers.floats(accessor, size, "attribute COLOR_0");
  check_count(values.size() / size, mesh.positions.size(), "COLOR_0");
  bool translucent = false;
  for (std::size_t i = 0; i < values.size(); i += size) {
    const Vec3 color(values[i], values[i + 1], values[i + 2]);
    if (!finite(color)) fail_at(i / size, "color");
    mesh.colors.push_back(color);
    translucent |= size == 4 && values[i + 3] != 1;
  }
  if (translucent) left_out.emplace_back("alpha of vertex colors");
}

PolygonMesh read_primitive(const GltfDocument& document, const GltfBuffers& buffers,
                           const Json& primitive, std::uint64_t mode,
                           std::vector<std::string>& left_out) {
  const std::size_t accessors = list(document.json, "accessors").size();
  const Json& attributes = child(primitive, "attributes");
  if (!attributes.contains("POSITION")) throw MeshFileError("a mesh primitive has no positions");
  const auto read = [&](const char* name, std::size_t components) {
    return buffers.floats(index_of(attributes, name, accessors), components,
                          "attribute " + std::string(name));
  };
  PolygonMesh mesh;
  const std::vector<float> positions = read("POSITION", 3);
  const std::size_t count = positions.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    mesh.positions.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    if (!finite(mesh.positions.back())) fail_at(i, "position");
  }
  if (attributes.contains("NORMAL")) {
    const std::vector<float> normals = read("NORMAL", 3);
    check_count(normals.size() / 3, count, "NORMAL");
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
      // Some files have such normals at degenerate triangles. A normal of length 0 is ignored
      // later.
      mesh.normals.push_back(finite(normal) ? normal : Vec3(0));
    }
  }
  if (attributes.contains("TEXCOORD_0")) {
    const std::vector<float> uvs = read("TEXCOORD_0", 2);
    check_count(uvs.size() / 2, count, "TEXCOORD_0");
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(uvs[2 * i]) || !std::isfinite(uvs[2 * i + 1]))
        fail_at(i, "texture coordinate");
      mesh.uvs.emplace_back(uvs[2 * i], 1 - uvs[2 * i + 1]);  // glTF's v points down
    }
  }
  if (attributes.contains("COLOR_0"))
    read_colors(buffers, index_of(attributes, "COLOR_0", accessors), mesh, left_out);
  std::vector<std::uint32_t> indices;
  if (primitive.contains("indices")) {
    indices = buffers.indices(index_of(primitive, "indices", accessors));
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= count)
        throw MeshFileError("index " + std::to_string(i) + " of a mesh names vertex " +
                            std::to_string(indices[i]) + " of " + std::to_string(count));
  } else {
    for (std::uint32_t i = 0; i < count; ++i) indices.push_back(i);
  }
  add_triangles(mode, indices, mesh);
  return mesh;
}

}  // namespace

std::vector<GltfPrimitive> read_gltf_mesh(const GltfDocument& document, const GltfBuffers& buffers,
                                          std::size_t mesh, std::vector<std::string>& left_out) {
  const std::size_t materials = list(document.json, "materials").size();
  std::vector<GltfPrimitive> primitives;
  for (const Json& primitive : list(list(document.json, "meshes").at(mesh), "primitives")) {
    constexpr std::uint64_t triangles = 4, last_mode = 6;
    const std::uint64_t mode = number(primitive, "mode", triangles);
    if (mode > last_mode) throw MeshFileError("a mesh primitive is of an unknown mode");
    if (mode < triangles) {
      left_out.emplace_back("points and lines");
      continue;
    }
    if (primitive.contains("targets")) left_out.emplace_back("morph targets");
    primitives.push_back(
        {primitive.contains("material") ? index_of(primitive, "material", materials) : materials,
         read_primitive(document, buffers, primitive, mode, left_out)});
  }
  return primitives;
}

void append(const PolygonMesh& from, const glm::dmat4x3& world_from_object, PolygonMesh& out) {
  const DMat3 m(world_from_object);
  const bool mirrors = glm::determinant(m) < 0;
  const double sign = mirrors ? -1 : 1;
  const DMat3 normal_matrix(sign * glm::cross(m[1], m[2]), sign * glm::cross(m[2], m[0]),
                            sign * glm::cross(m[0], m[1]));
  const auto first = static_cast<std::uint32_t>(out.vertices.size());
  for (std::size_t i = 0; i < from.positions.size(); ++i) {
    PolygonVertex vertex{static_cast<std::uint32_t>(out.positions.size()), no_index, no_index};
    const Vec3 position(world_from_object * glm::dvec4(DVec3(from.positions[i]), 1));
    if (!finite(position)) fail_at(i, "position");
    out.positions.push_back(position);
    if (!from.uvs.empty()) {
      vertex.uv = static_cast<std::uint32_t>(out.uvs.size());
      out.uvs.push_back(from.uvs[i]);
    }
    if (!from.normals.empty()) {
      const DVec3 normal = normal_matrix * DVec3(from.normals[i]);
      const double length = glm::length(normal);
      vertex.normal = static_cast<std::uint32_t>(out.normals.size());
      out.normals.push_back(length > 0 && std::isfinite(length) ? Vec3(normal / length) : Vec3(0));
    }
    out.vertices.push_back(vertex);
  }
  for (std::size_t i = 0; i < from.corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      out.corners.push_back(first + from.corners[i + (mirrors ? (3 - k) % 3 : k)]);
  out.face_sizes.insert(out.face_sizes.end(), from.face_sizes.begin(), from.face_sizes.end());
}

}  // namespace pah
