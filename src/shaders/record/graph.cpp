#include "shaders/record/graph.h"

namespace scotopic::shaders {
namespace {

Node node_of(Op op) {
  Node node;
  node.op = op;
  return node;
}

}  // namespace

int Graph::add(Node node) {
  const Key key{node.op, node.from, node.number, node.index};
  const auto [found, is_new] = known_.try_emplace(key, static_cast<int>(nodes_.size()));
  if (!is_new) return found->second;
  node.section = section_;
  for (const int from : node.from)
    if (from >= 0) node.varies |= nodes_[static_cast<std::size_t>(from)].varies;
  nodes_.push_back(node);
  return found->second;
}

int Graph::literal(double number) {
  Node node = node_of(Op::literal);
  node.number = static_cast<float>(number);
  return add(node);
}

int Graph::truth(bool yes) {
  Node node = node_of(Op::truth);
  node.number = yes ? 1 : 0;
  return add(node);
}

int Graph::input(int index) {
  Node node = node_of(Op::input);
  node.index = index;
  node.varies = true;
  return add(node);
}

int Graph::parameter(int index) {
  Node node = node_of(Op::parameter);
  node.index = index;
  return add(node);
}

int Graph::operation(Op op, std::array<int, 3> from) {
  Node node = node_of(op);
  node.from = from;
  return add(node);
}

}  // namespace scotopic::shaders
