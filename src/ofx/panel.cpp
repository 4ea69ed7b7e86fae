#include "ofx/panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "adaptation/named_adaptations.h"
#include "scotopic/controls.h"
#include "ofx/colour.h"
#include "ofx/suites.h"
#include "pipeline/stages/stage_values.h"

namespace scotopic::ofx {
namespace {

// Names of what is not one parameter of the operator.
constexpr const char *scene = "scene", *log_adaptation = "log10_adaptation", *effects_choice = "effects",
                     *moving = "moving", *in_time = "adapt_in_time";
constexpr std::array effects_words = {"auto", "all", "none", "listed"};
constexpr const char* first_group = "What is seen";
// Of the slider, log10 cd/m2: from what rods just see to daylight.
constexpr double darkest = -6, brightest = 3, usual = -1;

std::string use(std::string_view stage) { return "use_" + std::string(stage); }

/// Whether a list of effects may name it.
bool can_be_listed(const StageEntry& entry) {
  return (entry.add || entry.set) && entry.description->switched_by.empty();
}

std::string label_of(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 32);
  return name;
}

/// Of the config in force, after two words.
const std::vector<std::string>& spaces() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> out = {"the host's, else working space", "working space"};
    if (config_in_force()) {
      const auto config = config_in_force()->ocio();
      for (int i = 0; i < config->getNumColorSpaces(); ++i)
        out.emplace_back(config->getColorSpaceNameByIndex(i));
    }
    return out;
  }();
  return names;
}

/// The slider's end: luminances and the like go further only when typed.
double shown_greatest(const Control& c) { return c.high <= 1000 ? c.high : std::max(100.0, 10 * c.initial); }

class Definer {
 public:
  explicit Definer(ParamSet set) : set_(set) {}

  Properties define(const char* kind, const std::string& name, const std::string& label,
                    const std::string& hint) {
    PropertySet properties = nullptr;
    if (suites().parameter->define(set_, kind, name.c_str(), &properties) != ok) properties = nullptr;
    const Properties out(properties);
    out.set(property::label, label);
    out.set(property::hint, hint);
    if (!group_.empty() && kind != type::group) out.set(property::parent, group_);
    return out;
  }

  void begin_group(const std::string& title) {
    std::string name = "group_" + title;
    std::replace(name.begin(), name.end(), ' ', '_');
    group_ = name;
    if (!groups_.insert(name).second) return;
    const Properties group = define(type::group, name, title, "");
    group.set(property::group_open, title == first_group ? 1 : 0);
  }

  void choice(const std::string& name, const std::string& label, const std::string& hint,
              const std::vector<std::string>& words, int initial) {
    const Properties p = define(type::choice, name, label, hint);
    for (std::size_t i = 0; i < words.size(); ++i)
      p.set(property::choice_option, words[i], static_cast<int>(i));
    p.set(property::initial, initial);
  }

  void number(const std::string& name, const std::string& label, const std::string& hint, double low,
              double high, double shown, double initial) {
    const Properties p = define(type::dbl, name, label, hint);
    p.set(property::least, low);
    p.set(property::greatest, high);
    p.set(property::display_least, low);
    p.set(property::display_greatest, shown);
    p.set(property::initial, initial);
  }

  void boolean(const std::string& name, const std::string& label, const std::string& hint, bool initial) {
    define(type::boolean, name, label, hint).set(property::initial, initial ? 1 : 0);
  }

 private:
  ParamSet set_;
  std::string group_;
  std::set<std::string> groups_;
};

std::vector<std::string> scene_words() {
  std::vector<std::string> out = {"slider", "auto"};
  for (const NamedAdaptation& step : named_adaptations) out.emplace_back(step.name);
  return out;
}

void define_adaptation(Definer& d) {
  d.begin_group(first_group);
  d.choice(scene, "Scene",
           "What the eye is adapted to: the slider, the picture's own log-average, or a scene", scene_words(),
           0);
  d.number(log_adaptation, "Log10 adaptation luminance",
           "Luminance the eye is adapted to, as power of ten of cd/m2: -2 is 0.01, a full moon", darkest,
           brightest, brightest, usual);
}

void define_effects(Definer& d) {
  d.choice(effects_choice, "Effects",
           "auto: what the scene calls for; all; none; or those that are ticked below",
           {effects_words.begin(), effects_words.end()}, 0);
  for (const StageEntry& entry : shipped_stages())
    if (can_be_listed(entry))
      d.boolean(use(entry.description->name), "Use " + std::string(entry.description->name),
                "Of the list: " + std::string(entry.description->gives), true);
  d.boolean(moving, "Moving", "Frames of a sequence, in which the rods' noise flickers; off: stills", true);
  d.boolean(in_time, "Adapt in time",
            "The eye follows the slider with a delay: from the first frame of the clip on, one state a frame",
            false);
}

