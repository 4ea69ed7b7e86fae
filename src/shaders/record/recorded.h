// Numbers that remember how they came about. One that no pixel and no slider is part of stays a plain number,
// in double.
#pragma once

#include "shaders/record/graph.h"

namespace scotopic::shaders {

/// A value.
class Recorded {
 public:
  /// 0.
  Recorded() = default;
  /// Implicit: formulas mix values and numbers.
  Recorded(double number) noexcept : number_(number) {}
  Recorded(Graph& graph, int node) noexcept : graph_(&graph), node_(node) {}

  /// The graph it is part of; nullptr: of none, it is number().
  Graph* graph() const noexcept { return graph_; }
  double number() const noexcept { return number_; }
  /// Its node in `graph`, made there if it is a plain number.
  int node_in(Graph& graph) const { return graph_ ? node_ : graph.literal(number_); }

 private:
  Graph* graph_ = nullptr;
  int node_ = -1;
  double number_ = 0;
};

/// A yes or no.
class RecordedTruth {
 public:
  RecordedTruth(bool yes) noexcept : yes_(yes) {}
  RecordedTruth(Graph& graph, int node) noexcept : graph_(&graph), node_(node) {}

  Graph* graph() const noexcept { return graph_; }
  bool yes() const noexcept { return yes_; }
  int node_in(Graph& graph) const { return graph_ ? node_ : graph.truth(yes_); }

 private:
  Graph* graph_ = nullptr;
  int node_ = -1;
  bool yes_ = false;
};

Recorded operator+(const Recorded& a, const Recorded& b);
Recorded operator-(const Recorded& a, const Recorded& b);
Recorded operator*(const Recorded& a, const Recorded& b);
Recorded operator/(const Recorded& a, const Recorded& b);
Recorded min(const Recorded& a, const Recorded& b);
Recorded max(const Recorded& a, const Recorded& b);
Recorded abs(const Recorded& x);
Recorded sqrt(const Recorded& x);
Recorded exp(const Recorded& x);
Recorded log(const Recorded& x);
Recorded pow(const Recorded& base, const Recorded& exponent);
// By exp and log, which every language has.
Recorded exp2(const Recorded& x);
Recorded log2(const Recorded& x);
Recorded log10(const Recorded& x);

RecordedTruth operator<(const Recorded& a, const Recorded& b);
RecordedTruth operator<=(const Recorded& a, const Recorded& b);
RecordedTruth operator>(const Recorded& a, const Recorded& b);
RecordedTruth operator!=(const Recorded& a, const Recorded& b);
RecordedTruth both(const RecordedTruth& a, const RecordedTruth& b);
RecordedTruth either(const RecordedTruth& a, const RecordedTruth& b);
/// yes, and not no.
RecordedTruth without(const RecordedTruth& no, const RecordedTruth& yes);
Recorded chosen(const RecordedTruth& which, const Recorded& yes, const Recorded& no);

}  // namespace scotopic::shaders
