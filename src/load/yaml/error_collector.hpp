// Collects all errors and warnings of a scene, so that they are reported at once.
#pragma once

#include <pah/base/errors.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "load/yaml/tree.hpp"

namespace pah {

class ErrorCollector {
 public:
  // `text` and `overrides` must outlive the collector.
  ErrorCollector(std::string file, std::string_view text,
                 const std::vector<std::string>& overrides = {})
      : file_(std::move(file)), text_(text), overrides_(overrides) {}

  void add(const Mark& mark, std::string message) { errors_.push_back({mark, std::move(message)}); }
  void warn(const Mark& mark, std::string message) {
    warnings_.push_back({mark, std::move(message)});
  }
  [[nodiscard]] std::size_t size() const { return errors_.size(); }  // without warnings

  // Returns the errors sorted by place, without duplicates. Beyond a hundred, only counts them.
  [[nodiscard]] std::vector<LocatedError> located() const { return located(errors_, "errors"); }
  [[nodiscard]] std::vector<LocatedError> located_warnings() const {
    return located(warnings_, "warnings");
  }

 private:
  [[nodiscard]] std::vector<LocatedError> located(std::vector<YamlFault> faults,
                                                  const char* noun) const;
  [[nodiscard]] LocatedError locate(const YamlFault& error, std::string_view line) const;

  std::string file_;
  std::string_view text_;
  const std::vector<std::string>& overrides_;
  std::vector<YamlFault> errors_;
  std::vector<YamlFault> warnings_;
};

}  // namespace pah
