// Which of the stages' constants hang on sliders, and which stage each is of: by where they lie, as the batch
// finds them.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "shaders/record/recorded.h"

namespace scotopic::shaders {

/// Of one struct of constants, which must outlive it.
class Bindings {
 public:
  /// From now on `constant` is what the slider says.
  void bind(const float& constant, const Recorded& value) { values_[&constant] = value; }
  /// Reading a number of `part` says that the stage `name` is at work.
  template <class Part>
  void name(const Part& part, std::string_view name) {
    const auto* const begin = reinterpret_cast<const std::byte*>(&part);
    sections_.push_back({begin, begin + sizeof part, name});
  }

  Recorded value_of(const float& constant, Graph& graph) const {
    const auto* const at = reinterpret_cast<const std::byte*>(&constant);
    for (const Section& section : sections_)
      if (!std::less<>()(at, section.begin) && std::less<>()(at, section.end)) graph.enter(section.name);
    const auto found = values_.find(&constant);
    return found == values_.end() ? Recorded(static_cast<double>(constant)) : found->second;
  }

 private:
  struct Section {
    const std::byte* begin;
    const std::byte* end;
    std::string_view name;
  };

  std::map<const float*, Recorded> values_;
  std::vector<Section> sections_;
};

}  // namespace scotopic::shaders
