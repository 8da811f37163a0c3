#include <algorithm>
#include <charconv>

#include "load/yaml/suggest.hpp"
#include "load/yaml/tree.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

std::string_view name_of(const YamlNode& node) {
  const YamlEntry* name = node.kind == Kind::map ? node.find("name") : nullptr;
  return name != nullptr && name->value->kind == Kind::scalar ? std::string_view(name->value->text)
                                                              : std::string_view();
}

// Returns the index of the entry or element that `step` names, or the size.
std::size_t index_of(const YamlNode& node, std::string_view step) {
  const bool is_map = node.kind == Kind::map;
  const std::size_t size = is_map ? node.entries.size() : node.items.size();
  for (std::size_t i = 0; i < size; ++i)
    if ((is_map ? std::string_view(node.entries[i].key) : name_of(*node.items[i])) == step)
      return i;
  if (is_map) return size;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool whole = error == std::errc() && end == step.data() + step.size();
  return whole && index < size ? index : size;
}

std::string no_element(const YamlNode& list, std::string_view step) {
  std::vector<std::string> names;
  for (const YamlRef& item : list.items)
    if (const std::string_view name = name_of(*item); !name.empty()) names.emplace_back(name);
  return "no element '" + std::string(step) + "' in a list of " +
         std::to_string(list.items.size()) + suggestion(step, names);
}

}  // namespace

YamlRef replace_at(const YamlRef& root, std::string_view path, const YamlRef& value,
                   const Mark& mark) {
  if (path.empty() || path.front() == '.' || path.back() == '.')
    throw YamlError(mark, "an override is key.path=value");
  constexpr int longest_path = 64;  // steps
  if (std::count(path.begin(), path.end(), '.') >= longest_path)
    throw YamlError(mark, "the path has more than " + std::to_string(longest_path) + " steps");
  auto copy = std::make_shared<YamlNode>(*root);
  if (copy->kind == Kind::null) copy->kind = Kind::map;
  if (copy->kind == Kind::scalar)
    throw YamlError(mark, "'" + std::string(path) + "' is sought in '" + copy->text +
                              "', which is neither a map nor a list");
  // Names may contain dots, so the longest existing name wins.
  const bool is_map = copy->kind == Kind::map;
  const std::size_t size = is_map ? copy->entries.size() : copy->items.size();
  std::size_t length = path.size();
  std::size_t index = index_of(*copy, path);
  while (index == size && length != std::string_view::npos && length > 0) {
    length = path.rfind('.', length - 1);
    if (length != std::string_view::npos) index = index_of(*copy, path.substr(0, length));
  }
  if (index == size) length = std::min(path.find('.'), path.size());
  const std::string_view step = path.substr(0, length);
  const bool last = length == path.size();

  if (index == size && !is_map) throw YamlError(mark, no_element(*copy, step));
  if (index == size) {
    auto empty = std::make_shared<YamlNode>();
    empty->mark = mark;
    copy->entries.push_back({std::string(step), mark, empty});
  }
  YamlRef& child = is_map ? copy->entries[index].value : copy->items[index];
  child = last ? value : replace_at(child, path.substr(length + 1), value, mark);
  return copy;
}

}  // namespace pah
