// A YAML document as a tree of values that never change: aliases are shared, merge keys resolved.
//
// yaml-cpp parses; its own Node is not used, because it hides where null values and keys stand,
// knows no merge keys, and expands aliases without limit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pah {

// The place of a value. Lines and columns count from 1, columns in bytes.
struct Mark {
  int override_index = -1;  // the override that it came from; -1 for the file
  int line = 0;
  int column = 0;

  friend auto operator<=>(const Mark&, const Mark&) = default;
};

struct YamlNode;
using YamlRef = std::shared_ptr<const YamlNode>;

struct YamlEntry {
  std::string key;
  Mark mark;  // of the key
  YamlRef value;
};

struct YamlNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  bool quoted = false;  // scalars: "42" is text, 42 a number
  Mark mark;
  std::string text;                // scalars
  std::optional<double> number;    // of a scalar whose text is none: at some frame
  std::vector<YamlRef> items;      // lists
  std::vector<YamlEntry> entries;  // maps, in order, keys unique
  std::uint64_t count = 1;         // nodes from here down, aliases expanded
  int depth = 1;                   // levels from here down, aliases expanded

  [[nodiscard]] const YamlEntry* find(std::string_view key) const;
};

struct YamlLimits {
  std::uint64_t nodes = 4'000'000;  // after alias expansion
  int nesting = 64;
};

// An error that ends parsing: bad syntax, an exceeded limit, an alias that contains itself.
class YamlError : public std::runtime_error {
 public:
  YamlError(Mark mark, const std::string& message) : std::runtime_error(message), mark_(mark) {}
  [[nodiscard]] const Mark& mark() const { return mark_; }

 private:
  Mark mark_;
};

// A fault after which parsing continues.
struct YamlFault {
  Mark mark;
  std::string message;
};

// The first and only document in `text`; a null node if there is none. Duplicate keys, tags and the
// like go to `faults`. Marks carry `override_index`. Throws YamlError.
[[nodiscard]] YamlRef parse_yaml(std::string_view text, const YamlLimits& limits,
                                 std::vector<YamlFault>& faults, int override_index = -1);

// The tree with the value at `path` replaced: keys, list indices and names of list elements, joined
// by dots. Missing keys are created. Throws YamlError, at `mark`.
[[nodiscard]] YamlRef replace_at(const YamlRef& root, std::string_view path, const YamlRef& value,
                                 const Mark& mark);

}  // namespace pah
