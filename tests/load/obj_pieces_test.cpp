#include "catch.hpp"

#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "load/mesh/obj/obj.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;

namespace {

// All that reading an OBJ file gives, or its error.
struct Outcome {
  ObjFile file;
  MeshFile meshes;
  std::string error;
};

Outcome read_in_pieces(const std::filesystem::path& file, std::size_t piece_bytes,
                       std::uint64_t most_triangles = 1'000'000) {
  MeshFileOptions options;
  options.triangles = most_triangles;
  Outcome outcome;
  try {
    outcome.file = read_obj(file, options, piece_bytes);
    make_meshes(outcome.file.polygons, options, outcome.meshes);
  } catch (const MeshFileError& e) {
    outcome.error = std::to_string(e.line()) + ":" + std::to_string(e.column()) + ": " + e.what() +
                    " [" + e.excerpt() + "]";
  }
  return outcome;
}

void check_same(const Outcome& a, const Outcome& b) {
  CHECK(a.error == b.error);
  CHECK(a.file.materials == b.file.materials);
  CHECK(a.file.libraries == b.file.libraries);
  CHECK(a.file.warnings == b.file.warnings);
  REQUIRE(a.meshes.meshes.size() == b.meshes.meshes.size());
  for (std::size_t i = 0; i < a.meshes.meshes.size(); ++i) {
    CHECK(a.meshes.parts[i].material == b.meshes.parts[i].material);
    const Mesh& mesh = a.meshes.meshes[i];
    const Mesh& other = b.meshes.meshes[i];
    CHECK(mesh.positions == other.positions);
    CHECK(mesh.uvs == other.uvs);
    CHECK(mesh.normals == other.normals);
    CHECK(mesh.triangles == other.triangles);
  }
}

// Random statements of every kind, with everything that may stand around and between them.
class RandomObj {
 public:
  explicit RandomObj(unsigned seed) : random_(seed) {}

  std::string text(int statements) {
    const bool returns = below(2) == 0;
    corner_forms_ = below(3);
    std::string text = below(2) == 0 ? "\xEF\xBB\xBF" : "";
    for (int i = 0; i < 4; ++i) text += position() + vector("vt") + vector("vn");
    for (int i = 0; i < statements; ++i) text += statement();
    if (below(2) == 0) text.pop_back();
    if (!returns) return text;
    std::string with_returns;
    for (const char c : text) with_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return with_returns;
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  std::string number() { return std::to_string(below(7) - 3) + "." + std::to_string(below(10)); }
  // Another line in the middle of a statement, or not.
  std::string gap() { return below(12) == 0 ? " \\\n " : below(9) == 0 ? " \t" : " "; }
  std::string end() { return (below(9) == 0 ? " # a comment" : "") + std::string("\n"); }

  std::string vector(const std::string& keyword) {
    return keyword + gap() + number() + gap() + number() + gap() + number() + end();
  }
  std::string position() {
    ++positions_;
    return vector("v");
  }

  std::string face() {
    std::string text = "f";
    const bool back = below(2) == 0;
    for (int i = below(20) == 0 ? 2 : 3 + below(3); i > 0; --i) {
      const std::string corner = std::to_string(back ? -1 - below(4) : 1 + below(4));
      text += gap() + corner;
      if (corner_forms_ == 0) continue;
      const int form = corner_forms_ == 1 ? 3 : below(4);
      const std::string other = corner_forms_ == 1 ? corner : std::to_string(1 + below(4));
      if (form == 1) text += "/" + other;
      if (form == 2) text += "//" + other;
      if (form == 3) text += "/" + other + "/" + other;
    }
    return text + end();
  }

  std::string statement() {
    switch (below(24)) {
      case 0:
        return "# v 1 2 3 \\\n";
      case 1:
        return "\n";
      case 2:
        return "usemtl m" + std::to_string(below(4)) + "\n";
      case 3:
        return "mtllib l" + std::to_string(below(9)) + "\n";
      case 4:
        return "g a \\\nv 1 2 3\n";
      case 5:
        return "curv" + std::to_string(below(9)) + " 1\n";
      case 6:
        return vector("vt");
      case 7:
        return vector("vn");
      case 8: {  // used before it is there
        const std::string next = std::to_string(positions_ + 1);
        return "f 1 2 " + next + "\n" + position();
      }
      default:
        return below(2) == 0 ? position() : face();
    }
  }

  std::mt19937 random_;
  int positions_ = 0;
  int corner_forms_ = 0;  // none, those of positions, any
};

}  // namespace

TEST_CASE("The cuts between OBJ pieces do not change the mesh") {
  const TemporaryFolder folder;
  const auto file = folder / "a.obj";
  constexpr std::size_t whole = 1U << 20;
  int well = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    std::ofstream(file, std::ios::binary) << RandomObj(seed).text(200);
    const Outcome expected = read_in_pieces(file, whole);
    well += expected.error.empty() ? 1 : 0;
    for (const std::size_t bytes : {1, 30, 100, 1000}) {
      CAPTURE(bytes);
      check_same(read_in_pieces(file, bytes), expected);
    }
    check_same(read_in_pieces(file, 30, 60), read_in_pieces(file, whole, 60));
  }
  CHECK(well == 60);
}

