// Meshes of simple shapes. Each stands upright (y up) and is centered on the origin
// unless noted; winding is counterclockwise seen from outside, so geometric normals point
// out. Closed shapes are watertight: vertices that meet at a seam or pole have equal positions to
// the last bit.
#pragma once

#include <pah/scene/mesh.hpp>
#include <variant>
#include <vector>

namespace pah {

// In the xz plane, normal +y: a floor needs no transform. u runs along +x, v along -z.
struct RectangleShape {
  DVec2 size{1, 1};  // along x and z, meters, > 0
};

// In the xz plane, normal +y.
struct DiskShape {
  double radius = 0.5;  // > 0
  int segments = 64;    // [3, 65536]
};

// Six faces with flat normals; each face has the whole of [0, 1]^2 as its texture coordinates.
struct BoxShape {
  DVec3 size{1, 1, 1};  // > 0
};

// Smooth normals; u runs around y, v from the south pole to the north pole. The vertices lie on the
// sphere, so the mesh is inside of it.
struct SphereShape {
  double radius = 0.5;  // > 0
  int segments = 64;    // around, [3, 8192]
  int rings = 32;       // pole to pole, [2, 8192]
};

// From y = -height / 2 to y = height / 2; smooth around, flat caps.
struct CylinderShape {
  double radius = 0.5;
  double height = 1;
  int segments = 64;   // [3, 65536]
  bool capped = true;  // else an open tube
};

// Base at y = -height / 2, apex at y = height / 2.
struct ConeShape {
  double radius = 0.5;
  double height = 1;
  int segments = 64;
  bool capped = true;
};

// Around the y axis.
struct TorusShape {
  double radius = 0.5;       // of the circle in the middle of the tube
  double tube_radius = 0.2;  // in (0, radius]
  int segments = 64;         // around y, [3, 8192]
  int tube_segments = 32;    // around the tube, [3, 8192]
};

// A sheet over the xz rectangle: columns run along +x, rows along +z (the image's first row is the
// far edge, -z, when seen from the front). Smooth normals.
struct HeightFieldShape {
  DVec2 size{1, 1};            // along x and z
  double height = 1;           // multiplies the heights
  int columns = 0, rows = 0;   // >= 2 each, columns * rows <= 2^31
  std::vector<float> heights;  // by rows, finite
};

using Shape = std::variant<RectangleShape, DiskShape, BoxShape, SphereShape, CylinderShape,
                           ConeShape, TorusShape, HeightFieldShape>;

// The shape as a mesh without a name, with texture coordinates and normals. Throws
// std::invalid_argument, with a message for the user, if a value is out of its range.
[[nodiscard]] Mesh make_mesh(const Shape& shape);

}  // namespace pah
