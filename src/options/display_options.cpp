#include "options/display_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "options/values.h"

namespace scotopic {
namespace {

DisplayRange parse_range(const std::string& text) {
  const char* const takes = "auto, or two luminances LOW,HIGH in cd/m2, the lower one first";
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) fail_value("--display-range", text, takes);
  const auto luminance = [&](const std::string& part) {
    return number_in("--display-range", part, 1e-12, 1e12, takes);
  };
  const DisplayRange out = {luminance(text.substr(0, comma)), luminance(text.substr(comma + 1))};
  if (!(out.low <= out.high)) fail_value("--display-range", text, takes);
  return out;
}

using Given = std::pair<const char*, bool>;

/// The first of the options that was given.
std::string first_given(const std::vector<Given>& options) {
  for (const auto& [name, changed] : options)
    if (changed) return name;
  return "";
}

[[noreturn]] void refuse(const std::string& option, const char* what) {
  throw Error(ExitCode::usage, "", option + " is of " + what);
}

/// Options of a stage that does not run.
void refuse_idle_options(const DisplayOptions& o, const StageValues& stages, DisplayChoice& choice,
                         const ImageRequest& request) {
  const DisplayOptions usual;
  const std::string of_tone = first_given({{"--contrast", o.contrast != usual.contrast},
                                           {"--night-range", o.night_range != usual.night_range},
                                           {"--night-exponent", o.night_exponent != usual.night_exponent},
                                           {"--display-range", o.range != usual.range}});
  if (!choice.tone && !of_tone.empty()) refuse(of_tone, "the tone map: --tone local");
  choice.of_night = first_given({{"--visibility", stages.given("visibility")},
                                 {"--viewing-adaptation", stages.given("viewing-adaptation")},
                                 {"--strength-display", stages.given("strength-display")},
                                 {"--peak", stages.given("peak") && !choice.tone}});
  if (request.night == NightDisplayMode::never && !choice.of_night.empty())
    refuse(choice.of_night, "the display stage: --display night");
}

/// night, night:DISPLAY, none, or a view.
void set_display(const std::string& text, ImageRequest& request) {
  constexpr std::string_view night = "night:";
  if (text.empty()) return;
  request.night = NightDisplayMode::never;
  if (text == "none") return;
  if (text == "night" || text.rfind(night, 0) == 0) {
    request.night = NightDisplayMode::always;
    request.night_display = text == "night" ? "" : text.substr(night.size());
  } else {
    request.view = text;
  }
}

}  // namespace

void add_display_options(CLI::App& verb, DisplayOptions& o) {
  const TextOptions add{verb, "Display"};
  add("--display", o.display,
      "night[:DISPLAY]: as dark as the eye sees it (default for PNG, JPEG and TIFF of whole numbers); none: "
      "values alone "
      "(default for the rest); or a view of the config, as it is",
      "WHAT");
  add("--dither", o.dither,
      "Of PNG and TIFF of 8 bits for a display: ordered (default), by at most half a code; or none", "NAME");
  add("--tone", o.tone, "local: the literature's bilateral tone map in place of the display stage", "NAME");
  add("--contrast", o.contrast, "Span of large shapes on a display of 100 cd/m2 (default 5)", "X");
  add("--night-range", o.night_range, "Share of that left to what rods alone see (default 0.35; 1: all)",
      "X");
  add("--night-exponent", o.night_exponent,
      "How that share is reached: power of the rods' weight (default 1)", "X");
  add("--display-range", o.range,
      "Scene luminances of large shapes to be spanned: auto, or LOW,HIGH in cd/m2", "RANGE");
}

DisplayChoice parse(const DisplayOptions& o, const StageValues& stages, ImageRequest& request) {
  DisplayChoice out;
  set_display(o.display, request);
  if ((request.view || request.night == NightDisplayMode::always) && request.output_colourspace)
    throw Error(ExitCode::usage, "", "either --display or --output-colorspace, not both");
  request.dither = choice<bool>("--dither", o.dither, {{"ordered", true}, {"none", false}});
  if (!o.tone.empty()) out.tone = choice<bool>("--tone", o.tone, {{"local", true}, {"none", false}});
  if (out.tone && request.night == NightDisplayMode::always)
    throw Error(ExitCode::usage, "", "either --display night or --tone local, not both");
  if (out.tone) request.night = NightDisplayMode::never;
  DisplayParameters& p = out.parameters;
  p.contrast = number_in("--contrast", o.contrast, 1, 1e6, "a ratio of luminances, 1 to 1e6");
  p.peak = stages.number("peak");
  p.night_range = number_in("--night-range", o.night_range, 0, 1, "a share from 0 to 1");
  p.night_exponent = number_in("--night-exponent", o.night_exponent, 0.01, 100, "a power, 0.01 to 100");
  if (o.range != "auto") out.range = parse_range(o.range);
  refuse_idle_options(o, stages, out, request);
  return out;
}

}  // namespace scotopic
