#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "geometry/ray_box.hpp"
#include "geometry/rounding.hpp"
#include "light_space/light_grid.hpp"
#include "light_space/outline.hpp"
#include "parallel/parallel_for.hpp"

namespace pah {

namespace {

constexpr std::size_t blocks_a_task = 1024;

// A cell for each triangle that a face sees, so that few are in a cell and few cells are empty.
constexpr double cells_per_triangle = 1;
constexpr double most_cells_across = 16384;

constexpr std::size_t usual_entries_a_block = 12;

// Where large triangles overlap, so many cells would list most of them: then there are fewer cells.
// At last there is one a face, which lists a block once.
constexpr std::uint64_t most_entries_a_block = 32;
static_assert(most_entries_a_block > CubeView::faces);
static_assert(most_entries_a_block * ChildRef::max_blocks < 1ULL << 32U);

std::variant<CubeView, ParallelView> view_of(const ExactBundle& bundle, const Aabb& box) {
  if (const auto* point = std::get_if<PointBundle>(&bundle)) return CubeView(*point);
  return ParallelView(std::get<ParallelBundle>(bundle), box.center());
}

Aabb bounds_of(const Bvh& bvh) {
  return parallel_fold(
      bvh.blocks.size(), blocks_a_task, Aabb{},
      [&](std::size_t first, std::size_t last) {
        Aabb box;
        for (std::size_t i = first; i < last; ++i) {
          for (std::size_t lane = 0; lane < TriangleBlock::width; ++lane)
            box.extend(bvh.blocks[i].triangle(lane).bounds());
        }
        return box;
      },
      [](Aabb& total, const Aabb& box) { total.extend(box); });
}

// How far from a triangle, along every axis of a face, a ray may be that hits it: see the header.
// Axes of the world are those of a cube's faces.
double error_of(const PointBundle& bundle, const Aabb& origins) {
  const DVec3 eye(bundle.eye);
  const DVec3 away =
      glm::max(glm::abs(DVec3(origins.min) - eye), glm::abs(DVec3(origins.max) - eye));
  const DVec3 size = DVec3(origins.max) - DVec3(origins.min);
  return double{rounding_bound(40)} * std::max({away.x, away.y, away.z, size.x, size.y, size.z});
}
double error_of(const ParallelBundle& bundle, const Aabb& origins) {
  const DVec3 size = DVec3(origins.max) - DVec3(origins.min);
  const float rounding = bundle.tangent > 0 ? rounding_bound(52) : rounding_bound(36);
  return std::sqrt(3.0) * double{rounding} * std::max({size.x, size.y, size.z});
}

float rounded_down(double x) {
  const auto rounded = static_cast<float>(x);
  return double{rounded} > x ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                             : rounded;
}

// What a face sees: where, and how many triangles.
struct Extent {
  Range u, v;
  std::size_t triangles = 0;

  void extend(const Extent& other) {
    u.extend(other.u);
    v.extend(other.v);
    triangles += other.triangles;
  }
};
using Extents = std::array<Extent, CubeView::faces>;

// A block in a cell.
struct Entry {
  float nearest;
  PlaceBytes places;
  std::uint32_t block;
};

// An entry before the cells are sorted.
struct Placed {
  std::uint32_t cell;
  Entry entry;
};

template <typename View>
class Builder {
 public:
  Builder(LightGrid& grid, const View& view, double error)
      : grid_(grid), view_(view), error_(error) {}

  void build() {
    const Extents seen = extents();
    for (double density = cells_per_triangle;; density /= 4) {
      lay_out(seen, density);
      if (place()) break;
    }
    sort();
  }

 private:
  // Of the triangles of a block on a face.
  struct Outlines {
    std::array<Outline, TriangleBlock::width> of;
    std::size_t size = 0;
  };

  [[nodiscard]] static std::size_t triangles_in(const TriangleBlock& block) {
    std::size_t count = 1;
    while (count < TriangleBlock::width && block.indices[count] != block.indices[count - 1])
      ++count;
    return count;
  }

  // Whether rays come from where the face sees something of a box: what is sure not to be seen
  // there need not be projected.
  [[nodiscard]] bool may_see(int face, const Aabb& box) const {
    if constexpr (std::is_same_v<View, CubeView>) {
      if (grid_.faces[static_cast<std::size_t>(face)].columns == 0 && is_laid_out_) return false;
      const DVec3 p = view_.local(face, DVec3(box.min)), q = view_.local(face, DVec3(box.max));
      const DVec3 low = glm::min(p, q), high = glm::max(p, q);
      // At twice the tangent of the border there is room for all errors.
      return high.z > 0 && low.x <= 2 * high.z && high.x >= -2 * high.z && low.y <= 2 * high.z &&
             high.y >= -2 * high.z;
    }
    return true;
  }

