#include "options/scene/stage_options.h"

#include <fmt/format.h>

#include "options/values.h"
#include "stages/detail/description.h"

namespace scotopic {
namespace {

bool has_options(const StageEntry& entry, StagesShown shown) {
  // The display's are bake's own.
  const bool held = entry.description->not_in_a_look.empty() && (entry.set || entry.add);
  return shown == StagesShown::all || entry.set || (shown == StagesShown::look && held);
}

std::string kind_of(const StageParameter& p) {
  if (!p.words.empty()) return "NAME";
  return p.unit == "cd/m2" ? "CDM2" : p.unit == "years" ? "YEARS" : "X";
}

void add_parameter(CLI::App& verb, const StageDescription& stage, const StageParameter& p,
                   StageOptions& options) {
  std::string names = "--" + std::string(p.name);
  if (!p.alias.empty()) names += ",--" + std::string(p.alias);
  verb.add_option(names, options.typed[std::string(p.name)], std::string(p.sentence))
      ->type_name(kind_of(p))
      ->group(std::string(stage.group));
}

/// "WORD", or "WORD:X" for a word that takes a threshold of its own.
void set_word(const StageParameter& p, const std::string& text, StageValues& values) {
  const std::size_t colon = text.find(':');
  const std::string threshold = std::string(p.name) + "-threshold";
  if (colon != text.npos) {
    const std::string option = "--" + std::string(p.name);
    const std::optional<double> number = parse_number(text.substr(colon + 1));
    if (text.substr(0, colon) != p.words.front() || !number || !(*number >= 1e-30 && *number <= 1e30))
      fail_value(option.c_str(), text, fmt::format("one of {}, or {}:X", joined_words(p), p.words.front()));
    values.set(threshold, *number);
  }
  values.set(p.name, std::string_view(text).substr(0, colon));
}

void set_parameter(const StageParameter& p, const std::string& text, StageValues& values) {
  if (!p.words.empty()) return set_word(p, text, values);
  const std::optional<double> number = parse_number(text);
  if (!number || !accepts(p, *number)) fail_value(("--" + std::string(p.name)).c_str(), text, range_text(p));
  values.set(p.name, *number);
}

/// --acuity, --acuity local: the bilateral filter by name.
void set_acuity(const std::string& text, StageValues& values) {
  const auto filter = choice<DetailFilter>("--acuity", text,
                                           {{"global", DetailFilter::bilateral},
                                            {"local", DetailFilter::bilateral_local},
                                            {"off", DetailFilter::none}});
  if (filter == DetailFilter::none) return;
  if (values.given("detail")) throw Error(ExitCode::usage, "", "either --acuity or --detail, not both");
  values.set("detail", static_cast<double>(filter));
}

}  // namespace

void add_stage_options(CLI::App& verb, StageOptions& o, StagesShown shown) {
  const std::string of_images =
      shown == StagesShown::all
          ? " (glare, detail and noise where pixels per degree are known, noise in sequences)"
          : "";
  verb.add_option("--effects", o.effects,
                  "auto (default: what the scene calls for), all" + of_images + ", none, or of " +
                      effect_names(o.table, shown != StagesShown::all))
      ->type_name("LIST")
      ->group("What is seen");
  for (const StageEntry& entry : o.table)
    if (has_options(entry, shown))
      for (const StageParameter& p : entry.description->parameters)
        add_parameter(verb, *entry.description, p, o);
  if (shown == StagesShown::all)
    verb.add_flag("--acuity{global}", o.acuity,
                  "As --detail bilateral; --acuity local: as --detail bilateral-local")
        ->group("Detail");
}

StageValues parse(const StageOptions& o) {
  StageValues values(o.table);
  values.set_effects(o.effects);
  for (const StageEntry& entry : o.table)
    for (const StageParameter& p : entry.description->parameters) {
      const auto typed = o.typed.find(p.name);
      if (typed != o.typed.end() && !typed->second.empty()) set_parameter(p, typed->second, values);
    }
  set_acuity(o.acuity, values);
  return values;
}

}  // namespace scotopic
