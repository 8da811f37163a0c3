#include "catch.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <pah/load/mesh_file.hpp>

#include "support/mesh_checks.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;

namespace {

std::filesystem::path write(const TemporaryFolder& folder, const std::string& name,
                            const std::string& content) {
  const auto file = folder / name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

MeshFileError error_of(const std::filesystem::path& file, const MeshFileOptions& options = {}) {
  try {
    (void)read_mesh(file, options);
  } catch (const MeshFileError& e) {
    return e;
  }
  return MeshFileError("");
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A closed tetrahedron, corners counted from 1.
const std::string tetrahedron_positions = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const std::string tetrahedron_faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string binary_stl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{4});
  const Vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const UVec3& t : {UVec3{0, 2, 1}, UVec3{0, 1, 3}, UVec3{0, 3, 2}, UVec3{1, 2, 3}}) {
    append(bytes, Vec3(0));
    for (int k = 0; k < 3; ++k) append(bytes, p[t[k]]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string binary_ply(const std::string& vertices = "4") {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
                      "property list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    append(bytes, p);
  for (const UVec3& t : {UVec3{0, 2, 1}, UVec3{0, 1, 3}, UVec3{0, 3, 2}, UVec3{1, 2, 3}}) {
    append(bytes, std::uint8_t{3});
    append(bytes, t);
  }
  return bytes;
}

std::string ascii_ply(const std::string& last_vertex = "0 0 1",
                      const std::string& last_face = "3 1 2 3") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n" +
         last_vertex + "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n" + last_face + "\n";
}

}  // namespace

TEST_CASE("A tetrahedron is the same in every format") {
  const TemporaryFolder folder;
  const std::string facet =
      "facet normal 0 0 0\nouter loop\nvertex A\nvertex B\nvertex C\nendloop\nendfacet\n";
  std::string ascii_stl = "solid tetrahedron\n";
  const std::string corners[4] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  for (const auto& t : {UVec3{0, 2, 1}, UVec3{0, 1, 3}, UVec3{0, 3, 2}, UVec3{1, 2, 3}}) {
    std::string text = facet;
    text.replace(text.find('A'), 1, corners[t.x]);
    text.replace(text.find('B'), 1, corners[t.y]);
    text.replace(text.find('C'), 1, corners[t.z]);
    ascii_stl += text;
  }
  ascii_stl += "endsolid tetrahedron\n";
  for (const auto& file :
       {write(folder, "a.obj", tetrahedron_positions + tetrahedron_faces),
        write(folder, "a.PLY", ascii_ply()), write(folder, "b.ply", binary_ply()),
        write(folder, "a.stl", ascii_stl), write(folder, "b.stl", binary_stl())}) {
    CAPTURE(file);
    const Mesh mesh = read_mesh(file);
    CHECK(mesh.positions.size() == 4);
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.normals.empty());
    CHECK(mesh.uvs.empty());
    CHECK(is_closed(mesh));
    CHECK(volume_of(mesh) == Approx(1.0 / 6));
    MeshFileOptions options;
    options.normals = MeshNormals::smooth;
    const Mesh smooth = read_mesh(file, options);
    REQUIRE(smooth.normals.size() == 4);
    CHECK(glm::distance(smooth.normals[0], glm::normalize(Vec3(-1))) < 1e-6F);
    CHECK(read_mesh_file(file).parts.size() == 1);
    CHECK_FALSE(read_mesh_file(file).materials.empty());
  }
}