  // Calls `use(face, outlines)` for every face that sees something of the block.
  template <typename Use>
  void for_each_face(const TriangleBlock& block, const Use& use) const {
    const std::size_t count = triangles_in(block);
    Aabb box;
    for (std::size_t i = 0; i < count; ++i) box.extend(block.triangle(i).bounds());
    for (int face = 0; face < View::faces; ++face) {
      if (!may_see(face, box)) continue;
      Outlines outlines;
      for (std::size_t i = 0; i < count; ++i) {
        if (const auto outline = outline_on(view_, face, block.triangle(i), error_))
          outlines.of[outlines.size++] = *outline;
      }
      if (outlines.size > 0) use(face, outlines);
    }
  }

  [[nodiscard]] Extents extents() const {
    if constexpr (std::is_same_v<View, ParallelView>) {
      return {extent_of_box()};
    } else {
      return extents_of_outlines();
    }
  }

  // Of the corners of the box that holds all: a little more than is seen, and nothing to be looked
  // for.
  [[nodiscard]] Extent extent_of_box() const {
    Extent extent{{}, {}, TriangleBlock::width * grid_.bvh->blocks.size()};
    const Aabb& box = grid_.origins;
    for (int corner = 0; corner < 8; ++corner) {
      const DVec3 at((corner & 1) != 0 ? box.max.x : box.min.x,
                     (corner & 2) != 0 ? box.max.y : box.min.y,
                     (corner & 4) != 0 ? box.max.z : box.min.z);
      const DVec3 local = view_.local(0, at);
      extent.u.extend(local.x);
      extent.v.extend(local.y);
    }
    return extent;
  }

  [[nodiscard]] Extents extents_of_outlines() const {
    return parallel_fold(
        grid_.bvh->blocks.size(), blocks_a_task, Extents{},
        [&](std::size_t first, std::size_t last) {
          Extents extents;
          for (std::size_t i = first; i < last; ++i) {
            for_each_face(grid_.bvh->blocks[i], [&](int face, const Outlines& outlines) {
              Extent& extent = extents[static_cast<std::size_t>(face)];
              for (std::size_t k = 0; k < outlines.size; ++k) {
                const Outline& outline = outlines.of[k];
                for (std::size_t vertex = 0; vertex < outline.size; ++vertex) {
                  for (const double margin : {-outline.margin, outline.margin}) {
                    extent.u.extend(outline.vertices[vertex].x + margin);
                    extent.v.extend(outline.vertices[vertex].y + margin);
                  }
                }
              }
              extent.triangles += outlines.size;
            });
          }
          return extents;
        },
        [](Extents& total, const Extents& part) {
          for (std::size_t face = 0; face < total.size(); ++face) total[face].extend(part[face]);
        });
  }

  void lay_out(const Extents& extents, double density) {
    std::uint32_t cells = 0;
    for (std::size_t i = 0; i < extents.size(); ++i) {
      const Extent& extent = extents[i];
      if (extent.triangles == 0) continue;
      const Range u = common(extent.u, view_.limits(static_cast<int>(i), 0));
      const Range v = common(extent.v, view_.limits(static_cast<int>(i), 1));
      if (u.empty() || v.empty()) continue;
      GridFace& face = grid_.faces[i];
      face.u = rounded_down(u.min);
      face.v = rounded_down(v.min);
      const double width = u.max - double{face.u}, height = v.max - double{face.v};
      const double wanted =
          std::sqrt(density * static_cast<double>(extent.triangles) / (width * height));
      face.per_length = static_cast<float>(
          GridFace::places * std::min(wanted, most_cells_across / std::max(width, height)));
      const auto count = [&](double length) {
        return static_cast<std::uint32_t>(length * double{face.per_length} / GridFace::places) + 1;
      };
      face.columns = count(width);
      face.rows = count(height);
      face.first_cell = cells;
      cells += face.columns * face.rows;
    }
    grid_.cells.resize(cells + std::size_t{1});
    is_laid_out_ = true;
  }

  // The places along a row or column of cells that a range has, if any.
  struct Places {
    std::uint32_t first, last;

