#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/parallel_for.hpp"
#include "base/task_group.hpp"
#include "catch.hpp"

using namespace pah;

TEST_CASE("Ranges cover everything once and are no longer than requested", "[threads]") {
  for (const std::size_t count : {0UL, 1UL, 7UL, 64UL, 1000UL}) {
    std::vector<int> visits(count);
    std::atomic<bool> too_long = false;
    parallel_ranges(count, 7, [&](std::size_t first, std::size_t last) {
      if (last - first > 7) too_long = true;
      for (std::size_t i = first; i < last; ++i) ++visits[i];
    });
    CHECK(!too_long);
    CHECK(visits == std::vector<int>(count, 1));
  }
}

TEST_CASE("A fold joins its chunks in their order", "[threads]") {
  const auto digits = [](std::size_t first, std::size_t last) {
    std::string text;
    for (std::size_t i = first; i < last; ++i) text += static_cast<char>('a' + i % 26);
    return text;
  };
  const std::string folded =
      parallel_fold(10'000, 3, std::string(), digits,
                    [](std::string& sum, const std::string& part) { sum += part; });
  CHECK(folded == digits(0, 10'000));
  CHECK(parallel_fold(0, 3, std::string("none"), digits, [](std::string&, const std::string&) {}) ==
        "none");
}

TEST_CASE("A loop rethrows an exception of a part", "[threads]") {
  const auto fail_at_500 = [](std::size_t i) {
    if (i == 500) throw std::runtime_error("at 500");
  };
  CHECK_THROWS_WITH(parallel_for(1000, 1, fail_at_500), "at 500");
}

TEST_CASE("Tasks may run tasks, and waiting ends after the last", "[threads]") {
  std::vector<int> done(1 << 10);
  TaskGroup tasks;
  const std::function<void(std::size_t, std::size_t)> visit = [&](std::size_t first,
                                                                  std::size_t last) {
    if (last - first == 1) {
      ++done[first];
      return;
    }
    const std::size_t middle = (first + last) / 2;
    tasks.run([&visit, first, middle] { visit(first, middle); });
    visit(middle, last);
  };
  visit(0, done.size());
  tasks.wait();
  CHECK(done == std::vector<int>(done.size(), 1));
}

// Hidden: it is for the thread sanitizer to find.
TEST_CASE("A planted data race", "[.race]") {
  std::size_t last = 0;
  // Each task waits for the other, so that two threads run. Relaxed atomics order nothing.
  std::atomic<int> begun = 0;
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  parallel_for(2, 1, [&](std::size_t i) {
    begun.fetch_add(1, std::memory_order_relaxed);
    while (begun.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < give_up)
      std::this_thread::yield();
    last = i;
  });
  CHECK(last < 2);
}