void define_control(Definer& d, const Control& c) {
  d.begin_group(c.group);
  switch (c.kind) {
    case Control::Kind::number:
      return d.number(c.name, label_of(c.name), c.sentence, c.low, c.high, shown_greatest(c), c.initial);
    case Control::Kind::word:
      return d.choice(c.name, label_of(c.name), c.sentence, c.words, static_cast<int>(c.initial));
    case Control::Kind::text:
      break;
  }
  if (c.name == colour_space) return d.choice(c.name, label_of(c.name), c.sentence, spaces(), 0);
  d.define(type::string, c.name, label_of(c.name), c.sentence).set(property::initial, "");
}

}  // namespace

void define_panel(ParamSet set) {
  Definer definer(set);
  define_adaptation(definer);
  define_effects(definer);
  for (const Control& c : controls()) define_control(definer, c);
}

Panel::Panel(ParamSet set) {
  const auto add = [&](const std::string& name) {
    Param param = nullptr;
    if (suites().parameter->get_handle(set, name.c_str(), &param, nullptr) == ok) handles_[name] = param;
  };
  for (const char* name : {scene, log_adaptation, effects_choice, moving, in_time}) add(name);
  for (const StageEntry& entry : shipped_stages()) add(use(entry.description->name));
  for (const Control& c : controls()) add(c.name);
}

Param Panel::handle(const std::string& name) const {
  const auto found = handles_.find(name);
  return found == handles_.end() ? nullptr : found->second;
}

double Panel::number(const std::string& name, Time time) const {
  double value = 0;
  const Param param = handle(name);
  if (param) (void)suites().parameter->get_value_at_time(param, time, &value);
  return value;
}

int Panel::integer(const std::string& name, Time time) const {
  int value = 0;
  const Param param = handle(name);
  if (param) (void)suites().parameter->get_value_at_time(param, time, &value);
  return value;
}

std::string Panel::text(const std::string& name, Time time) const {
  char* value = nullptr;
  const Param param = handle(name);
  if (param) (void)suites().parameter->get_value_at_time(param, time, &value);
  return value ? value : "";
}

std::string Panel::effects(Time time) const {
  const int chosen = std::clamp(integer(effects_choice, time), 0, static_cast<int>(effects_words.size()) - 1);
  if (chosen < 3) return effects_words[static_cast<std::size_t>(chosen)];
  std::string out;
  for (const StageEntry& entry : shipped_stages()) {
    const std::string name(entry.description->name);
    if (can_be_listed(entry) && integer(use(name), time) != 0) out += (out.empty() ? "" : ",") + name;
  }
  return out.empty() ? "none" : out;
}

double Panel::slider(Time time) const { return std::pow(10.0, number(log_adaptation, time)); }

PanelState Panel::at(Time time, double scale) const {
  PanelState out;
  const std::vector<std::string> scenes = scene_words();
  const auto chosen = static_cast<std::size_t>(std::max(0, integer(scene, time)));
  out.slider = slider(time);
  out.by_slider = chosen == 0 || chosen >= scenes.size();
  out.parameters["adaptation"] = out.by_slider ? parameter_text(out.slider) : scenes[chosen];
  out.parameters["effects"] = effects(time);
  out.moves = integer(moving, time) != 0;
  out.adapts = out.by_slider && integer(in_time, time) != 0;
  for (const Control& c : controls()) {
    std::string value;
    if (c.kind == Control::Kind::number) {
      const double given = number(c.name, time);
      if (given != c.initial) value = parameter_text(c.name == "ppd" ? given * scale : given);
    } else if (c.kind == Control::Kind::word) {
      const int place = integer(c.name, time);
      if (place != static_cast<int>(c.initial) && place >= 0 && place < static_cast<int>(c.words.size()))
        value = c.words[static_cast<std::size_t>(place)];
    } else if (c.name == colour_space) {
      const auto place = static_cast<std::size_t>(std::max(0, integer(c.name, time)));
      out.host_space = place == 0;
      if (place > 1 && place < spaces().size()) value = spaces()[place];
    } else {
      value = text(c.name, time);
    }
    if (!value.empty()) out.parameters[c.name] = value;
  }
  return out;
}

}  // namespace scotopic::ofx
