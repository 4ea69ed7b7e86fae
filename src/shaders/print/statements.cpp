#include "shaders/print/statements.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <utility>

namespace scotopic::shaders {
namespace {

/// Longer expressions get a name.
constexpr std::size_t longest_inside = 64;

/// How tightly an expression holds together, in all of C's children.
enum Binding { choice, disjunction, conjunction, equality, order, sum, product, unary, primary };

struct Operator {
  std::string_view sign;
  Binding binding;
};

Operator operator_of(Op op) {
  switch (op) {
    case Op::add:
      return {" + ", sum};
    case Op::subtract:
      return {" - ", sum};
    case Op::multiply:
      return {" * ", product};
    case Op::divide:
      return {" / ", product};
    case Op::less:
      return {" < ", order};
    case Op::less_equal:
      return {" <= ", order};
    case Op::greater:
      return {" > ", order};
    case Op::not_equal:
      return {" != ", equality};
    case Op::both:
      return {" && ", conjunction};
    case Op::either:
      return {" || ", disjunction};
    default:
      return {"", primary};
  }
}

class Writer {
 public:
  Writer(const Record& record, const Spelling& spelling)
      : record_(record),
        nodes_(record.graph.nodes()),
        spelling_(spelling),
        uses_(nodes_.size()),
        text_(nodes_.size()) {}

  Statements operator()() {
    count_uses();
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (uses_[i] > 0) write(i);
    std::sort(out_.used.begin(), out_.used.end());
    for (std::size_t i = 0; i < 3; ++i) out_.out[i] = of(record_.out[i]).text;
    return std::move(out_);
  }

 private:
  struct Text {
    std::string text;
    Binding binding = primary;
  };

  const Text& of(int node) const { return text_[static_cast<std::size_t>(node)]; }

  // From the results down: what nothing uses is left out. Sliders' values that pixels use are used "twice":
  // by all.
  void count_uses() {
    for (const int node : record_.out) uses_[static_cast<std::size_t>(node)] += 2;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      if (uses_[i] == 0) continue;
      for (const int from : nodes_[i].from)
        if (from >= 0) uses_[static_cast<std::size_t>(from)] += nodes_[i].varies ? by_pixels(from) : 1;
    }
  }
  int by_pixels(int from) const { return nodes_[static_cast<std::size_t>(from)].varies ? 1 : 2; }

  void write(std::size_t i) {
    const Node& node = nodes_[i];
    Text& text = text_[i] = expression(node);
    if (node.op <= Op::parameter) {
      if (node.op == Op::parameter) out_.used.push_back(static_cast<Slider>(node.index));
      return;
    }
    if (uses_[i] > 1 || text.text.size() > longest_inside) name(node, text);
  }

  void name(const Node& node, Text& text) {
    auto& statements = node.varies ? out_.of_pixel : out_.of_sliders;
    std::string name = (node.varies ? "t" : "c") + std::to_string(statements.size() + 1);
    statements.push_back({is_truth(node.op) ? spelling_.truth : "float", name, text.text, node.section});
    text = {std::move(name), primary};
  }

  Text expression(const Node& node) const {
    switch (node.op) {
      case Op::literal:
        return {number_in(spelling_, node.number), node.number < 0 ? unary : primary};
      case Op::truth:
        return {node.number != 0 ? "1 > 0" : "0 > 1", order};
      case Op::input:
        return {std::string(1, "rgb"[node.index])};
      case Op::parameter:
        return {std::string(text_of(static_cast<Slider>(node.index)).name)};
      case Op::min:
        return call(spelling_.min, node);
      case Op::max:
        return call(spelling_.max, node);
      case Op::abs:
        return call(spelling_.abs, node);
      case Op::sqrt:
        return call(spelling_.sqrt, node);
      case Op::exp:
        return call(spelling_.exp, node);
      case Op::log:
        return call(spelling_.log, node);
      case Op::pow:
        return call(spelling_.pow, node);
      case Op::select:
        return {
            in(node, 0, disjunction) + " ? " + in(node, 1, disjunction) + " : " + in(node, 2, disjunction),
            choice};
      case Op::without:
        return {in(node, 1, equality) + " && !" + in(node, 0, primary), conjunction};
      default:
        return binary(operator_of(node.op), node);
    }
  }

  // Sums and products run from the left, as formulas do; what compilers warn of gets its parentheses.
  Text binary(const Operator& sign, const Node& node) const {
    const bool from_left = sign.binding == sum || sign.binding == product;
    const auto tighter = static_cast<Binding>(sign.binding + 1);
    const Binding left = from_left ? sign.binding : sign.binding < equality ? order : sum;
    const Binding right = from_left ? tighter : left;
    return {in(node, 0, left) + std::string(sign.sign) + in(node, 1, right), sign.binding};
  }

  Text call(std::string_view function, const Node& node) const {
    std::string text = std::string(function) + "(" + of(node.from[0]).text;
    if (node.from[1] >= 0) text += ", " + of(node.from[1]).text;
    return {text + ")", primary};
  }

  // An operand, in parentheses unless it holds together at least as tightly as `least`.
  std::string in(const Node& node, std::size_t which, Binding least) const {
    const Text& text = of(node.from[which]);
    return text.binding >= least ? text.text : "(" + text.text + ")";
  }

  const Record& record_;
  const std::vector<Node>& nodes_;
  const Spelling& spelling_;
  std::vector<int> uses_;
  std::vector<Text> text_;
  Statements out_;
};

}  // namespace

std::string number_in(const Spelling& spelling, double number) {
  constexpr float greatest = std::numeric_limits<float>::max();
  const float nearest = std::clamp(static_cast<float>(number), -greatest, greatest);
  char buffer[32];
  const auto end = std::to_chars(std::begin(buffer), std::end(buffer), nearest);
  std::string text(std::begin(buffer), end.ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + std::string(spelling.suffix);
}

Statements statements_of(const Record& record, const Spelling& spelling) {
  return Writer(record, spelling)();
}

}  // namespace scotopic::shaders
