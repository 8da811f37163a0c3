// Progress bars and heartbeats of a running render.
#include "cli/terminal/progress.hpp"

#include "catch.hpp"
#include "program.hpp"
#include "support/temporary_folder.hpp"

using namespace pah;
using namespace pah::cli;
using namespace pah::test;

namespace {

// A quarter of 64 samples is done after 5 of 20 seconds.
const Progress quarter{0.25, 5, 10'000'000, 16};

}  // namespace

TEST_CASE("The progress bar shows as much as fits") {
  const RenderGoal goal{64, 0};
  CHECK(format_progress(quarter, goal, 79) ==
        "[#####...............] 25 %  5.0 s, 15 s left  16/64 samples  2.0 Mrays/s");
  CHECK(format_progress(quarter, goal, 72) ==
        "[#####...............] 25 %  5.0 s, 15 s left  16/64 samples");
  CHECK(format_progress(quarter, goal, 50) == "[#####...............] 25 %  5.0 s, 15 s left");
  CHECK(format_progress(quarter, goal, 39) == "25 %  15 s left");
  CHECK(format_progress(quarter, goal, 6) == "25 %  ");
  for (std::size_t width = 0; width < 100; ++width)
    CHECK(format_progress(quarter, goal, width).size() <= width);
}

TEST_CASE("The time left is no more than the time limit allows") {
  CHECK(format_progress(quarter, {64, 6}, 39) == "83 %  1.0 s left");
  CHECK(format_progress(quarter, {64, 4}, 39) == "100 %  0.0 s left");
  CHECK(format_progress({0, 0, 0, 0}, {64, 0}, 39) == "0 %  ? left");
}

TEST_CASE("A heartbeat comes once an interval, not at the start and not at the end") {
  Heartbeat heartbeat({100, 0}, 2);
  const auto line_at = [&](double seconds) {
    return heartbeat.line({seconds / 10, seconds, 0, 0});
  };
  CHECK(line_at(0.1).empty());
  CHECK(line_at(1.9).empty());
  CHECK(line_at(2.5) == "25 % after 2.5 s, 7.5 s left\n");
  CHECK(line_at(3.9).empty());
  CHECK(line_at(4) == "40 % after 4.0 s, 6.0 s left\n");
  CHECK(line_at(4.1).empty());
  CHECK(line_at(8.1) == "81 % after 8.1 s, 1.9 s left\n");
  CHECK(line_at(10).empty());
}

TEST_CASE("A terminal that cannot overwrite lines gets no progress bar") {
  const CurrentTemporaryFolder folder;
  write_file("scene.yaml", small_scene);
  const Outcome outcome = run({"scene.yaml", "-o", "out.png"}, ErrorStream::dumb_terminal);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.starts_with("wrote out.png: "));
  CHECK(outcome.err.find('\x1b') == std::string::npos);
}
