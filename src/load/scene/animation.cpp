#include "load/scene/animation.hpp"

#include <unordered_map>

#include "load/scene/keyframes.hpp"

namespace pah {
namespace {

using Kind = YamlNode::Kind;

// Evaluates a tree at a frame. Copies only nodes that change; aliases stay shared.
class Frame {
 public:
  Frame(ReadContext& context, const FrameTime& now) : context_(context), now_(now) {}

  YamlRef take(const YamlRef& node) {
    if (node->kind == Kind::null) return node;
    if (node->kind == Kind::scalar) return take_scalar(node);
    const auto found = done_.find(node.get());
    if (found != done_.end()) return found->second;
    YamlRef result = node->kind == Kind::list ? take_list(node) : take_map(node);
    done_.emplace(node.get(), result);
    return result;
  }

 private:
  YamlRef take_scalar(const YamlRef& node) const {
    const std::string& text = node->text;
    if (node->quoted ||
        (text.find("frame") == std::string::npos && text.find("time") == std::string::npos))
      return node;
    const std::optional<double> number = evaluate(text, now_);
    if (!number) return node;
    auto copy = std::make_shared<YamlNode>(*node);
    copy->number = number;
    return copy;
  }

  YamlRef take_list(const YamlRef& node) {
    std::shared_ptr<YamlNode> copy;
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      YamlRef item = take(node->items[i]);
      if (item == node->items[i]) continue;
      if (!copy) copy = std::make_shared<YamlNode>(*node);
      copy->items[i] = std::move(item);
    }
    return copy ? copy : node;
  }

  YamlRef take_map(const YamlRef& node) {
    std::shared_ptr<YamlNode> copy;
    for (std::size_t i = 0; i < node->entries.size(); ++i) {
      YamlRef value = take(node->entries[i].value);
      if (value == node->entries[i].value) continue;
      if (!copy) copy = std::make_shared<YamlNode>(*node);
      copy->entries[i].value = std::move(value);
    }
    YamlRef result = copy ? copy : node;
    if (!is_keyframes(*result)) return result;
    const YamlRef value = read_keyframes(context_, result.get(), now_.frame);
    return value ? value : result;
  }

  ReadContext& context_;
  FrameTime now_;
  std::unordered_map<const YamlNode*, YamlRef> done_;
};

}  // namespace

FrameTime read_animation(ReadContext& context, const YamlNode* node, std::optional<int> frame) {
  double shown = 0, fps = 24;
  read_map(context, node, "animation", "animation", [&](MapReader& map) {
    map.optional("fps", fps, positive);
    map.optional("frame", shown);
  });
  if (frame) shown = *frame;
  return {shown, shown / fps};
}

YamlRef at_frame(ReadContext& context, const YamlRef& root, const FrameTime& now) {
  return Frame(context, now).take(root);
}

}  // namespace pah
