// A YAML document as a tree of immutable values. Aliases are shared, merge keys are resolved.
//
// Uses yaml-cpp's parser but not its Node, which hides the places of null values and keys, ignores
// merge keys, and expands aliases without limit.
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
  int override_index = -1;  // index of the override; -1 for the file
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
  std::optional<double> number;    // of an animated scalar, at the loaded frame
  std::vector<YamlRef> items;      // lists
  std::vector<YamlEntry> entries;  // maps, in order, with unique keys
  std::uint64_t count = 1;         // nodes of this subtree, with aliases expanded
  int depth = 1;                   // levels of this subtree, with aliases expanded

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

// Returns the only document in `text`, or a null node if the text is empty. Adds duplicate keys,
// tags and the like to `faults`. Marks carry `override_index`. Throws YamlError.
[[nodiscard]] YamlRef parse_yaml(std::string_view text, const YamlLimits& limits,
                                 std::vector<YamlFault>& faults, int override_index = -1);

// The tree with the value at `path` replaced: keys, list indices and names of list elements, joined
// by dots. Missing keys are created. Throws YamlError, at `mark`.
[[nodiscard]] YamlRef replace_at(const YamlRef& root, std::string_view path, const YamlRef& value,
                                 const Mark& mark);

}  // namespace pah