TEST_CASE("OBJ polygons, seams, normals, negative indices and joined lines load") {
  const TemporaryFolder folder;
  const auto file = write(folder, "a.obj",
                          "# a folded sheet\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\n"
                          "v 0 0 2 1.0\nv 1 0 2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                          "vn 0 0 1\nvn 0 -3 0\n"
                          "f 1/1/1 2/2/1 \\\n 3/3/1 4/4/1\n"
                          "f -6/1/2 -5/2/2 -1/3/2 -2/4/2\nl 1 2\np 3\n"
                          "o part two\nf 1//1 2//1 3//1\n");
  const Mesh mesh = read_mesh(file);
  CHECK(mesh.triangles.size() == 5);
  REQUIRE(mesh.normals.size() == mesh.positions.size());
  REQUIRE(mesh.uvs.size() == mesh.positions.size());
  CHECK(area_of(mesh) == Approx(1 + 2 + 0.5));
  for (const Vec3& n : mesh.normals) CHECK((n == Vec3(0, 0, 1) || n == Vec3(0, -1, 0)));
  MeshFileOptions options;
  options.normals = MeshNormals::flat;
  CHECK(read_mesh(file, options).normals.empty());
  // Smooth normals do not mind the seam of the texture coordinates.
  options.normals = MeshNormals::smooth;
  const Mesh smooth = read_mesh(file, options);
  for (std::size_t i = 0; i < smooth.positions.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (smooth.positions[i] == smooth.positions[j]) CHECK(smooth.normals[i] == smooth.normals[j]);
}

TEST_CASE("Polygons are cut into triangles of the same area and winding") {
  const TemporaryFolder folder;
  // A comb: many reflex corners, seen from each of three sides, in both windings.
  std::vector<DVec2> comb{{0, 0}};
  for (int i = 0; i < 20; ++i) {
    comb.emplace_back(i + 0.25, 0);
    comb.emplace_back(i + 0.5, i % 3 + 1);
    comb.emplace_back(i + 0.75, 0);
  }
  comb.emplace_back(20, 0);
  comb.emplace_back(20, -1);
  comb.emplace_back(0, -1);
  double area = 0;
  for (std::size_t i = 0; i < comb.size(); ++i) {
    const DVec2 a = comb[i], b = comb[(i + 1) % comb.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {1.0, -1.0}) {
      std::string text;
      for (const DVec2& p : comb) {
        DVec3 v{7};
        v[(axis + 1) % 3] = p.x;
        v[(axis + 2) % 3] = way * p.y;
        text += "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) +
                "\n";
      }
      text += "f";
      for (std::size_t i = 0; i < comb.size(); ++i) text += " " + std::to_string(i + 1);
      const Mesh mesh = read_mesh(write(folder, "comb.obj", text + "\n"));
      CHECK(mesh.triangles.size() == comb.size() - 2);
      CHECK(area_of(mesh) == Approx(std::abs(area)));
      for (const UVec3& t : mesh.triangles) {
        const Vec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                  mesh.positions[t.z] - mesh.positions[t.x]);
        CHECK(n[axis] * way * (area > 0 ? 1 : -1) >= 0);
      }
    }
}

TEST_CASE("OBJ errors have lines and columns") {
  const TemporaryFolder folder;
  const auto check = [&](const std::string& text, const std::string& message, int line,
                         int column) {
    const MeshFileError error = error_of(write(folder, "a.obj", text));
    CAPTURE(text, error.what());
    CHECK(has(error.what(), message));
    CHECK(error.line() == line);
    CHECK(error.column() == column);
    CHECK(error.excerpt().empty() == (line == 0));
  };
  const std::string& p = tetrahedron_positions;
  check("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "'nan' is not a finite number", 2, 5);
  check("v 0 0 0\nv 1 0 -Inf\nv 0 1 0\nf 1 2 3\n", "'-Inf' is not a finite number", 2, 7);
  check("v 0 0 1e999\n", "'1e999' is not a finite number", 1, 7);
  check("v 0 0 1e39\n", "'1e39' is not a finite number", 1, 7);
  check("v 0 0 4" + std::string(38, '0') + "\n", "is not a finite number", 1, 7);
  check("v 0 0 1x\n", "'1x' is not", 1, 7);
  check("v 0 0 1-1\n", "'1-1' is not", 1, 7);
  check("v 0 0\n", "3 numbers are needed, 2 given", 1, 1);
  check(p + "vt\n", "1 number is needed", 5, 1);
  check(p + "vt 0 nan\nf 1 2 3\n", "'nan'", 5, 6);
  check(p + "vn 0 nan 0\nf 1 2 3\n", "'nan'", 5, 6);
  check(p + "f 1 2 3\nf  1 2 5\nf 1 2 6\n", "has 4 vertex positions, but a face uses number 6", 7,
        7);
  check(p + "f 1 2 3\nf 1 2 -5\n", "-5 counts back beyond the first vertex position", 6, 7);
  check(p + "f 0 1 2\n", "'0' is not a corner", 5, 3);
  check(p + "f 1/1 2/1 3/1\n", "has 0 texture coordinates, but a face uses number 1", 5, 3);
  check(p + "vt 0 0\nf 1/1 2/1 3/2\n", "has 1 texture coordinate, but", 6, 11);
  check(p + "f 1//1 2//1 3//1\n", "has 0 normals", 5, 3);
  check(p + "f 1 2 3x\n", "'3x' is not a corner", 5, 7);
  check(p + "f 1 2 99999999999999999999\n", "is not a corner", 5, 7);
  check(p + "f\n", "without corners", 5, 1);
  check(p + "f 1 2 \\\n 3 \\\n 7\n", "uses number 7", 7, 2);
  check(p, "no faces", 0, 0);
  check("", "no faces", 0, 0);
  // Vertices may come after the faces that use them, and numbers in any form.
  CHECK(error_of(write(folder, "a.obj", "f 1 2 3\nv 0 0 +.5\nv 1e0 0 1e-99\nv 0 1. 0\n")).what() ==
        std::string());
}

TEST_CASE("OBJ files with endless polygons or too many triangles are errors") {
  const TemporaryFolder folder;
  std::string text = tetrahedron_positions + "f";
  for (int i = 0; i < 10001; ++i) text += " " + std::to_string(i % 4 + 1);
  CHECK(has(error_of(write(folder, "a.obj", text)).what(), "10000 corners"));
  MeshFileOptions options;
  options.triangles = 3;
  for (const auto& file :
       {write(folder, "b.obj", tetrahedron_positions + tetrahedron_faces),
        write(folder, "b.ply", binary_ply()), write(folder, "b.stl", binary_stl())}) {
    CHECK(has(error_of(file, options).what(), "more than 3 triangles"));
    options.triangles = 4;
    CHECK(error_of(file, options).what() == std::string());
    options.triangles = 3;
  }
  options.file_bytes = 20;
  CHECK(has(error_of(folder / "b.obj", options).what(), "larger than"));
}

TEST_CASE("Broken PLY and STL files are errors") {
  const TemporaryFolder folder;
  const MeshFileError nan_error = error_of(write(folder, "a.ply", ascii_ply("0 0 nan")));
  CHECK(has(nan_error.what(), "'nan' is not a finite number"));
  CHECK(nan_error.line() == 13);
  CHECK(nan_error.column() == 5);
  CHECK(nan_error.excerpt() == "0 0 nan");
  std::string binary_nan = binary_ply();
  const float no_number = NAN;
  std::memcpy(binary_nan.data() + binary_nan.find("end_header") + 11 + 16, &no_number, 4);
  CHECK(has(error_of(write(folder, "a.ply", binary_nan)).what(), "'y' of vertex 1 is not finite"));
  CHECK(
      has(error_of(write(folder, "a.ply", ascii_ply("0 0 1", "3 1 2 4"))).what(), "uses vertex 4"));
  const MeshFileError counts = error_of(write(folder, "a.ply", binary_ply("4000000000")));
  CHECK(has(counts.what(), "too short for 'element vertex 4000000000'"));
  CHECK(counts.line() == 3);
  CHECK(counts.column() == 16);
  CHECK(has(error_of(write(folder, "a.ply", "")).what(), "starts with"));
  CHECK(has(error_of(write(folder, "a.ply", "no\n")).what(), "starts with 'ply'"));
  for (const std::string& whole : {binary_ply(), ascii_ply()})
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
      CAPTURE(size, error_of(write(folder, "a.ply", whole.substr(0, size))).what());
      CHECK_FALSE(error_of(folder / "a.ply").what() == std::string());
    }
  std::string nan = binary_stl();
  std::memcpy(nan.data() + 84 + 12, &no_number, 4);
  CHECK(has(error_of(write(folder, "a.stl", nan)).what(), "not finite"));
  for (const std::size_t size : {0, 20, 83, 84, 100, 200})
    CHECK_FALSE(error_of(write(folder, "a.stl", binary_stl().substr(0, size))).what() ==
                std::string());
}

TEST_CASE("Only known formats are read, by their names") {
  const TemporaryFolder folder;
  CHECK(has(error_of(write(folder, "a.fbx", "")).what(),
            "unknown mesh format '.fbx'; available are .obj, .ply"));
  CHECK(has(error_of(folder / "none.obj").what(), "it does not exist"));
  CHECK(has(error_of(folder.path()).what(), "unknown mesh format"));
  // Not what the name says: no other importer is tried.
  CHECK_FALSE(error_of(write(folder, "a.stl", ascii_ply())).what() == std::string());
  CHECK_FALSE(error_of(write(folder, "b.obj", binary_stl())).what() == std::string());
}

TEST_CASE("OBJ materials load") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "maps");
  write(folder, "maps/wood.png", "never opened");
  write(folder, "a.mtl",
        "newmtl plaster\nKd 0.5 0.6 0.7\nKs 0 0 0\nNs 10\nillum 1\n\n"
        "newmtl varnish\nKd 0.1 0.2 0.3\nKs 0.5 0.5 0.5\nNs 250\nNi 1.4\nillum 2\n"
        "map_Kd maps\\wood.png\nd 0.5\n\n"
        "newmtl window\nKd 0 0 0\nNi 1.33\nillum 7\n\n"
        "newmtl lamp\nKd 0 0 0\nKe 3 2 1\n\n");
  const auto file = write(folder, "a.obj",
                          "mtllib a.mtl\n" + tetrahedron_positions +
                              "vt 0 0\nusemtl plaster\nf 1 3 2\nusemtl varnish\nf 1/1 2/1 4/1\n"
                              "usemtl window\nf 1 4 3\nusemtl lamp\nf 2 3 4\n");
  const MeshFile result = read_mesh_file(file);
  REQUIRE(result.parts.size() == 4);
  REQUIRE(result.emission.size() == result.materials.size());
  const auto material = [&](std::size_t part) {
    return result.materials[result.parts[part].material];
  };
  CHECK(material(0).name == "plaster");
  REQUIRE(std::holds_alternative<DiffuseMaterial>(material(0).model));
  CHECK(std::get<DiffuseMaterial>(material(0).model).reflectance.value == Vec3(0.5F, 0.6F, 0.7F));
  REQUIRE(std::holds_alternative<PlasticMaterial>(material(1).model));
  const auto plastic = std::get<PlasticMaterial>(material(1).model);
  CHECK(plastic.ior == 1.4F);
  CHECK(plastic.roughness.value == Approx(std::pow(2.0 / 252, 0.25)));
  REQUIRE(plastic.reflectance.texture < result.textures.size());
  CHECK(std::get<ImageTexture>(result.textures[plastic.reflectance.texture]).file ==
        folder / "maps/wood.png");
  CHECK(material(1).opacity.value == 0.5F);
  CHECK(result.meshes[result.parts[1].mesh].uvs.size() == 3);
  REQUIRE(std::holds_alternative<GlassMaterial>(material(2).model));
  CHECK(std::get<GlassMaterial>(material(2).model).ior == 1.33F);
  CHECK(result.emission[result.parts[3].material].radiance == Vec3(3, 2, 1));
  CHECK(result.emission[result.parts[0].material].radiance == Vec3(0));

  // Without its materials, the file is one mesh.
  CHECK(read_mesh(file).triangles.size() == 4);

  std::filesystem::remove(folder / "maps/wood.png");
  CHECK_THROWS_WITH(read_mesh_file(file), contains_text("there is no image 'maps/wood.png'"));
}

