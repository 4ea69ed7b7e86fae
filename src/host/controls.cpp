#include "scotopic/controls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "host/parameters.h"
#include "pipeline/scene/parameter_names.h"
#include "pipeline/stages/stage_values.h"

namespace scotopic {
namespace {

struct Range {
  std::string_view name;
  double low, high, initial;
};

// Of what is no stage's: 0 stands for what is not given where the option has no default.
constexpr std::array ranges = {Range{"white_luminance", 0, 1e9, 0},
                               Range{"safko_scale", 0, 1e9, 0},
                               Range{"strength", 0, 1, 1},
                               Range{"ppd", 0, 1e5, 0},
                               Range{"fov", 0, 179, 0},
                               Range{"contrast", 1, 1e6, 5},
                               Range{"night_range", 0, 1, 0.35},
                               Range{"night_exponent", 0.01, 100, 1},
                               Range{"exposure", -64, 64, 0}};

struct Words {
  std::string_view name;
  std::vector<std::string> words;  // the first is the default
};

template <typename T, std::size_t count>
std::vector<std::string> words_of(const NamesOf<T, count>& names) {
  std::vector<std::string> out;
  for (const auto& [name, value] : names) out.emplace_back(name);
  return out;
}

const std::vector<Words>& word_lists() {
  static const std::vector<Words> lists = {{"model", words_of(model_names)},
                                           {"weight", words_of(weight_names)},
                                           {"luminance", words_of(luminance_names)},
                                           {"gamut", {"working", "rec709", "rec2020", "p3", "ap1", "none"}},
                                           {"rods", words_of(rod_names)},
                                           {"precision", {"float", "double"}},
                                           {"tone", {"none", "local"}},
                                           {"projection", {"flat", "latlong"}},
                                           {"nonfinite", {"keep", "clean", "error"}}};
  return lists;
}

const std::set<std::string_view> left_out = {"adaptation", "effects",          "acuity",       "config",
                                             "max_memory", "max_config_size",  "max_lut_size", "max_error",
                                             "budget",     "working_primaries"};

std::string with_underscores(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

const StageParameter* of_stage(const std::string& name) {
  for (const StageEntry& entry : shipped_stages())
    for (const StageParameter& p : entry.description->parameters)
      if (with_underscores(p.name) == name) return &p;
  return nullptr;
}

void set_kind(Control& control) {
  const auto number = [&](double low, double high, double initial) {
    control.kind = Control::Kind::number;
    control.low = low;
    control.high = high;
    control.initial = initial;
  };
  const auto words = [&](std::vector<std::string> list, double initial) {
    control.kind = Control::Kind::word;
    control.words = std::move(list);
    control.initial = initial;
  };
  if (const StageParameter* p = of_stage(control.name)) {
    if (p->words.empty()) return number(p->low, p->high, p->initial);
    return words({p->words.begin(), p->words.end()}, p->initial);
  }
  for (const Range& r : ranges)
    if (r.name == control.name) return number(r.low, r.high, r.initial);
  for (const Words& w : word_lists())
    if (w.name == control.name) return words(w.words, 0);
}

std::vector<Control> make_controls() {
  std::vector<Control> out;
  for (const ParameterInfo& p : parameter_list()) {
    if (left_out.count(p.name) != 0) continue;
    Control control;
    control.name = p.name;
    control.group = p.group;
    control.sentence = p.sentence;
    set_kind(control);
    out.push_back(std::move(control));
  }
  return out;
}

}  // namespace

const std::vector<Control>& controls() {
  static const std::vector<Control> all = make_controls();
  return all;
}

std::string parameter_text(double value) { return fmt::format("{}", value); }

}  // namespace scotopic
