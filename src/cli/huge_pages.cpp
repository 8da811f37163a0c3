// Puts large arrays on huge pages. The first touch of a page costs as much as writing it many
// times, and a tree of a million triangles has more pages of 4 KiB than the TLB holds. Where the
// system leaves the choice to programs, this file chooses pages of 2 MiB. It replaces the global
// allocation functions, as [new.delete] permits, so all containers benefit.
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20U;
// From this size on, at most a third of an allocation is lost to its last page.
constexpr std::size_t large = 2 * huge_page;

std::size_t rounded_up(std::size_t size, std::size_t multiple) {
  return (size + multiple - 1) / multiple * multiple;
}

void* try_allocate(std::size_t size, std::size_t alignment) {
  if (size >= large && size <= SIZE_MAX - huge_page) {
    const std::size_t whole = rounded_up(size, huge_page);
    if (void* memory = std::aligned_alloc(std::max(alignment, huge_page), whole)) {
      ::madvise(memory, whole, MADV_HUGEPAGE);  // only advice: failure does not matter
      return memory;
    }
  }
  if (alignment <= alignof(std::max_align_t)) return std::malloc(std::max<std::size_t>(size, 1));
  if (size > SIZE_MAX - alignment) return nullptr;
  return std::aligned_alloc(alignment, std::max(rounded_up(size, alignment), alignment));
}

void* allocate(std::size_t size, std::size_t alignment) {
  for (;;) {
    if (void* memory = try_allocate(size, alignment)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