    [[nodiscard]] std::uint32_t first_cell() const { return first / GridFace::places; }
    [[nodiscard]] std::uint32_t last_cell() const { return last / GridFace::places; }
    // Within one cell that has some of them.
    [[nodiscard]] std::uint32_t first_in(std::uint32_t cell) const {
      return cell == first_cell() ? first % GridFace::places : 0;
    }
    [[nodiscard]] std::uint32_t last_in(std::uint32_t cell) const {
      return cell == last_cell() ? last % GridFace::places : GridFace::places - 1;
    }
  };
  [[nodiscard]] static std::optional<Places> places_of(const Range& range, double first,
                                                       double per_length, std::uint32_t cells) {
    const auto most = static_cast<double>(cells) * GridFace::places;
    const double low = std::floor((range.min - first) * per_length);
    const double high = std::floor((range.max - first) * per_length);
    if (!(low < most && high >= 0)) return {};
    return Places{static_cast<std::uint32_t>(std::max(low, 0.0)),
                  static_cast<std::uint32_t>(std::min(high, most - 1))};
  }

  // Calls `use(cell, entry)` for every cell that sees something of the block.
  template <typename Use>
  void for_each_cell(const GridFace& face, std::uint32_t block, const Outlines& outlines,
                     const Use& use) const {
    Range v;
    for (std::size_t i = 0; i < outlines.size; ++i) {
      const Outline& outline = outlines.of[i];
      v.extend(outline.lowest_v() - outline.margin);
      v.extend(outline.highest_v() + outline.margin);
    }
    const auto rows = places_of(v, face.v, face.per_length, face.rows);
    if (!rows) return;
    const double side = GridFace::places / double{face.per_length};
    for (std::uint32_t row = rows->first_cell(); row <= rows->last_cell(); ++row) {
      const Range strip{face.v + row * side, face.v + (row + 1) * side};
      Range u;
      for (std::size_t i = 0; i < outlines.size; ++i) u.extend(across(outlines.of[i], strip));
      const auto columns = places_of(u, face.u, face.per_length, face.columns);
      if (!columns) continue;
      const std::uint32_t cells = face.first_cell + row * face.columns;
      const std::uint32_t first = columns->first_cell(), last = columns->last_cell();
      for (std::uint32_t column = first; column <= last; ++column) {
        const DVec2 center(face.u + (column + 0.5) * side, strip.min + 0.5 * side);
        const double nearest = nearest_in(center, 0.5 * side, outlines);
        use(cells + column, Entry{stored(nearest),
                                  place_bytes(columns->first_in(column), columns->last_in(column),
                                              rows->first_in(row), rows->last_in(row)),
                                  block});
      }
    }
  }

  // A bound of the depths in a cell, given its center and half its side.
  [[nodiscard]] double nearest_in(const DVec2& center, double half,
                                  const Outlines& outlines) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outlines.size; ++i) {
      const Outline& outline = outlines.of[i];
      const double middle = outline.offset + glm::dot(outline.slope, center);
      const double change =
          (std::abs(outline.slope.x) + std::abs(outline.slope.y)) * (half + outline.margin);
      double bound = outline.nearest;
      if (std::is_same_v<View, CubeView>) {
        if (middle + change > 0) bound = 1 / (middle + change);
      } else {
        bound = middle - change;
      }
      nearest = std::min(nearest, std::max(bound, outline.nearest));
    }
    return nearest;
  }

  // The origin's depth is compared, which a hit's may exceed by an error: another covers what the
  // plane of a triangle is off.
  [[nodiscard]] float stored(double nearest) const { return rounded_down(nearest - 2 * error_); }

  // False if that takes too many entries.
  [[nodiscard]] bool place() {
    const std::size_t blocks = grid_.bvh->blocks.size();
    const std::uint64_t most = most_entries_a_block * blocks;
    std::atomic<std::uint64_t> total = 0;
    tasks_.assign((blocks + blocks_a_task - 1) / blocks_a_task, {});
    counts_ = std::vector<std::atomic<std::uint32_t>>(grid_.cells.size());
    parallel_for(tasks_.size(), 1, [&](std::size_t task) {
      std::vector<Placed>& placed = tasks_[task];
      placed.reserve(usual_entries_a_block * blocks_a_task);
      const std::size_t last = std::min((task + 1) * blocks_a_task, blocks);
      std::size_t counted = 0;
      for (std::size_t i = task * blocks_a_task; i < last; ++i) {
        if (total.fetch_add(placed.size() - counted, std::memory_order_relaxed) > most) return;
        counted = placed.size();
        for_each_face(grid_.bvh->blocks[i], [&](int face, const Outlines& outlines) {
          for_each_cell(grid_.faces[static_cast<std::size_t>(face)], static_cast<std::uint32_t>(i),
                        outlines, [&](std::uint32_t cell, const Entry& entry) {
                          placed.push_back({cell, entry});
                          counts_[cell].fetch_add(1, std::memory_order_relaxed);
                        });
        });
      }
      total.fetch_add(placed.size() - counted, std::memory_order_relaxed);
    });
    return total <= most;
  }

