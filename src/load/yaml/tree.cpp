#include "load/yaml/tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "load/yaml/hints.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

// Builds the tree from yaml-cpp's events, which come with a mark for every node and key.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const YamlLimits& limits, std::vector<YamlFault>& faults, int override_index)
      : limits_(limits), faults_(faults), override_index_(override_index) {}

  [[nodiscard]] YamlRef take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0) throw YamlError(at(mark), "only one YAML document is allowed in a file");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    auto node = make(Kind::null, mark);
    // An absent value gets the place of its key. yaml-cpp gives that of the next token.
    if (!open_.empty())
      if (const auto& key = open_.back().key) node->mark = key->mark;
    close(std::move(node), anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const YamlRef node = anchor < anchors_.size() ? anchors_[anchor] : nullptr;
    if (node == nullptr) throw YamlError(at(mark), "this alias refers to a value that contains it");
    add(node, at(mark));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(mark, tag);
    auto node = make(Kind::scalar, mark);
    node->quoted = tag == "!";
    node->text = value;
    if (!node->quoted &&
        (value.empty() || value == "~" || value == "null" || value == "Null" || value == "NULL"))
      node->kind = Kind::null;
    close(std::move(node), anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check_tag(mark, tag);
    open(make(Kind::list, mark), anchor);
  }
  void OnSequenceEnd() override { close_top(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check_tag(mark, tag);
    open(make(Kind::map, mark), anchor);
  }
  void OnMapEnd() override {
    merge(open_.back());
    close_top();
  }

 private:
  struct Open {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor = 0;
    std::optional<YamlEntry> key;  // of a map, while its value is read
    std::unordered_map<std::string, Mark> keys;
    std::vector<YamlEntry> merges;
  };

  [[nodiscard]] Mark at(const YAML::Mark& mark) const {
    return {override_index_, mark.line + 1, mark.column + 1};
  }
  [[nodiscard]] std::shared_ptr<YamlNode> make(Kind kind, const YAML::Mark& mark) const {
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->mark = at(mark);
    return node;
  }

  void check_tag(const YAML::Mark& mark, const std::string& tag) {
    if (!tag.empty() && tag != "?" && tag != "!")
      faults_.push_back({at(mark), "tags such as '" + tag + "' are not part of the language"});
  }

  void open(std::shared_ptr<YamlNode> node, YAML::anchor_t anchor) {
    if (!open_.empty() && open_.back().node->kind == Kind::map && !open_.back().key)
      throw YamlError(node->mark, "a key must be text, not a list or map; is a bracket left open?");
    if (static_cast<int>(open_.size()) >= limits_.nesting)
      throw YamlError(node->mark,
                      "nested more than " + std::to_string(limits_.nesting) + " levels deep");
    if (anchor != 0) remember(anchor, nullptr);
    open_.push_back({std::move(node), anchor, {}, {}, {}});
  }

  void close_top() {
    Open top = std::move(open_.back());
    open_.pop_back();
    close(std::move(top.node), top.anchor);
  }

  void close(std::shared_ptr<YamlNode> node, YAML::anchor_t anchor) {
    const Mark mark = node->mark;
    const YamlRef done = std::move(node);
    if (anchor != 0) remember(anchor, done);
    add(done, mark);
  }

  void remember(YAML::anchor_t anchor, YamlRef node) {
    if (anchors_.size() <= anchor) anchors_.resize(anchor + 1);
    anchors_[anchor] = std::move(node);
  }

  // Adds a finished node to the innermost open one; `mark` is where it is used.
  void add(const YamlRef& node, const Mark& mark) {
    if (open_.empty()) {
      root_ = node;
      return;
    }
    Open& top = open_.back();
    if (top.node->kind == Kind::map && !top.key) {
      if (node->kind != Kind::scalar)
        throw YamlError(mark, node->kind == Kind::null ? "a key is missing" : "a key must be text");
      top.key = YamlEntry{node->text, mark, nullptr};
      top.key->value = node->quoted ? nullptr : node;  // only a plain << merges
      return;
    }
    grow(*top.node, *node, mark);
    if (top.node->kind == Kind::list) {
      top.node->items.push_back(node);
      return;
    }
    YamlEntry entry = std::move(*top.key);
    top.key.reset();
    const bool plain = entry.value != nullptr;
    entry.value = node;
    if (plain && entry.key == "<<") {
      top.merges.push_back(std::move(entry));
      return;
    }
    const auto [first, is_new] = top.keys.emplace(entry.key, entry.mark);
    if (!is_new)
      faults_.push_back({entry.mark, "duplicate key '" + entry.key + "'; the first is on line " +
                                         std::to_string(first->second.line)});
    else
      top.node->entries.push_back(std::move(entry));
  }

  // Counts a child, and rejects it if the document would exceed its limits.
  void grow(YamlNode& parent, const YamlNode& child, const Mark& mark) const {
    if (child.count > limits_.nodes - std::min(parent.count, limits_.nodes))
      throw YamlError(mark, "more than " + std::to_string(limits_.nodes) +
                                " values, aliases counted wherever they are used");
    parent.count += child.count;
    parent.depth = std::max(parent.depth, child.depth + 1);
    if (static_cast<int>(open_.size()) + child.depth > limits_.nesting)
      throw YamlError(mark, "nested more than " + std::to_string(limits_.nesting) + " levels deep");
  }

  // YAML 1.1 merge keys: the map's own keys win, then those of earlier maps.
  void merge(Open& top) {
    for (const YamlEntry& source : top.merges) {
      if (source.value->kind == Kind::map) {
        merge_map(top, *source.value, source.mark);
        continue;
      }
      if (source.value->kind != Kind::list) {
        faults_.push_back({source.mark, "'<<' takes a map or a list of maps"});
        continue;
      }
      for (const YamlRef& item : source.value->items) {
        if (item->kind == Kind::map)
          merge_map(top, *item, source.mark);
        else
          faults_.push_back({item->mark, "'<<' takes a map or a list of maps"});
      }
    }
  }

  void merge_map(Open& top, const YamlNode& from, const Mark& mark) {
    merged_ += from.entries.size();
    if (merged_ > limits_.nodes)
      throw YamlError(mark,
                      "merge keys bring in more than " + std::to_string(limits_.nodes) + " values");
    for (const YamlEntry& entry : from.entries)
      if (top.keys.emplace(entry.key, entry.mark).second) top.node->entries.push_back(entry);
  }

  YamlLimits limits_;
  std::vector<YamlFault>& faults_;
  int override_index_;
  int documents_ = 0;
  std::uint64_t merged_ = 0;
  std::vector<Open> open_;
  std::vector<YamlRef> anchors_;  // by number; null while open
  YamlRef root_;
};

// Rejects control characters and too many brackets: yaml-cpp takes the byte 4 for the end of the
// file, and queues every bracket of a line before it reports the first.
void check_text(std::string_view text, int override_index) {
  constexpr int max_brackets = 4096;
  Mark mark{override_index, 1, 1};
  int brackets = 0;
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw YamlError(mark, "this is UTF-16: save the text as UTF-8");
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7F) {
      std::ostringstream message;
      message << "not a text file: it holds the byte 0x" << std::hex << std::uppercase
              << (byte < 16 ? "0" : "") << static_cast<int>(byte);
      throw YamlError(mark, message.str());
    }
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (brackets > max_brackets) throw YamlError(mark, "too many open brackets");
    ++mark.column;
    if (c == '\n') mark = {override_index, mark.line + 1, 1};
  }
}

