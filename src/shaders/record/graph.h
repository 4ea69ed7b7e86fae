// Arithmetic as a graph: what formulas leave behind that are run on Recorded numbers (recorded.h) instead of
// on pixels.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

namespace scotopic::shaders {

/// All that the pixel stages are made of; each is one operator or function in every shading language.
enum class Op : std::uint8_t {
  literal,    ///< a number
  truth,      ///< yes or no: literal 1 or 0
  input,      ///< R, G or B of the pixel
  parameter,  ///< a slider
  add,
  subtract,
  multiply,
  divide,
  min,
  max,
  abs,
  sqrt,
  exp,
  log,
  pow,
  less,
  less_equal,
  greater,
  not_equal,
  both,
  either,
  without,  ///< and, or, b and not a
  select    ///< a ? b : c
};

/// Whether it gives yes or no.
constexpr bool is_truth(Op op) noexcept { return op == Op::truth || (op >= Op::less && op <= Op::without); }

/// One operation; `from` are earlier nodes, -1 where there are fewer.
struct Node {
  Op op{};
  std::array<int, 3> from = {-1, -1, -1};
  float number = 0;          ///< of a literal
  int index = 0;             ///< of an input or a parameter
  std::string_view section;  ///< the stage that asked first
  bool varies = false;       ///< from pixel to pixel
};

/// Grows only; equal operations on equal nodes are one node.
class Graph {
 public:
  /// A number, to the nearest float.
  int literal(double number);
  int truth(bool yes);
  int input(int index);
  int parameter(int index);
  int operation(Op op, std::array<int, 3> from);

  /// What nodes are of from here on; the text must outlive the graph.
  void enter(std::string_view section) noexcept { section_ = section; }
  const std::vector<Node>& nodes() const noexcept { return nodes_; }

 private:
  using Key = std::tuple<Op, std::array<int, 3>, float, int>;

  int add(Node node);

  std::vector<Node> nodes_;
  std::map<Key, int> known_;
  std::string_view section_;
};

}  // namespace scotopic::shaders