  void sort() {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
      grid_.cells[i] = {sum, 0};
      sum += counts_[i].exchange(0, std::memory_order_relaxed);
    }
    std::vector<Entry> entries(sum);
    parallel_for(tasks_.size(), 1, [&](std::size_t task) {
      for (const Placed& placed : tasks_[task]) {
        const std::uint32_t before = counts_[placed.cell].fetch_add(1, std::memory_order_relaxed);
        entries[grid_.cells[placed.cell].first + before] = placed.entry;
      }
      tasks_[task] = {};
    });
    grid_.lists.resize(std::size_t{3} * sum + LightGrid::read_beyond);
    parallel_for(grid_.cells.size(), 4096, [&](std::size_t i) {
      GridCell& cell = grid_.cells[i];
      cell.count = counts_[i].load(std::memory_order_relaxed);
      if (cell.count == 0) return;
      const std::span list(&entries[cell.first], cell.count);
      std::ranges::sort(list, {}, [](const Entry& e) { return std::pair(e.nearest, e.block); });
      std::uint32_t* const words = &grid_.lists[std::size_t{3} * cell.first];
      for (std::size_t k = 0; k < cell.count; ++k) {
        words[k] = std::bit_cast<std::uint32_t>(list[k].nearest);
        words[cell.count + k] = list[k].places;
        words[2 * std::size_t{cell.count} + k] = list[k].block;
      }
    });
    grid_.nearest = nearest_listed();
    if constexpr (std::is_same_v<View, CubeView>) {
      if (view_.is_cone()) grid_.cells.back().count = GridCell::unknown;
    }
  }

  [[nodiscard]] float nearest_listed() const {
    float nearest = std::numeric_limits<float>::infinity();
    for (const GridCell& cell : grid_.cells) {
      if (cell.count > 0)
        nearest = std::min(nearest, std::bit_cast<float>(grid_.lists[std::size_t{3} * cell.first]));
    }
    return nearest;
  }

  LightGrid& grid_;
  const View& view_;
  double error_;
  bool is_laid_out_ = false;
  std::vector<std::vector<Placed>> tasks_;
  std::vector<std::atomic<std::uint32_t>> counts_;
};

// Blocks with something nearer to the eye than faces show, by their boxes.
std::vector<std::uint32_t> blocks_near(const Bvh& bvh, const Vec3& eye, double distance) {
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i < bvh.blocks.size(); ++i) {
    Aabb box;
    for (std::size_t lane = 0; lane < TriangleBlock::width; ++lane)
      box.extend(bvh.blocks[i].triangle(lane).bounds());
    const DVec3 gap = glm::max(DVec3(box.min) - DVec3(eye), DVec3(eye) - DVec3(box.max));
    if (std::max({gap.x, gap.y, gap.z}) < distance) near.push_back(static_cast<std::uint32_t>(i));
  }
  return near;
}

}  // namespace

LightGrid::LightGrid(const Bvh& over, const ExactBundle& bundle)
    : bvh(&over), view(view_of(bundle, bounds_of(over))) {
  const Aabb box = bounds_of(over);
  // Rays start on triangles, or a little off them.
  const float around = 0x1p-10F * (box.empty() ? 0 : largest_of(box.extent()));
  origins = {box.min - around, box.max + around};
  const double error = std::visit([&](const auto& b) { return error_of(b, origins); }, bundle);
  if (!(around > 0) || !std::isfinite(error)) {
    origins = {};
    cells.resize(1);
    return;
  }
  std::visit([&](const auto& any) { Builder(*this, any, error).build(); }, view);
  if (const auto* point = std::get_if<PointBundle>(&bundle))
    near_blocks = blocks_near(over, point->eye, (nearest_on_faces + 4) * error);
}

}  // namespace pah
