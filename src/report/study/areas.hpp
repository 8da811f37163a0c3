// The influence areas that the study places around a mesh.
#pragma once

#include "report/study/study.hpp"

namespace pah {

struct StudyArea {
  std::string name;
  StudyGroup group{};
  InfluenceArea area;
};

// Places areas by the mesh's bounding sphere. They cut through the mesh, as areas of scenes do.
[[nodiscard]] std::vector<StudyArea> study_areas(const Aabb& bounds, bool quick);

}  // namespace pah
