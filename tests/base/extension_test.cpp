#include "base/extension.hpp"

#include "catch.hpp"

using pah::lower_extension;

TEST_CASE("An extension is the last one, in lower case") {
  CHECK(lower_extension("folder.D/Picture.PNG") == ".png");
  CHECK(lower_extension("mesh.tar.Obj") == ".obj");
  CHECK(lower_extension("scene.yaml") == ".yaml");
  CHECK(lower_extension("folder.D/README").empty());
  CHECK(lower_extension(".Hidden").empty());
}

TEST_CASE("Letters beyond ASCII in an extension keep their case") {
  CHECK(lower_extension("a.\xC3\x96X") == ".\xC3\x96x");
}
