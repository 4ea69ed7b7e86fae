#include "color/config/yaml_extent.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace scotopic {
namespace {

constexpr std::int64_t most = std::int64_t{1} << 60;
constexpr int deepest_seen = 200;
constexpr std::size_t most_anchors = 1 << 16;  // no config has so many: they may stand for anything

/// What an anchor names, once it is over.
struct Node {
  std::int64_t size = 0;
  int depth = 0;
};

/// An anchor whose node is not over yet: in flow style it ends at a comma or bracket of its level, in block
/// style where a line is indented no more than its parent.
struct OpenAnchor {
  std::string name;
  std::int64_t size_before = 0;
  int depth_before = 0;
  int deepest = 0;
  int flow = 0;               ///< brackets around it
  std::ptrdiff_t parent = 0;  ///< in block style: the indentation that its lines exceed
  bool of_key = false;        ///< that of a key, whose list's items may stand right under it
  bool before_key = false;    ///< no colon has come on its line: it may name but the key
};

class Scan {
 public:
  explicit Scan(std::string_view text) : text_(text) {}

  YamlExtent run() {
    while (at_ < text_.size() && out_.depth <= deepest_seen) new_line_&& flow_ == 0 ? start_line() : token();
    close_anchors([](const OpenAnchor&) { return true; });
    out_.size = std::min(most, static_cast<std::int64_t>(text_.size()) + written_out_);
    return out_;
  }

 private:
  char peek(std::size_t offset = 0) const { return at_ + offset < text_.size() ? text_[at_ + offset] : '\n'; }
  bool blank_ahead(std::size_t offset) const {
    const char c = peek(offset);
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
  }
  void skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    new_line_ = true;
  }
  std::ptrdiff_t column() const { return static_cast<std::ptrdiff_t>(at_ - line_); }
  std::int64_t size_here() const { return static_cast<std::int64_t>(at_) + written_out_; }

  /// Levels in block style are what indentation they have.
  void enter(std::ptrdiff_t indent) {
    indents_.push_back(indent);
    note_depth(0);
  }
  void note_depth(int within) {
    const int depth = static_cast<int>(indents_.size()) + flow_ + within;
    out_.depth = std::max(out_.depth, depth);
    for (OpenAnchor& anchor : open_) anchor.deepest = std::max(anchor.deepest, depth);
  }

  void start_line() {
    new_line_ = false;
    line_ = at_;
    const std::size_t first = text_.find_first_not_of(' ', at_);
    at_ = std::min(first, text_.size());
    const bool marker = column() == 0 && (text_.substr(at_, 3) == "---" || text_.substr(at_, 3) == "...");
    if (marker) at_ += 3;
    if (blank_line() || (!marker && column() > text_parent_) || (column() == 0 && peek() == '%'))
      return skip_line();
    text_parent_ = PTRDIFF_MAX;
    plain_ = false;
    block_structure(marker ? -1 : column());
  }

  bool blank_line() const {
    const char c = peek();
    return c == '#' || c == '\n' || (c == '\r' && peek(1) == '\n');
  }

  void block_structure(std::ptrdiff_t indent) {
    const bool item = is_indicator();
    close_anchors([&](const OpenAnchor& a) {
      return a.flow == 0 && indent <= a.parent && !(item && a.of_key && indent == a.parent);
    });
    while (!indents_.empty() && indents_.back() >= indent) indents_.pop_back();
    parent_ = indents_.empty() ? -1 : indents_.back();
    enter(indent);
    while (is_indicator()) {
      parent_ = column();
      for (++at_; peek() == ' ' || peek() == '\t';) ++at_;
      enter(column());
    }
    key_ = column();
    key_seen_ = false;
  }

  /// "- " and "? " begin an item on the line of what is in it.
  bool is_indicator() const { return (peek() == '-' || peek() == '?') && blank_ahead(1); }

  void token() {
    const char c = peek();
    if (c == '\n') return end_line();
    if (c == '#' && (at_ == 0 || blank_before())) return skip_comment();
    if (c == ':' && (!plain_ || blank_ahead(1) || (flow_ > 0 && is_flow_sign(peek(1))))) return end_key();
    if (flow_ > 0 && (c == ',' || c == ']' || c == '}')) return end_flow(c);
    if (plain_ || blank_ahead(0)) return static_cast<void>(++at_);
    start_token(c);
  }

