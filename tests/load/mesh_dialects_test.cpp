// Mesh files as all sorts of programs write them: each is the same square, or it is an error.
#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <pah/load/mesh_file.hpp>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "support/mutate.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;

namespace {

// The corners of a mesh's triangles, in no order, each triangle from its smallest corner on.
std::vector<std::array<float, 9>> soup_of(const Mesh& mesh) {
  std::vector<std::array<float, 9>> soup;
  for (const UVec3& t : mesh.triangles) {
    std::array<Vec3, 3> p{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    const auto less = [](const Vec3& a, const Vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::rotate(p.begin(), std::min_element(p.begin(), p.end(), less), p.end());
    soup.push_back({p[0].x, p[0].y, p[0].z, p[1].x, p[1].y, p[1].z, p[2].x, p[2].y, p[2].z});
  }
  std::sort(soup.begin(), soup.end());
  return soup;
}

Mesh read(const TemporaryFolder& folder, const std::string& extension, const std::string& bytes) {
  const auto file = folder / ("a." + extension);
  std::ofstream(file, std::ios::binary) << bytes;
  return read_mesh(file);
}

const std::array<Vec3, 4> square{Vec3{0.5F, 0, 0}, {1.25F, 0, 0}, {1.25F, 1, -2}, {0.5F, 1, -2}};

template <class T>
void append(std::string& bytes, const T& value, bool big_endian = false) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

void check_square(const Mesh& mesh) {
  const auto triangle = [](int a, int b, int c) {
    Mesh one;
    one.positions = {square.begin(), square.end()};
    one.triangles.emplace_back(a, b, c);
    return soup_of(one).front();
  };
  std::vector<std::array<float, 9>> expected{triangle(0, 1, 2), triangle(0, 2, 3)};
  std::vector<std::array<float, 9>> other{triangle(0, 1, 3), triangle(1, 2, 3)};
  std::sort(expected.begin(), expected.end());
  std::sort(other.begin(), other.end());
  const auto soup = soup_of(mesh);
  CHECK((soup == expected || soup == other));
  // Seams, where some corners have texture coordinates or normals and some have none.
  const bool seams = !mesh.normals.empty() || !mesh.uvs.empty();
  CHECK((mesh.positions.size() == 4 || (seams && mesh.positions.size() == 6)));
}

// Positions as properties of `type`, corners as a list of `index` behind a `count`.
template <class Real, class Count, class Index>
std::string binary_ply(const std::string& real, const std::string& count, const std::string& index,
                       bool big_endian, const std::string& line_end = "\n") {
  const auto line = [&](const std::string& text) { return text + line_end; };
  std::string bytes =
      line("ply") +
      line(big_endian ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0") +
      line("comment made by hand") + line("element vertex 4") + line("property " + real + " x") +
      line("property " + real + " y") + line("property uchar red") +
      line("property " + real + " z") + line("element face 1") +
      line("property list " + count + " " + index + " vertex_indices") + line("end_header");
  for (const Vec3& p : square) {
    append(bytes, static_cast<Real>(p.x), big_endian);
    append(bytes, static_cast<Real>(p.y), big_endian);
    append(bytes, std::uint8_t{10});
    append(bytes, static_cast<Real>(p.z), big_endian);
  }
  append(bytes, Count{4}, big_endian);
  for (int i = 0; i < 4; ++i) append(bytes, static_cast<Index>(i), big_endian);
  return bytes;
}

}  // namespace

TEST_CASE("OBJ dialects load") {
  const TemporaryFolder folder;
  const std::string v = "v 0.5 0 0\nv 1.25 0 0\nv 1.25 1 -2\nv 0.5 1 -2\n";
  const std::string f = "f 1 2 3 4\n";
  const std::string triangles = "f 1 2 3\nf 1 3 4\n";
  for (const std::string& text : std::vector<std::string>{
           v + f,
           v + triangles,
           v + "f 1 2 3 4",                    // no last line end
           "\xEF\xBB\xBF" + v + f,             // byte-order mark
           "\xEF\xBB\xBF# comment\n" + v + f,  //
           "v 0.5 0 0\r\nv 1.25 0 0\r\nv 1.25 1 -2\r\nv 0.5 1 -2\r\nf 1 2 3 4\r\n",
           "v 0.5 0 0\rv 1.25 0 0\rv 1.25 1 -2\rv 0.5 1 -2\rf 1 2 3 4\r",
           std::string("v .5 0 0\nv 1.25 0. .0\nv +1.25 1 -2.\nv 5e-1 1E0 -.2e+1\n") + f,
           " v 0.5 0 0\n\tv 1.25 0 0\n  v 1.25 1 -2\n v 0.5 1 -2\n f 1 2 3 4\n",
           "v\t0.5\t0 \t0\nv 1.25 0 0 \nv  1.25  1  -2\t\nv 0.5 1 -2\nf\t1 2\t3 4 \n",
           "v 0.5 0 0 1\nv 1.25 0 0 1.0\nv 1.25 1 -2 2\nv 0.5 1 -2 1\n" + f,  // weights
           "v 0.5 0 0 1 0 0\nv 1.25 0 0 0 1 0\nv 1.25 1 -2 0 0 1\nv 0.5 1 -2 1 1 1\n" + f,
           "v 0.5 0 0 1 1 0 0\nv 1.25 0 0 1 0 1 0\nv 1.25 1 -2 1 0 0 1\nv 0.5 1 -2 1 1 1 1\n" + f,
           v + "vt 0.5\nf 1/1 2/1 3/1 4/1\n",                       // one coordinate
           v + "vt 0 1 0\nf 1/1 2/1 3/1 4/1\n",                     // three
           v + "vn 0 2 1\nf 1//1 2//1 3//1 4//1\n",                 //
           v + "vt 0 1\nvn 0 2 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\n",     //
           v + "vt 0 1\nvn 0 2 1\nf 1/1/1 2/1/1 3/1/1\nf 1 3 4\n",  // some without
           v + "vt 0 1\nvn 0 2 1\nf 1 2 3\nf 1/1/1 3/1/1 4/1/1\n",  //
           v + "vt 0 1\nf 1/ 2/ 3/ 4/\n",                           //
           v + "vn 0 0 0\nf 1//1 2//1 3//1 4//1\n",                 // normals of no length
           v + "f -4 -3 -2 -1\n",                                   // counted back
           "v 9 9 9\n" + v + "f -4 3 4 -1\n",                       // mixed
           f + v,                                                   // faces first
           v + "f 1 \\\n2 3 \\\n 4\n",                              // joined lines
           "v 0.5 \\\r\n0 0\r\nv 1.25 0 0\r\nv 1.25 1 -2\r\nv 0.5 1 -2\r\nf 1 2 3 4\r\n",
           "# C:\\meshes\\\n" + v + f,      // a comment joins nothing
           v + "f 1 2 3 4 # the square\n",  //
           v + f + "#\n#\n",                //
           "mtllib a b.mtl\no a\ng b c\ns 1\nusemtl d\n" + v + f + "s off\ng\n",
           v + "usemtl x\nf 1 2 3\nusemtl y\nf 1 3 4\nusemtl x\n",  //
           v + "g a\nf 1 2 3\ng b\nf 1 3 4\n",                      //
           v + "fo 1 2 3 4\n",                                      // an old name of f
           v + "l 1 2\np 1 2 3\nf 1 2\nf 3\n" + f,                  // lines and points
           v + "vp 0 1\nmg 1 2\nlod 1\nbevel on\n" + f,             //
           v + "curv 0 1 1 2\nparm u 0 1\nend\n" + f,               // curves are left out
           "v 0.5000000000000000000000 0 0\nv 1.25000000000000000001 0 0\n"
           "v 1250000000000000000000e-21 1 -2\nv 0.5 1 -2\n" +
               f,
           "v 0.5 0 1e-60\nv 1.25 0 -1e-400\nv 1.25 1 -2\nv 0.5 1 -2\n" + f}) {
    CAPTURE(text);
    check_square(read(folder, "obj", text));
  }
}

TEST_CASE("PLY dialects load") {
  const TemporaryFolder folder;
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string vertex = "element vertex 4\n" + xyz;
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string strip = "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string v = "0.5 0 0\n1.25 0 0\n1.25 1 -2\n0.5 1 -2\n";
  const std::string plain = head + vertex + face + "end_header\n" + v + "4 0 1 2 3\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = plain;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
    REQUIRE(text != plain);
    return text;
  };
  for (const std::string& bytes : std::vector<std::string>{
           plain, with("\n", "\r\n"), with("\n", "\r"), with("vertex_indices", "vertex_index"),
           with("float", "double"), with("float", "float32"), with("uchar int", "uint8 int32"),
           with("property float x", "comment a\nproperty float x"),
           with("end_header", "obj_info b\nend_header"), with("1.25", "+1.25e0"), with("0.5", ".5"),
           with("0 1 2 3\n", "0 1 2 3"), with("0.5 1", "  0.5\t1"),
           with("4 0 1 2 3\n", "\n4 0 1 2 3 \n\n"),
           // Faces before vertices.
           head + face + vertex + "end_header\n4 0 1 2 3\n" + v,
           // Other elements and properties, of any length.
           head + "element camera 1\nproperty list int float eye\nproperty short n\n" + vertex +
               "element edge 2\nproperty int a\nproperty int b\n" + face +
               "property uchar flags\nend_header\n3 1 2 3 7\n" + v + "0 1\n1 2\n4 0 1 2 3 9\n",
           // What is left out may be no number.
           head + vertex + "property float quality\n" + face +
               "end_header\n0.5 0 0 nan\n1.25 0 0 inf\n1.25 1 -2 x\n0.5 1 -2 0\n4 0 1 2 3\n",
           head + vertex + strip + "end_header\n" + v + "4 0 1 3 2\n",
           head + vertex + strip + "end_header\n" + v + "8 0 1 2 -1 0 2 3 -1\n",
           binary_ply<float, std::uint8_t, std::int32_t>("float", "uchar", "int", false),
           binary_ply<float, std::uint8_t, std::int32_t>("float", "uchar", "int", true),
           binary_ply<double, std::int32_t, std::uint16_t>("double", "int", "ushort", false),
           binary_ply<double, std::uint16_t, std::int8_t>("float64", "uint16", "int8", true),
           binary_ply<float, std::uint8_t, std::uint32_t>("float", "uchar", "uint", false, "\r\n"),
           binary_ply<float, std::uint8_t, std::uint32_t>("float", "uchar", "uint", false, "\r")}) {
    CAPTURE(bytes);
    check_square(read(folder, "ply", bytes));
  }
}

TEST_CASE("A PLY vertex may begin with a byte that looks like a line end") {
  const TemporaryFolder folder;
  for (const std::string line_end : {"\n", "\r\n", "\r"})
    for (const char first : {'\n', '\r', ' '}) {
      std::string bytes =
          binary_ply<float, std::uint8_t, std::int32_t>("float", "uchar", "int", false, line_end);
      const std::string end = "end_header" + line_end;
      const std::size_t data = bytes.find(end) + end.size();
      bytes[data] = first;
      float x = 0;
      std::memcpy(&x, bytes.data() + data, 4);
      const Mesh mesh = read(folder, "ply", bytes);
      REQUIRE(mesh.positions.size() == 4);
      CHECK(mesh.positions[0] == Vec3(x, 0, 0));
    }
}

TEST_CASE("PLY texture coordinates load from vertices, under any name, and from corners") {
  const TemporaryFolder folder;
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 4\n";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string face = "property list uchar int vertex_indices\n";
  const std::vector<std::pair<std::string, std::string>> names{
      {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}};
  for (const auto& [u, v] : names) {
    const Mesh mesh =
        read(folder, "ply",
             head + "property float " + u + "\nproperty float " + v + "\n" + xyz +
                 "element face 1\n" + face +
                 "end_header\n0 0 0.5 0 0\n1 0 1.25 0 0\n1 1 1.25 1 -2\n0 1 0.5 1 -2\n"
                 "4 0 1 2 3\n");
    check_square(mesh);
    REQUIRE(mesh.uvs.size() == 4);
    CHECK(mesh.uvs[2] == Vec2(1, 1));
  }
  const Mesh mesh = read(folder, "ply",
                         head + xyz + "element face 3\n" + face +
                             "property list uchar float texcoord\nend_header\n"
                             "0.5 0 0\n1.25 0 0\n1.25 1 -2\n0.5 1 -2\n"
                             "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 1 1 0.5 1\n3 0 1 3 0\n");
  REQUIRE(mesh.triangles.size() == 3);
  CHECK(mesh.positions.size() == 6);  // two corners of the last have none
  CHECK(mesh.uvs[mesh.triangles[1].z] == Vec2(0.5F, 1));
}

TEST_CASE("STL dialects load") {
  const TemporaryFolder folder;
  const auto facet = [](int a, int b, int c) {
    std::string text = "facet normal 0 0 0\n outer loop\n";
    for (const int i : {a, b, c})
      text += "  vertex " + std::to_string(square[i].x) + " " + std::to_string(square[i].y) + " " +
              std::to_string(square[i].z) + "\n";
    return text + " endloop\nendfacet\n";
  };
  const std::string facets = facet(0, 1, 2) + facet(0, 2, 3);
  std::string capitals = "SOLID a\n" + facets;
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  std::string returns = "solid a\n" + facets + "endsolid a\n";
  for (std::size_t at = 0; (at = returns.find('\n', at)) != std::string::npos; at += 2)
    returns.replace(at, 1, "\r\n");
  // Binary files whose header begins like a text's.
  std::string binary = "solid binary after all";
  binary.resize(80, ' ');
  append(binary, std::uint32_t{2});
  for (const UVec3& t : {UVec3{0, 1, 2}, UVec3{0, 2, 3}}) {
    append(binary, Vec3(0, 0, 1));
    for (int k = 0; k < 3; ++k) append(binary, square[t[k]]);
    append(binary, std::uint16_t{0});
  }
  for (const std::string& bytes : std::vector<std::string>{
           "solid a\n" + facets + "endsolid a\n", "solid\n" + facets, capitals, returns,
           "solid a\n" + facet(0, 1, 2) + "endsolid a\nsolid b\n" + facet(0, 2, 3) + "endsolid b\n",
           binary, std::string(binary).replace(0, 5, "other")}) {
    CAPTURE(bytes);
    check_square(read(folder, "stl", bytes));
  }
}

TEST_CASE("Unsupported features of a mesh file are named") {
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& extension, const std::string& bytes) {
    const auto file = folder / ("a." + extension);
    std::ofstream(file, std::ios::binary) << bytes;
    std::string text;
    for (const std::string& warning : read_mesh_file(file).warnings) text += warning + "\n";
    return text;
  };
  const std::string v = "v 0.5 0 0\nv 1.25 0 0\nv 1.25 1 -2\nv 0.5 1 -2\n";
  CHECK(warnings("obj", v + "f 1 2 3 4\n") == "");
  CHECK(warnings("obj", v + "f 1 2 3 4\ncurv2 1\ncurv2 2\n") ==
        "'curv2', first in line 6, cannot be read and is left out\n");
  CHECK(warnings("obj", "mtllib none.mtl\n" + v + "usemtl a\nf 1 2 3 4\n") ==
        "there is no material library 'none.mtl': its materials are gray\n");
  std::ofstream(folder / "a b.mtl")
      << "\xEF\xBB\xBFnewmtl a\nKd 1 0 0\naniso 0.5\nmap_Bump x.png\n";
  CHECK(warnings("obj", "mtllib a b.mtl\n" + v + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n") ==
        "a b.mtl: 'aniso', 'map_Bump' is not supported and is left out\n"
        "no material library has 'b', used by faces: gray instead\n");
  const std::string binary =
      binary_ply<float, std::uint8_t, std::int32_t>("float", "uchar", "int", false);
  CHECK(warnings("ply", binary) == "");
  CHECK(warnings("ply", binary + "abc") ==
        "3 bytes exceed what the header declares, and are left out\n");
}

TEST_CASE("A mesh file in which the counts do not agree is an error") {
  const TemporaryFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK_NOTHROW(read(folder, "ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
  CHECK_THROWS_WITH(read(folder, "ply", head + "0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n"),
                    contains_text("more numbers than vertex 0 has"));
  CHECK_THROWS_WITH(read(folder, "ply", head + "0 0 0\n1 0 0\n0 1 0\n2 0 1 2\n"),
                    contains_text("more numbers than face 0 has"));
  CHECK_THROWS_WITH(read(folder, "ply", head + "0 0 0\n1 0 0\n0 1 0\n"),
                    contains_text("ends before face 0 of 1"));
  CHECK_THROWS_WITH(
      read(folder, "ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n0\n0\n0\n"),
      contains_text("no x, y and z"));
  CHECK_THROWS_WITH(
      read(folder, "ply",
           std::string(head).insert(
               21, "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n") +
               "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
      contains_text("two elements 'vertex'"));
}

TEST_CASE("Mutated mesh files are meshes or errors") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> seeds{
      {"obj",
       "mtllib a.mtl\nv 0.5 0 0\nv 1.25 0 0 1\nv 1.25 1 -2\nv 0.5 1 -2\nvt 0.5\nvn 0 1 1\n"
       "usemtl a\nf 1/1/1 2/1/1 3//1 -1\nf 1 2 \\\n3\n"},
      {"ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
       "float z\nproperty float u\nproperty float v\nelement face 1\nproperty list uchar int "
       "vertex_indices\nproperty list uchar float texcoord\nelement tristrips 1\nproperty list int "
       "int vertex_indices\nend_header\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n3 0 1 2 6 0 0 1 1 0 0\n"
       "5 0 1 2 -1 0\n"},
      {"ply", binary_ply<float, std::uint8_t, std::int32_t>("float", "uchar", "int", false)},
      {"stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
       "endloop\nendfacet\nendsolid a\n"},
      {"mtl", "newmtl a\nKd 1 0 0\nKs 1\nNs 20\nd -halo 0.5\nillum 2\nmap_Kd -s 1 2 -o 1 a.png\n"}};
  std::ofstream(folder / "a.png") << "never opened";
  std::mt19937 random(1);
  int read_well = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto& [extension, seed] = seeds[i % seeds.size()];
    const std::string bytes = mutated(seed, random, "0 9-.e/\n\\#");
    std::ofstream(folder / ("a." + extension), std::ios::binary) << bytes;
    CAPTURE(extension, bytes);
    try {
      const MeshFile file =
          read_mesh_file(folder / (extension == "mtl" ? "a.obj" : "a." + extension));
      ++read_well;
      for (const Mesh& mesh : file.meshes) {
        REQUIRE_FALSE(mesh.triangles.empty());
        for (const UVec3& t : mesh.triangles)
          REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
      }
      for (const MeshFilePart& part : file.parts) REQUIRE(part.material < file.materials.size());
    } catch (const MeshFileError&) {
      continue;
    }
  }
  CHECK(read_well > 300);
}
