// Faulty scenes and their error messages, for tests.
#pragma once

#include <string>
#include <vector>

#include "catch.hpp"
#include "scene_testing.hpp"

struct Fault {
  const char* text;
  const char* error;
};

inline void check_all(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    INFO(fault.text);
    CHECK(errors_of(fault.text) == std::string(fault.error) + "\n");
  }
}
