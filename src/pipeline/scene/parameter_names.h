// Names of the operator's choices: for options, messages and metadata.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "adaptation/thresholds.h"
#include "stages/shared/parameters.h"

namespace scotopic {

template <typename T, std::size_t count>
using NamesOf = std::array<std::pair<const char*, T>, count>;

inline constexpr NamesOf<Model, 4> model_names = {{{"filament2021", Model::filament2021},
                                                   {"kirk2011", Model::kirk2011},
                                                   {"safko2019", Model::safko2019},
                                                   {"cao2008", Model::cao2008}}};
inline constexpr NamesOf<Weight, 2> weight_names = {{{"local", Weight::local}, {"global", Weight::global}}};
inline constexpr NamesOf<LuminancePolicy, 3> luminance_names = {{{"mesopic", LuminancePolicy::mesopic},
                                                                 {"photopic", LuminancePolicy::photopic},
                                                                 {"none", LuminancePolicy::none}}};
inline constexpr NamesOf<RodEstimate, 2> rod_names = {
    {{"linear", RodEstimate::linear}, {"quadratic", RodEstimate::quadratic}}};

inline constexpr NamesOf<VisibilityRule, 2> visibility_names = {
    {{"hdrvdp2", VisibilityRule::hdrvdp2}, {"ward1997", VisibilityRule::ward1997}}};

/// The name of a value.
template <typename T, std::size_t count>
std::string name_in(const NamesOf<T, count>& names, T value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  return "";
}

}  // namespace scotopic