TEST_CASE("The first error in an OBJ file is reported, whichever piece it is in") {
  const TemporaryFolder folder;
  const auto file = folder / "a.obj";
  constexpr std::size_t whole = 1U << 20;
  std::mt19937 random(1);
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::string text = RandomObj(seed).text(60);
    for (int faults = 0; faults < 2; ++faults)
      text[random() % text.size()] = "x\\/\n-9 "[random() % 7];
    CAPTURE(text);
    std::ofstream(file, std::ios::binary) << text;
    for (const std::uint64_t triangles : {10, 1000})
      check_same(read_in_pieces(file, 20, triangles), read_in_pieces(file, whole, triangles));
  }
}

TEST_CASE("An endless OBJ line does not hide an earlier error") {
  const TemporaryFolder folder;
  const auto file = folder / "a.obj";
  std::ofstream(file, std::ios::binary) << "v 1 2 3\nv 4 5 6\n#" << std::string(40U << 20, ' ');
  CHECK(read_in_pieces(file, 1U << 17).error.substr(0, 4) == "3:0:");
  std::ofstream(file, std::ios::binary) << "v 1 2 3\nv 4 x 6\n#" << std::string(40U << 20, ' ');
  CHECK(read_in_pieces(file, 1U << 17).error.substr(0, 4) == "2:5:");
}

TEST_CASE("Equal OBJ vertices become one, in the order of their first use") {
  constexpr int side = 100;
  std::string text;
  for (int copy = 0; copy < 2; ++copy)
    for (int i = 0; i < side * side; ++i)
      text += "v " + std::to_string(i % side) + " " + std::to_string(i / side) + " 0\n";
  const auto corner = [](int x, int y) {
    return " " + std::to_string((x + y) % 2 * side * side + y * side + x + 1);
  };
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      text += "f" + corner(x, y) + corner(x + 1, y) + corner(x, y + 1) + "\n";
      text += "f" + corner(x + 1, y) + corner(x + 1, y + 1) + corner(x, y + 1) + "\n";
    }
  // The second copy of this corner is equal, but not the same to the last bit.
  text.replace(text.find("v 0 1 0"), 7, "v 0 1 -0");
  text += "f" + corner(0, 0) + " " + std::to_string(side + 1) + corner(1, 0) + "\n";
  const TemporaryFolder folder;
  std::ofstream(folder / "a.obj", std::ios::binary) << text;
  const Outcome outcome = read_in_pieces(folder / "a.obj", 1U << 12);
  REQUIRE(outcome.meshes.meshes.size() == 1);
  const Mesh& mesh = outcome.meshes.meshes.front();
  CHECK(mesh.positions.size() == side * side);
  std::uint32_t next = 0;
  for (const UVec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      REQUIRE(t[k] <= next);
      next += t[k] == next ? 1 : 0;
    }
}
