#include "cli/merge/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

namespace pah::cli {
namespace {

namespace fs = std::filesystem;

std::string described(const PixelRect& rect) {
  return fmt::format("{},{},{},{}", rect.x0, rect.x1, rect.y0, rect.y1);
}

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::min(a.x1, b.x1), std::max(a.y0, b.y0), std::min(a.y1, b.y1)};
}

bool is_empty(const PixelRect& rect) { return rect.x0 >= rect.x1 || rect.y0 >= rect.y1; }

Part read_part(const fs::path& file) {
  FilmFile film = read_film(file);
  if (!film.samples.behind.empty())
    throw FileError(fmt::format(
        "{} was stopped in the middle of a pass: some of its pixels lack samples; render it again",
        file.string()));
  if (film.samples.from == film.samples.to)
    throw FileError(fmt::format("{} has no samples; render it again", file.string()));
  return {file, std::move(film.origin), std::move(film.samples)};
}

// Throws FileError unless the parts agree in everything but their crops.
void check_origin(const Part& part, const Part& first) {
  FilmOrigin origin = part.origin;
  origin.film.crop = first.origin.film.crop;
  const std::vector<std::string> differing = differences(origin, first.origin);
  if (!differing.empty())
    throw FileError(
        fmt::format("{} does not match {}: {}; all parts of a picture must agree in this",
                    part.file.string(), first.file.string(), fmt::join(differing, ", ")));
}

void check_neighbors(const Part& part, const Part& next) {
  if (next.samples.from > part.samples.to) fail_for_gap(part.samples.to, next.samples.from);
  if (next.samples.from < part.samples.to)
    throw FileError(fmt::format(
        "{} and {} overlap: both have sample {}; leave one out, or render it with other --samples",
        part.file.string(), next.file.string(), next.samples.from));
}

// Parts of the same pixels, in the order of their samples.
using Group = std::vector<const Part*>;
using Corners = std::tuple<int, int, int, int>;  // of a rectangle, as a sortable key

std::vector<Group> grouped(const std::vector<Part>& parts) {
  std::map<Corners, Group> by_rect;
  for (const Part& part : parts) {
    const PixelRect rect = pixels_of(part.origin.film);
    by_rect[{rect.y0, rect.x0, rect.y1, rect.x1}].push_back(&part);
  }
  std::vector<Group> groups;
  for (auto& [corners, group] : by_rect) {
    std::ranges::sort(group, {}, [](const Part* part) {
      return std::pair(part->samples.from, part->samples.to);
    });
    groups.push_back(std::move(group));
  }
  return groups;
}

PixelRect rect_of(const Group& group) { return pixels_of(group.front()->origin.film); }

void check_samples(const Group& group, const Group& first) {
  for (std::size_t i = 1; i < group.size(); ++i) check_neighbors(*group[i - 1], *group[i]);
  const int from = group.front()->samples.from, to = group.back()->samples.to;
  const int first_from = first.front()->samples.from, first_to = first.back()->samples.to;
  if (from != first_from || to != first_to)
    throw FileError(
        fmt::format("{} has samples {}:{}, and {} has {}:{}; every pixel needs the same samples",
                    group.front()->file.string(), from, to, first.front()->file.string(),
                    first_from, first_to));
}

void check_apart(const Group& a, const Group& b) {
  const PixelRect both = intersection(rect_of(a), rect_of(b));
  if (is_empty(both)) return;
  throw FileError(fmt::format(
      "{} and {} overlap: both have the pixels {}; leave one out, or render it with another --crop",
      a.front()->file.string(), b.front()->file.string(), described(both)));
}

PixelRect bounds_of(const std::vector<Group>& groups) {
  PixelRect bounds = rect_of(groups.front());
  for (const Group& group : groups) {
    const PixelRect rect = rect_of(group);
    bounds = {std::min(bounds.x0, rect.x0), std::max(bounds.x1, rect.x1),
              std::min(bounds.y0, rect.y0), std::max(bounds.y1, rect.y1)};
  }
  return bounds;
}

std::int64_t pixel_count(const PixelRect& rect) {
  return std::int64_t{rect.width()} * std::int64_t{rect.height()};
}

// Throws FileError with the first pixels within `bounds` that no part covers. Parts do not overlap.
void check_covered(const std::vector<Group>& groups, const PixelRect& bounds) {
  std::int64_t covered = 0;
  std::set<int> columns, rows;
  for (const Group& group : groups) {
    const PixelRect rect = rect_of(group);
    covered += pixel_count(rect);
    columns.insert({rect.x0, rect.x1});
    rows.insert({rect.y0, rect.y1});
  }
  if (covered == pixel_count(bounds)) return;
  for (auto y0 = rows.begin(), y1 = std::next(y0); y1 != rows.end(); y0 = y1++)
    for (auto x0 = columns.begin(), x1 = std::next(x0); x1 != columns.end(); x0 = x1++) {
      const PixelRect cell{*x0, *x1, *y0, *y1};
      const auto has_cell = [&](const Group& group) {
        return !is_empty(intersection(rect_of(group), cell));
      };
      if (std::ranges::none_of(groups, has_cell))
        throw FileError(fmt::format("the pixels {} are missing; render them with --crop {}",
                                    described(cell), described(cell)));
    }
}

}  // namespace

void fail_for_gap(int from, int to) {
  const std::string missing = to - from == 1 ? fmt::format("sample {} is", from)
                                             : fmt::format("samples {} to {} are", from, to - 1);
  throw FileError(fmt::format("{} missing; render with --samples {}:{}", missing, from, to));
}

Parts read_parts(const std::vector<fs::path>& files) {
  Parts result;
  std::vector<Part>& parts = result.parts;
  for (const fs::path& file : files) {
    parts.push_back(read_part(file));
    check_origin(parts.back(), parts.front());
  }
  const std::vector<Group> groups = grouped(parts);
  for (const Group& group : groups) check_samples(group, groups.front());
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t j = i + 1; j < groups.size(); ++j) check_apart(groups[i], groups[j]);
  result.rect = bounds_of(groups);
  check_covered(groups, result.rect);
  result.from = groups.front().front()->samples.from;
  result.to = groups.front().back()->samples.to;
  return result;
}

Film sum_of(const Parts& parts) {
  Film sum = black_film(parts.rect, keeps_features(parts.parts.front().origin.film));
  for (const Part& part : parts.parts) add(sum, read_film(part.file).film);
  return sum;
}

}  // namespace pah::cli