  bool blank_before() const {
    return text_[at_ - 1] == ' ' || text_[at_ - 1] == '\t' || text_[at_ - 1] == '\n';
  }
  static bool is_flow_sign(char c) { return c == ',' || c == '[' || c == ']' || c == '{' || c == '}'; }
  void skip_comment() { at_ = std::min(text_.find('\n', at_), text_.size()); }

  void end_line() {
    // A plain scalar goes on wherever lines are indented more than its parent.
    if (flow_ == 0 && plain_) text_parent_ = key_seen_ ? key_ : parent_;
    for (OpenAnchor& anchor : open_) anchor.before_key = false;
    new_line_ = flow_ == 0;
    ++at_;
  }

  void end_key() {
    plain_ = false;
    key_seen_ = key_seen_ || flow_ == 0;
    ++at_;
    if (flow_ == 0) close_anchors([](const OpenAnchor& a) { return a.before_key; });
  }

  void end_flow(char c) {
    const int level = flow_;
    if (c != ',') --flow_;
    plain_ = false;
    ++at_;
    close_anchors([&](const OpenAnchor& a) { return a.flow == level; });
  }

  void start_token(char c) {
    if (c == '"' || c == '\'') return skip_quoted(c);
    if (c == '&') return open_anchor();
    if (c == '*') return alias();
    if (c == '!') return skip_tag();
    if ((c == '|' || c == '>') && flow_ == 0) return skip_block_scalar();
    plain_ = c != '[' && c != '{';
    if (!plain_) ++flow_;
    ++at_;
    if (!plain_) note_depth(0);
  }

  void skip_quoted(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_)
      if (quote == '"' && text_[at_] == '\\') ++at_;
    at_ = std::min(at_ + 1, text_.size());  // of two single quotes, which mean one, the second begins anew
  }

  void skip_tag() {
    if (peek(1) == '<') at_ = std::min(text_.find('>', at_), text_.size());
    while (at_ < text_.size() && !blank_ahead(0) && !(flow_ > 0 && is_flow_sign(peek()))) ++at_;
  }

  void skip_block_scalar() {
    const std::ptrdiff_t parent = key_seen_ ? key_ : parent_;
    skip_line();
    text_parent_ = parent;
  }

  std::string name() {
    const std::size_t first = ++at_;
    while (at_ < text_.size() && !blank_ahead(0) && !is_flow_sign(peek())) ++at_;
    return std::string(text_.substr(first, at_ - first));
  }

  void open_anchor() {
    OpenAnchor anchor;
    anchor.size_before = size_here();
    anchor.depth_before = anchor.deepest = static_cast<int>(indents_.size()) + flow_;
    anchor.flow = flow_;
    anchor.before_key = flow_ == 0 && !key_seen_;
    anchor.of_key = key_seen_;
    anchor.parent = key_seen_ ? key_ : parent_;
    anchor.name = name();
    open_.push_back(std::move(anchor));
    // Nodes that are open lie within each other.
    if (open_.size() > deepest_seen) out_.depth = deepest_seen + 1;
  }

  void alias() {
    const std::string what = name();
    for (const OpenAnchor& anchor : open_) out_.endless = out_.endless || anchor.name == what;
    const auto known = nodes_.find(what);
    if (known == nodes_.end()) return;
    written_out_ = std::min(most, written_out_ + known->second.size);
    note_depth(known->second.depth);
  }

  template <typename Over>
  void close_anchors(Over over) {
    for (const OpenAnchor& a : open_)
      if (over(a)) nodes_[a.name] = {std::min(most, size_here() - a.size_before), a.deepest - a.depth_before};
    std::erase_if(open_, over);
    if (nodes_.size() > most_anchors) written_out_ = most;
  }

  std::string_view text_;
  YamlExtent out_;
  std::size_t at_ = 0, line_ = 0;
  std::int64_t written_out_ = 0;
  int flow_ = 0;
  bool new_line_ = true, plain_ = false, key_seen_ = false;
  std::ptrdiff_t key_ = 0, parent_ = -1;
  std::ptrdiff_t text_parent_ = PTRDIFF_MAX;  ///< lines indented more go on with a scalar
  std::vector<std::ptrdiff_t> indents_;
  std::vector<OpenAnchor> open_;
  std::map<std::string, Node> nodes_;
};

}  // namespace

YamlExtent yaml_extent(std::string_view text) { return Scan(text).run(); }

}  // namespace scotopic
