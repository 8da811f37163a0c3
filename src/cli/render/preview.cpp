#include "cli/render/preview.hpp"

namespace pah::cli {
namespace {

constexpr int factor = 4;

int shrink_up(int pixels) { return (pixels + factor - 1) / factor; }
int shrink_down(int pixels) { return pixels / factor; }

}  // namespace

FilmSettings preview_of(FilmSettings film) {
  film.width = shrink_up(film.width);
  film.height = shrink_up(film.height);
  if (film.crop)
    film.crop = PixelRect{shrink_down(film.crop->x0), shrink_up(film.crop->x1),
                          shrink_down(film.crop->y0), shrink_up(film.crop->y1)};
  return film;
}

}  // namespace pah::cli