TEST_CASE("OBJ materials that begin without a name are ignored") {
  const TemporaryFolder folder;
  const auto file = write(
      folder, "a.obj", "mtllib a.mtl\n" + tetrahedron_positions + "usemtl a\n" + tetrahedron_faces);
  for (const char* text : {"Kd 1 0 0\nnewmtl a\nKd 0 1 0\n", "map_Kd none.png\n", "d 1\n", ""}) {
    write(folder, "a.mtl", text);
    CHECK(read_mesh_file(file).parts.size() == 1);
  }
}

TEST_CASE("No file outside of the folder is opened") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scene");
  write(folder, "out.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string body = tetrahedron_positions + "usemtl red\n" + tetrahedron_faces;
  const auto file = write(folder, "scene/a.obj", "mtllib ../out.mtl\n" + body);
  CHECK(read_mesh(file).triangles.size() == 4);
  CHECK_THROWS_WITH(read_mesh_file(file), contains_text("'out.mtl' outside"));
  MeshFileOptions options;
  options.folder = folder.path();
  CHECK(std::get<DiffuseMaterial>(read_mesh_file(file, options).materials.back().model)
            .reflectance.value == Vec3(1, 0, 0));
  write(folder, "scene/a.mtl", "newmtl red\nmap_Kd ../out.png\n");
  write(folder, "scene/b.obj", "mtllib a.mtl\n" + body);
  CHECK_THROWS_WITH(read_mesh_file(folder / "scene/b.obj"),
                    contains_text("'../out.png' lies outside"));
}
