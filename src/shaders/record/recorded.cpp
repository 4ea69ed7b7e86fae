#include "shaders/record/recorded.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scotopic::shaders {
namespace {

// What plain numbers give is a plain number.
template <class Plain>
Recorded made(Op op, const Recorded& a, Plain plain) {
  Graph* const graph = a.graph();
  if (!graph) return plain(a.number());
  return {*graph, graph->operation(op, {a.node_in(*graph), -1, -1})};
}

template <class Value, class Plain>
Value made(Op op, const Recorded& a, const Recorded& b, Plain plain) {
  Graph* const graph = a.graph() ? a.graph() : b.graph();
  if (!graph) return plain(a.number(), b.number());
  return {*graph, graph->operation(op, {a.node_in(*graph), b.node_in(*graph), -1})};
}

RecordedTruth made(Op op, Graph& graph, const RecordedTruth& a, const RecordedTruth& b) {
  return {graph, graph.operation(op, {a.node_in(graph), b.node_in(graph), -1})};
}

bool is(const Recorded& a, double number) { return !a.graph() && a.number() == number; }

}  // namespace

// What a matrix has no part in is left out; values are finite, or not used.
Recorded operator+(const Recorded& a, const Recorded& b) {
  if (is(a, 0)) return b;
  if (is(b, 0)) return a;
  return made<Recorded>(Op::add, a, b, [](double x, double y) { return x + y; });
}
Recorded operator-(const Recorded& a, const Recorded& b) {
  return made<Recorded>(Op::subtract, a, b, [](double x, double y) { return x - y; });
}
Recorded operator*(const Recorded& a, const Recorded& b) {
  if (is(a, 0) || is(b, 0)) return 0.0;
  if (is(a, 1)) return b;
  return made<Recorded>(Op::multiply, a, b, [](double x, double y) { return x * y; });
}
Recorded operator/(const Recorded& a, const Recorded& b) {
  return made<Recorded>(Op::divide, a, b, [](double x, double y) { return x / y; });
}
Recorded min(const Recorded& a, const Recorded& b) {
  return made<Recorded>(Op::min, a, b, [](double x, double y) { return std::min(x, y); });
}
Recorded max(const Recorded& a, const Recorded& b) {
  return made<Recorded>(Op::max, a, b, [](double x, double y) { return std::max(x, y); });
}
Recorded pow(const Recorded& base, const Recorded& exponent) {
  // Languages leave it open what a power of a literal is compiled to; e^(x ln base) is the same everywhere.
  if (!base.graph() && exponent.graph()) return exp(exponent * std::log(base.number()));
  return made<Recorded>(Op::pow, base, exponent, [](double x, double y) { return std::pow(x, y); });
}
Recorded abs(const Recorded& x) {
  return made(Op::abs, x, [](double v) { return std::abs(v); });
}
Recorded sqrt(const Recorded& x) {
  return made(Op::sqrt, x, [](double v) { return std::sqrt(v); });
}
Recorded exp(const Recorded& x) {
  return made(Op::exp, x, [](double v) { return std::exp(v); });
}
Recorded log(const Recorded& x) {
  return made(Op::log, x, [](double v) { return std::log(v); });
}
Recorded exp2(const Recorded& x) { return exp(x * std::numbers::ln2); }
Recorded log2(const Recorded& x) { return log(x) * std::numbers::log2e; }
Recorded log10(const Recorded& x) { return log(x) * std::numbers::log10e; }

RecordedTruth operator<(const Recorded& a, const Recorded& b) {
  return made<RecordedTruth>(Op::less, a, b, [](double x, double y) { return x < y; });
}
RecordedTruth operator<=(const Recorded& a, const Recorded& b) {
  return made<RecordedTruth>(Op::less_equal, a, b, [](double x, double y) { return x <= y; });
}
RecordedTruth operator>(const Recorded& a, const Recorded& b) {
  return made<RecordedTruth>(Op::greater, a, b, [](double x, double y) { return x > y; });
}
RecordedTruth operator!=(const Recorded& a, const Recorded& b) {
  return made<RecordedTruth>(Op::not_equal, a, b, [](double x, double y) { return x != y; });
}

RecordedTruth both(const RecordedTruth& a, const RecordedTruth& b) {
  if (!a.graph()) return a.yes() ? b : a;
  if (!b.graph()) return b.yes() ? a : b;
  return made(Op::both, *a.graph(), a, b);
}
RecordedTruth either(const RecordedTruth& a, const RecordedTruth& b) {
  if (!a.graph()) return a.yes() ? a : b;
  if (!b.graph()) return b.yes() ? b : a;
  return made(Op::either, *a.graph(), a, b);
}
RecordedTruth without(const RecordedTruth& no, const RecordedTruth& yes) {
  if (!no.graph()) return no.yes() ? RecordedTruth(false) : yes;
  if (!yes.graph() && !yes.yes()) return yes;
  return made(Op::without, *no.graph(), no, yes);
}
Recorded chosen(const RecordedTruth& which, const Recorded& yes, const Recorded& no) {
  if (!which.graph()) return which.yes() ? yes : no;
  if (!yes.graph() && is(no, yes.number())) return yes;
  Graph& graph = *which.graph();
  return {graph, graph.operation(Op::select, {which.node_in(graph), yes.node_in(graph), no.node_in(graph)})};
}

}  // namespace scotopic::shaders
