// The times at which unfinished pictures are written.
#include "cli/render/write_schedule.hpp"

#include "catch.hpp"

using pah::cli::WriteSchedule;

TEST_CASE("A picture is written at once and then at every interval") {
  WriteSchedule schedule(5);
  CHECK(schedule.due(0));
  schedule.written(1, 1.01);
  CHECK(!schedule.due(6));
  CHECK(schedule.due(6.02));
}

TEST_CASE("Writing takes no more than its share of the time, but for the first") {
  WriteSchedule schedule(5);
  schedule.written(10, 11);
  CHECK(!schedule.due(19.9));
  CHECK(schedule.due(20.1));
  schedule.written(21, 22);
  CHECK(!schedule.due(120.9));
  CHECK(schedule.due(121.1));
}
