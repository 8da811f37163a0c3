#include "cli/render/early_pictures.hpp"

#include <exception>

namespace pah::cli {

void EarlyPictures::show(const Film& film, const Progress& progress) {
  const double began = clock_.seconds();
  if (!schedule_.due(began)) return;
  try_to_write(film, progress);
  schedule_.written(began, clock_.seconds());
}

void EarlyPictures::try_to_write(const Film& film, const Progress& progress) {
  try {
    write_(film, progress);
  } catch (const std::exception& error) {
    if (!warned_)
      warn_(std::string(error.what()) + "; the render continues and will try again later");
    warned_ = true;
  }
}

}  // namespace pah::cli
