#include "pipeline/stages/stage_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "base/names.h"

namespace scotopic {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view value, const std::string& takes) {
  throw Error(ExitCode::usage, "", fmt::format("--{}: '{}' is not {}", option, value, takes));
}

std::vector<std::string> effect_words(StageTable table) {
  std::vector<std::string> out;
  for (const StageEntry& entry : table)
    if (entry.description->switched_by.empty()) out.emplace_back(entry.description->name);
  for (const char* whole : {"all", "none", "auto"}) out.emplace_back(whole);
  return out;
}

}  // namespace

StageValues::StageValues(StageTable table) : table_(table), wishes_(table.size(), EffectWish::if_known) {
  for (const StageEntry& entry : table)
    for (const StageParameter& p : entry.description->parameters) slots_.push_back({&p, p.initial, false});
}

const StageValues::Slot& StageValues::slot(std::string_view parameter) const {
  const auto found = std::find_if(slots_.begin(), slots_.end(), [&](const Slot& s) {
    return s.parameter->name == parameter || (!parameter.empty() && s.parameter->alias == parameter);
  });
  if (found == slots_.end()) throw std::out_of_range("no stage has the parameter " + std::string(parameter));
  return *found;
}

void StageValues::set(std::string_view parameter, double value) {
  Slot& at = slots_[static_cast<std::size_t>(&slot(parameter) - slots_.data())];
  const StageParameter& p = *at.parameter;
  if (!accepts(p, value)) refuse(p.name, fmt::format("{:g}", value), range_text(p));
  at.value = value;
  at.given = true;
}

void StageValues::set(std::string_view parameter, std::string_view word) {
  const StageParameter& p = *slot(parameter).parameter;
  const auto found = std::find(p.words.begin(), p.words.end(), word);
  if (found != p.words.end()) return set(parameter, static_cast<double>(found - p.words.begin()));
  const std::vector<std::string> known(p.words.begin(), p.words.end());
  refuse(p.name, word, "one of " + joined_words(p) + did_you_mean(word, known));
}

EffectWish StageValues::wish(std::string_view stage) const { return wishes_.at(place_of(table_, stage)); }

void StageValues::set_wish(std::string_view stage, EffectWish wish) {
  wishes_.at(place_of(table_, stage)) = wish;
}

void StageValues::set_effects(const std::string& list) {
  const bool all = list == "all" || list == "auto";
  for (std::size_t i = 0; i < table_.size(); ++i)
    if (table_[i].description->switched_by.empty()) wishes_[i] = all ? EffectWish::if_known : EffectWish::no;
  if (all || list == "none") return;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string name = list.substr(at, comma - at);
    const std::size_t place = place_of(table_, name);
    const std::vector<std::string> words = effect_words(table_);
    if (name == "all" || name == "none" || name == "auto")
      refuse("effects", list, "a list: all, none and auto stand alone");
    if (place == table_.size() || !table_[place].description->switched_by.empty())
      refuse("effects", name, "one of " + joined(words) + did_you_mean(name, words));
    wishes_[place] = EffectWish::yes;
    at = comma + 1;
  }
}

void StageValues::set_pixel_stages(AppearanceParameters& parameters) const {
  for (const StageEntry& entry : table_)
    if (entry.set) entry.set(*this, parameters);
}

bool accepts(const StageParameter& p, double value) noexcept {
  return value >= p.low && value <= p.high && !(p.whole && value != std::floor(value));
}

std::string range_text(const StageParameter& p) {
  return fmt::format("a {}number from {:g} to {:g}{}{}", p.whole ? "whole " : "", p.low, p.high,
                     p.unit.empty() ? "" : ", in ", p.unit);
}

std::string joined_words(const StageParameter& parameter) {
  return joined({parameter.words.begin(), parameter.words.end()});
}

std::size_t place_of(StageTable table, std::string_view stage) noexcept {
  const auto found = std::find_if(table.begin(), table.end(), [&](const StageEntry& entry) {
    const StageDescription& d = *entry.description;
    return !stage.empty() && (d.name == stage || d.alias == stage);
  });
  return static_cast<std::size_t>(found - table.begin());
}

std::string effect_names(StageTable table, bool fused) {
  std::string out;
  for (const StageEntry& entry : table)
    if (entry.description->switched_by.empty() && (entry.set || !fused))
      out += (out.empty() ? "" : ",") + std::string(entry.description->name);
  return out;
}

}  // namespace scotopic