// Rejects invalid or overlong sequences, surrogates and values past U+10FFFF (RFC 3629).
void check_utf8(std::string_view text, int override_index) {
  Mark mark{override_index, 1, 1};
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    const unsigned lead = byte(0);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    bool valid = length > 0;
    for (std::size_t k = 1; k < length; ++k) valid = valid && (byte(k) & 0xC0U) == 0x80;
    if (length == 3)
      valid = valid && !(lead == 0xE0 && byte(1) < 0xA0) && !(lead == 0xED && byte(1) > 0x9F);
    if (length == 4)
      valid = valid && !(lead == 0xF0 && byte(1) < 0x90) && !(lead == 0xF4 && byte(1) > 0x8F);
    if (!valid) throw YamlError(mark, "not a text file: it is not UTF-8");
    mark.column += static_cast<int>(length);
    if (lead == '\n') mark = {override_index, mark.line + 1, 1};
    i += length;
  }
}

YamlError syntax_error(const YAML::Exception& error, std::string_view text, int override_index) {
  Mark mark{override_index, error.mark.line + 1, error.mark.column + 1};
  // An error at the end of the file is reported on its last line.
  text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
  const int last_line = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  if (mark.line > last_line) {
    mark.line = last_line;
    mark.column = static_cast<int>(text.size() - (text.rfind('\n') + 1)) + 1;
  }
  const bool open_quote =
      error.msg == YAML::ErrorMsg::DOC_IN_SCALAR || error.msg == YAML::ErrorMsg::EOF_IN_SCALAR;
  if (open_quote) return {mark, "a quoted text does not end"};
  // yaml-cpp 0.8 appends the anchor's name, which the excerpt shows.
  const bool unknown_anchor = error.msg.starts_with(YAML::ErrorMsg::UNKNOWN_ANCHOR);
  return {mark, "not valid YAML: " +
                    (unknown_anchor ? "the referenced anchor is not defined" : error.msg)};
}

}  // namespace

const YamlEntry* YamlNode::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const YamlEntry& e) { return e.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

YamlRef parse_yaml(std::string_view text, const YamlLimits& limits, std::vector<YamlFault>& faults,
                   int override_index) {
  check_text(text, override_index);
  check_utf8(text, override_index);
  TreeBuilder builder(limits, faults, override_index);
  // Without an end marker, yaml-cpp takes the end of the file for a closing quote or bracket.
  std::istringstream stream{std::string(text) + "\n...\n"};
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const YamlError found = syntax_error(error, text, override_index);
    const YamlFault likely = likely_fault(text, {found.mark(), found.what()});
    throw YamlError(likely.mark, likely.message);
  }
  YamlRef root = builder.take_root();
  if (root == nullptr) root = std::make_shared<YamlNode>();
  return root;
}

}  // namespace pah
