#include "cli/sequence/adaptation_track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "options/values.h"

namespace scotopic {
namespace {

constexpr double least = 1e-9, greatest = 1e9;  // cd/m2, as --adaptation has them

void add_key(std::vector<AdaptationKey>& keys, double frame, double luminance, const std::string& file,
             const std::string& place) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitCode::input, file, place + ": " + what);
  };
  if (!(std::abs(frame) <= 1e9) || frame != std::floor(frame)) refuse("a frame is a whole number");
  if (!(luminance >= least && luminance <= greatest)) refuse("a luminance is from 1e-9 to 1e9 cd/m2");
  if (!keys.empty() && keys.back().frame >= static_cast<int>(frame)) refuse("frames have to ascend");
  keys.push_back({static_cast<int>(frame), luminance});
}

std::vector<AdaptationKey> keys_of_csv(const std::string& text, const std::string& file) {
  std::vector<AdaptationKey> keys;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::string place = fmt::format("line {}", number);
    const std::size_t comma = line.find(',');
    const std::optional<double> frame = parse_number(line.substr(0, comma));
    if (!frame && keys.empty() && number == 1) continue;  // a heading
    std::string rest = comma == line.npos ? "" : line.substr(comma + 1);
    rest.erase(0, std::min(rest.find_first_not_of(' '), rest.size()));
    const std::optional<double> luminance = parse_number(rest);
    if (!frame || !luminance) throw Error(ExitCode::input, file, place + ": is not \"frame,luminance\"");
    add_key(keys, *frame, *luminance, file, place);
  }
  return keys;
}

std::vector<AdaptationKey> keys_of_json(const nlohmann::json& json, const std::string& file) {
  const nlohmann::json* list = &json;
  for (const char* name : {"keys", "frames"})
    if (json.is_object() && json.contains(name)) list = &json[name];
  if (!list->is_array()) throw Error(ExitCode::input, file, "has no list of \"frame\" and \"adaptation\"");
  std::vector<AdaptationKey> keys;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const nlohmann::json& entry = (*list)[i];
    const std::string place = fmt::format("entry {}", i + 1);
    const auto number = [&](const char* name) {
      if (!entry.is_object() || !entry.contains(name) || !entry[name].is_number())
        throw Error(ExitCode::input, file, place + ": has no number \"" + name + "\"");
      return entry[name].get<double>();
    };
    add_key(keys, number("frame"), number("adaptation"), file, place);
  }
  return keys;
}

}  // namespace

std::vector<AdaptationKey> parse_adaptation_keys(const std::string& text, const std::string& file) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  std::vector<AdaptationKey> keys =
      json.is_array() || json.is_object() ? keys_of_json(json, file) : keys_of_csv(text, file);
  if (keys.empty())
    throw Error(ExitCode::input, file, "holds no adaptation: lines \"frame,luminance\", or JSON");
  return keys;
}

AdaptationTrack::AdaptationTrack(std::vector<AdaptationKey> keys, std::span<const AdaptationPeriod> history,
                                 double frame_rate, int last, std::string source)
    : keys_(std::move(keys)), frame_rate_(frame_rate), source_(std::move(source)) {
  std::vector<double> lived;
  for (int frame = keys_.front().frame; frame <= std::max(last, keys_.front().frame); ++frame)
    lived.push_back(luminance(frame));
  const AdaptationState first = history.empty() ? adapted_state(lived.front()) : state_after(history);
  states_ = track_states(first, lived, frame_rate);
}

double AdaptationTrack::luminance(double frame) const {
  const auto after =
      std::find_if(keys_.begin(), keys_.end(), [&](const AdaptationKey& k) { return k.frame >= frame; });
  if (after == keys_.end()) return keys_.back().luminance;
  if (after == keys_.begin() || after->frame == frame) return after->luminance;
  const AdaptationKey& before = *(after - 1);
  const double share = (frame - before.frame) / (after->frame - before.frame);
  return before.luminance * std::pow(after->luminance / before.luminance, share);
}

const AdaptationState& AdaptationTrack::state(int frame) const {
  return states_[static_cast<std::size_t>(std::max(0, frame - keys_.front().frame))];
}

TrackedAdaptation AdaptationTrack::at(int frame) const {
  return {luminance(frame), fmt::format("{}, frame {}", source_, frame), state(frame)};
}

std::string AdaptationTrack::identity() const {
  const AdaptationState& s = states_.front();
  std::string text = fmt::format(" track {:a} {:a} {:a} {:a} {:a} {:a}", frame_rate_, s.rod_bleached,
                                 s.rod_product, s.cone_bleached, s.rod_neural, s.cone_neural);
  for (const AdaptationKey& key : keys_) text += fmt::format(" {}:{:a}", key.frame, key.luminance);
  return text;
}

}  // namespace scotopic
